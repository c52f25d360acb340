"""Sessions and a simulation driven by hand: what each message does, and each refusal."""

from dataclasses import replace

import numpy as np
import pytest

from footwork.motion.moves import LEAP
from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server
from footwork.protocol.errors import (
    BEHAVIOUR,
    CHARACTER_TAKEN,
    CHARACTER_UNKNOWN,
    CHARACTERS,
    MALFORMED,
    NO_SESSION,
    SESSIONS,
    SPEED,
    STATE,
    VERSION,
    LocalError,
)
from footwork.protocol.pose_arrays import root_of, rotations_of
from footwork.runtime.host import Host
from footwork.runtime.simulation import Simulation
from talk import BUNDLE, LIMITS, SECOND, Talk, codes, spawn, the_pose, walk
from toy_bundle import SHOWN, toy_bundle


@pytest.fixture
def talk():
    return Talk()


def test_the_welcome_tells_what_a_client_needs_to_draw(talk):
    talk.host.tick()
    welcome, skeleton = talk.open(b"a"), BUNDLE.graph.skeleton
    assert (welcome.tick, welcome.tick_rate, welcome.frame_rate) == (1, 30, 30)
    assert welcome.joints == skeleton.names
    assert welcome.parents == tuple(skeleton.parents)
    np.testing.assert_array_equal(welcome.offsets, skeleton.offsets)
    np.testing.assert_array_equal(welcome.ends, skeleton.ends)
    assert welcome.behaviours == SHOWN
    assert (welcome.clips, welcome.digest, welcome.attribution) == (
        BUNDLE.graph.clips,
        BUNDLE.digest,
        BUNDLE.attribution,
    )


def test_a_speed_is_taken_where_the_bundle_takes_one_and_refused_elsewhere():
    talk = Talk(bundle=toy_bundle(speeds={"walk": (0.5, 1.5), "run": (3.0,)}))
    assert talk.open(b"a").speeds == {"walk": (0.5, 1.5)}  # it shows no run
    talk.say(b"a", spawn(1, 0), walk(2, speed=1.0))
    assert not codes(talk.tick(b"a"))
    talk.say(b"a", walk(3, behaviour="stop", speed=1.0))
    error = next(answer for answer in talk.tick(b"a") if isinstance(answer, m.Error))
    assert (error.code, error.sequence, error.valid) == (SPEED, 3, ("walk",))


def test_a_bundle_without_speeds_takes_none(talk):
    assert talk.open(b"a").speeds == {}
    talk.say(b"a", spawn(1, 0), walk(2, speed=1.0))
    assert codes(talk.tick(b"a")) == [SPEED]


def test_a_character_appears_where_it_was_put_and_its_pose_follows_every_tick(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 7, x=3.0, z=-2.0, yaw=1.0, behaviour="jump"))
    event, pose = talk.tick(b"a")
    assert event == m.Event(tick=1, kind="spawned", character=7, sequence=1)
    assert (pose.tick, pose.frame, pose.character, pose.acknowledged) == (1, 1, 7, 1)
    assert np.hypot(*(root_of(pose)[[0, 2]] - [3.0, -2.0])) < 0.5
    assert rotations_of(pose).shape == (BUNDLE.graph.skeleton.joint_count, 4)
    np.testing.assert_allclose(np.linalg.norm(rotations_of(pose), axis=1), 1.0, atol=1e-5)
    assert [the_pose(talk.tick(b"a")).tick for _ in range(5)] == [2, 3, 4, 5, 6]


def test_a_pose_tells_the_source_of_its_frame(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="walk"))
    for _ in range(40):
        pose = the_pose(talk.tick(b"a"))
        node = talk.host.simulation.world.node[0]
        assert (pose.clip, pose.source_frame) == (BUNDLE.graph.clip[node], BUNDLE.graph.frame[node])
        assert SHOWN[pose.behaviour] == BUNDLE.graph.behaviours[BUNDLE.graph.behaviour[node]]
        world = talk.host.simulation.world
        assert world.edge[0] == LEAP or pose.transition != BUNDLE.graph.natural[world.edge[0]]
        assert pose.facing == talk.host.simulation.world.place[0, 2]


def test_a_command_takes_effect_in_the_next_tick_and_is_acknowledged_by_its_pose(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0))
    talk.tick(b"a")
    assert talk.say(b"a", walk(2), walk(9)) == []
    assert the_pose(talk.tick(b"a")).acknowledged == 9


