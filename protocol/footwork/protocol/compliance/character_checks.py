"""Checks of characters: what messages do to them, and their poses."""

import math
import struct

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.compliance.peer import PATIENCE, Dial, Failed, Peer, expect, in_session


def _place(pose: m.Pose) -> tuple[float, float]:
    x, _, z = struct.unpack("<3f", pose.root)
    return x, z


def _expect_near(pose: m.Pose, x: float, z: float) -> None:
    if math.dist(_place(pose), (x, z)) > 1.0:
        raise Failed(f"the character is at {_place(pose)}, expected it within a metre of {x, z}")


def a_spawned_character_is_shown_where_it_was_put(dial: Dial) -> None:
    """An event, then poses that acknowledge the message."""
    with in_session(dial) as peer:
        event = peer.spawn(7, x=30.0, z=-20.0, yaw=1.0)
        pose = peer.pose()
        expect((pose.character, pose.acknowledged), (7, event.sequence), "character and acknowledged sequence")
        _expect_near(pose, 30.0, -20.0)


def a_pose_holds_a_turn_for_every_joint(dial: Dial) -> None:
    """Of length one, in a message of at most 1,200 bytes for 31 joints, and indices that the welcome explains."""
    with in_session(dial) as peer:
        peer.spawn()
        pose, welcome = peer.pose(), peer.welcome
        turns = list(struct.iter_unpack("<4f", pose.rotations))
        expect(len(turns), len(welcome.joints), "number of rotations")
        if any(abs(math.hypot(*turn) - 1.0) > 1e-3 for turn in turns):
            raise Failed("a rotation is no unit quaternion")
        if len(turns) <= 31 and len(encode(pose)) > 1200:
            raise Failed(f"a pose takes {len(encode(pose))} bytes, expected at most 1200")
        if not (-1 <= pose.behaviour < len(welcome.behaviours) and 0 <= pose.clip < len(welcome.clips)):
            raise Failed(f"behaviour {pose.behaviour} or clip {pose.clip} is not in the welcome")


def no_tick_and_no_frame_is_left_out(dial: Dial) -> None:
    """Frames follow one another, ticks rise by one."""
    with in_session(dial) as peer:
        peer.spawn()
        welcome = peer.welcome
        frames = welcome.frame_rate // welcome.tick_rate
        seen = [peer.pose() for _ in range(3 * frames)]
        every = 1 if not welcome.lockstep else frames  # in lock-step a tick's last frame only
        numbers = [(pose.tick - 1) * frames + pose.frame + every * pose.lost for pose in seen]
        expect(numbers, list(range(numbers[0], numbers[0] + every * len(seen), every)), "frames")


def commands_are_acknowledged(dial: Dial) -> None:
    """Held keys as well as heading and behaviour, one after the other."""
    with in_session(dial) as peer:
        peer.spawn()
        for command in (
            m.Command(sequence=peer.next(), character=0, keys=m.Keys(view_yaw=0.5, forward=1)),
            m.Command(sequence=peer.next(), character=0, heading=1.0, behaviour=peer.welcome.behaviours[0]),
        ):
            sequence = command.sequence
            peer.say(command)
            expect(peer.pose_after(sequence).acknowledged, sequence, "acknowledged sequence")


def _moved(peer: Peer, kind: type[m.Correct] | type[m.Teleport], event: str) -> None:
    sequence = peer.next()
    peer.say(kind(sequence=sequence, character=0, x=-40.0, z=15.0, yaw=2.0))
    peer.event(event, sequence)
    _expect_near(peer.pose_after(sequence), -40.0, 15.0)


def a_correction_moves_a_character(dial: Dial) -> None:
    """An event, and the next pose is there."""
    with in_session(dial) as peer:
        peer.spawn()
        _moved(peer, m.Correct, "corrected")


def a_teleport_moves_a_character(dial: Dial) -> None:
    """An event, and the next pose is there."""
    with in_session(dial) as peer:
        peer.spawn()
        _moved(peer, m.Teleport, "teleported")


def a_despawned_character_is_shown_no_more(dial: Dial) -> None:
    """An event, and no pose after it."""
    with in_session(dial) as peer:
        peer.spawn(1)
        peer.spawn(2)
        sequence = peer.next()
        peer.say(m.Despawn(sequence=sequence, character=1))
        peer.step()
        while peer.hear(m.Event).kind != "despawned":
            pass
        expect({peer.pose().character for _ in range(4)}, {2}, "characters shown")


def events_are_sent_to_those_who_ask(dial: Dial) -> None:
    """What a character does at first is a change of behaviour; who does not ask gets its pose without one."""
    for asked in (m.EVENTS, ()):
        with in_session(dial, events=asked) as peer:
            peer.spawn()
            kinds = set()
            while not isinstance(message := peer.listen(PATIENCE), m.Pose):
                if isinstance(message, m.Event):
                    kinds.add(message.kind)
                elif message is None:
                    raise Failed(f"no pose in {PATIENCE:g} s")
            expect("behaviour" in kinds, bool(asked), "whether a behaviour was told")