def test_commands_change_what_a_character_does(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="stop"))
    for sequence, behaviour in ((2, "walk"), (3, "stop"), (4, "walk")):
        talk.say(b"a", walk(sequence, behaviour=behaviour))
        shown = [SHOWN[the_pose(talk.tick(b"a")).behaviour] for _ in range(60)]
        assert shown[8:] == [behaviour] * 52


def test_keys_do_the_same(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="stop"))
    for sequence, forward, behaviour in ((2, 1, "walk"), (3, 0, "stop")):
        talk.say(b"a", m.Command(sequence=sequence, character=0, keys=m.Keys(view_yaw=0.3, forward=forward)))
        shown = [SHOWN[the_pose(talk.tick(b"a")).behaviour] for _ in range(60)]
        assert shown[8:] == [behaviour] * 52


def test_a_jump_key_held_for_one_message_is_answered(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="walk"))
    talk.say(b"a", m.Command(sequence=2, character=0, keys=m.Keys(view_yaw=0.0, forward=1, jump=True)))
    talk.say(b"a", m.Command(sequence=3, character=0, keys=m.Keys(view_yaw=0.0, forward=1)))
    shown = [SHOWN[the_pose(talk.tick(b"a")).behaviour] for _ in range(20)]
    assert "jump" in shown
    assert shown[-1] == "walk"


def test_a_command_for_a_later_tick_waits_for_it(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0), walk(2, tick=4))
    assert [the_pose(talk.tick(b"a")).acknowledged for _ in range(5)] == [1, 1, 1, 2, 2]


def test_a_correction_moves_the_root_and_the_motion_goes_on(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="walk"))
    before = the_pose(talk.tick(b"a"))
    talk.say(b"a", m.Correct(sequence=2, character=0, x=50.0, z=-20.0, yaw=2.0))
    event, pose = talk.tick(b"a")
    assert event == m.Event(tick=2, kind="corrected", character=0, sequence=2)
    assert pose.acknowledged == 2
    assert np.hypot(*(root_of(pose)[[0, 2]] - [50.0, -20.0])) < 0.5
    assert abs(pose.facing - 2.0) < 0.5
    assert pose.source_frame == before.source_frame + 1


def test_despawn_ends_the_poses(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0), spawn(2, 1))
    talk.tick(b"a")
    talk.say(b"a", m.Despawn(sequence=3, character=0))
    event, pose = talk.tick(b"a")
    assert event == m.Event(tick=2, kind="despawned", character=0, sequence=3)
    assert pose.character == 1


@pytest.mark.parametrize("frame_rate", [30, 60, 120])
def test_a_tick_is_shown_in_frame_rate_over_thirty_frames(frame_rate):
    talk = Talk(frame_rate)
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="walk"))
    poses = [message for _ in range(4) for message in talk.tick(b"a") if isinstance(message, m.Pose)]
    frames = frame_rate // 30
    assert [(pose.tick, pose.frame) for pose in poses] == [(t, f) for t in range(1, 5) for f in range(1, frames + 1)]
    steps = np.linalg.norm(np.diff([root_of(pose) for pose in poses], axis=0), axis=1)
    assert steps.max() < 0.12 / frames


def test_ping_is_answered_at_once(talk):
    talk.open(b"a")
    assert talk.say(b"a", m.Ping(nonce=5)) == [m.Pong(nonce=5, tick=0)]


def test_two_sessions_may_use_the_same_numbers(talk):
    for peer, x in ((b"a", 0.0), (b"b", 100.0)):
        talk.open(peer)
        talk.say(peer, spawn(1, 0, x=x))
    talk.host.tick()
    (one,), (other,) = talk.poses(b"a"), talk.poses(b"b")
    assert root_of(other)[0] - root_of(one)[0] == pytest.approx(100.0, abs=0.5)


def test_another_version_is_turned_away(talk):
    error, bye = talk.say(b"a", m.Hello(version=2))
    assert (error.code, bye) == (VERSION, m.Bye(reason="version"))
    assert "expected 1" in error.message
    assert codes(talk.say(b"a", m.Ping())) == [NO_SESSION]


def test_a_full_server_turns_away_and_has_room_again_after_a_bye(talk):
    for peer in (b"a", b"b", b"c"):
        talk.open(peer)
    error, bye = talk.say(b"d", m.Hello(version=1))
    assert (error.code, bye.reason) == (SESSIONS, "sessions")
    talk.say(b"a", m.Bye())
    talk.open(b"d")


def test_a_stranger_must_say_hello_first(talk):
    (error,) = talk.say(b"a", walk(5))
    assert (error.code, error.sequence) == (NO_SESSION, 5)


def test_a_second_hello_is_out_of_place(talk):
    talk.open(b"a")
    assert codes(talk.say(b"a", m.Hello(version=1))) == [STATE]


def test_an_unknown_behaviour_lists_those_the_bundle_has(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0), walk(2, behaviour="run"))
    _, error, pose = talk.tick(b"a")
    assert (error.code, error.sequence, error.valid) == (BEHAVIOUR, 2, SHOWN)
    assert "stop, walk, jump" in error.message
    assert pose.acknowledged == 1


def test_spawns_over_the_limits_are_refused(talk):
    talk.open(b"a")
    talk.open(b"b")
    talk.say(b"a", *(spawn(n, n) for n in range(1, 5)))
    assert codes(talk.tick(b"a")) == [CHARACTERS]
    talk.say(b"b", spawn(1, 1), spawn(2, 2))
    assert codes(talk.tick(b"b")) == [CHARACTERS]
    talk.say(b"a", m.Bye())
    talk.say(b"b", spawn(3, 2))
    assert codes(talk.tick(b"b")) == []


def test_characters_that_are_taken_or_unknown_are_refused(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0), spawn(2, 0))
    assert codes(talk.tick(b"a")) == [CHARACTER_TAKEN]
    talk.say(b"a", walk(3, 5), m.Despawn(sequence=4, character=6))
    assert codes(talk.tick(b"a")) == [CHARACTER_UNKNOWN, CHARACTER_UNKNOWN]
    talk.say(b"a", m.Correct(sequence=5, character=8, x=0.0, z=0.0, yaw=0.0))
    assert codes(talk.tick(b"a")) == [CHARACTER_UNKNOWN]


def test_garbage_gets_a_bounded_number_of_errors_a_tick(talk):
    talk.open(b"a")
    for _ in range(50):
        talk.host.receive(b"a", b"garbage", 0)
        talk.host.receive(b"stranger", b"garbage", 0)
    outgoing = [(peer, decode_from_server(data)) for peer, data in talk.host.outgoing()]
    assert [(peer, codes([message])) for peer, message in outgoing] == [
        (b"a", [MALFORMED]),
        (b"stranger", [MALFORMED]),
    ] * 2
    talk.host.tick()
    assert codes(talk.say(b"a", m.Hello(version=1))) == [STATE]


def test_many_strangers_do_not_make_the_host_remember_them(talk):
    for number in range(1000):
        talk.host.receive(number.to_bytes(4, "big"), b"garbage", 0)
    assert len(talk.host.outgoing()) <= 4 * LIMITS.sessions
    assert talk.host.refused == 1000


def test_silence_ends_a_session_and_its_characters(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0))
    talk.tick(b"a")
    talk.host.end_overdue(SECOND)
    assert talk.answers(b"a") == []
    talk.host.end_overdue(SECOND + 1)
    assert talk.answers(b"a") == [m.Bye(reason="idle")]
    assert not talk.host.simulation.world.active.any()
    assert talk.tick(b"a") == []


def test_all_are_told_of_the_end(talk):
    for peer in (b"a", b"b"):
        talk.open(peer)
    talk.host.end_all("shutdown")
    assert sorted(peer for peer, _ in talk.host.outgoing()) == [b"a", b"b"]
    assert talk.host.sessions == {}


def test_the_same_commands_give_the_same_bytes():
    runs = []
    for _ in range(2):
        talk = Talk()
        talk.open(b"a")
        talk.say(b"a", spawn(1, 0))
        poses = []
        for sequence in range(2, 60):
            talk.say(b"a", walk(sequence, behaviour=SHOWN[sequence // 7 % 2]))
            talk.host.tick()
            poses += [pose for _, _, pose in talk.host.poses(1)]
        runs.append(poses)
    assert runs[0] == runs[1]


def test_a_bundle_the_wire_cannot_hold_is_refused_at_the_start():
    bundle = replace(BUNDLE, digest="x" * 65)
    with pytest.raises(LocalError, match="digest"):
        Host(Simulation(bundle, 1), 30, LIMITS)


def test_a_teleport_puts_a_character_elsewhere_without_what_smooths_it(talk):
    talk.open(b"a")
    talk.say(b"a", spawn(1, 0, behaviour="stop"), walk(2))
    for _ in range(12):
        talk.tick(b"a")
    talk.say(b"a", m.Teleport(sequence=3, character=0, x=50.0, z=-20.0, yaw=2.0))
    event, pose = talk.tick(b"a")
    assert event == m.Event(tick=13, kind="teleported", character=0, sequence=3)
    assert pose.acknowledged == 3
    assert np.hypot(*(root_of(pose)[[0, 2]] - [50.0, -20.0])) < 0.5
