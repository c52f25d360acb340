"""A host driven by hand, and short ways to say things to it."""

from collections.abc import Callable

from footwork.motion.bundle import Bundle
from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server, encode
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.simulation import Simulation
from toy_bundle import toy_bundle

LIMITS = Limits(sessions=3, characters=4, session_characters=3, errors_per_tick=2, idle_seconds=1.0)
BUNDLE = toy_bundle()
SECOND = 1_000_000_000


class Talk:
    """A host, and what it said to whom."""

    def __init__(
        self,
        frame_rate: int = 30,
        *,
        lockstep: bool = False,
        bundle: Bundle = BUNDLE,
        simulate: Callable[[Bundle, int], Simulation] = Simulation,
        **others: Bundle,
    ) -> None:
        bundles = {"bundle": bundle, **others}
        simulations = {name: simulate(each, LIMITS.characters) for name, each in bundles.items()}
        self.host = Host(simulations, frame_rate, LIMITS, lockstep=lockstep)
        self.frames = frame_rate // 30
        self.now = 0

    def say(self, peer: bytes, *messages: m.FromClient) -> list[m.FromServer]:
        for message in messages:
            self.host.receive(peer, encode(message), self.now)
        return self.answers(peer)

    def answers(self, peer: bytes) -> list[m.FromServer]:
        return [decode_from_server(data) for whom, data in self.host.outgoing() if whom == peer]

    def tick(self, peer: bytes) -> list[m.FromServer]:
        """What a peer gets at the next tick: events and errors, then all its poses."""
        self.host.tick()
        poses = [pose for frame in range(1, self.frames + 1) for pose in self.poses(peer, frame)]
        return self.answers(peer) + poses

    def poses(self, peer: bytes, frame: int = 1) -> list[m.Pose]:
        """What a peer is shown at a frame of the tick last made."""
        return [decode_pose(pose) for whom, _, pose in self.host.poses(frame) if whom == peer]

    def open(self, peer: bytes, **fields) -> m.Welcome:
        (welcome,) = self.say(peer, m.Hello(version=1, client="test", **fields))
        assert isinstance(welcome, m.Welcome)
        return welcome


def spawn(sequence: int, character: int, **fields) -> m.Spawn:
    return m.Spawn(sequence=sequence, character=character, **fields)


def walk(sequence: int, character: int = 0, behaviour: str = "walk", **fields) -> m.Command:
    return m.Command(sequence=sequence, character=character, heading=0.0, behaviour=behaviour, **fields)


def decode_pose(data: bytes) -> m.Pose:
    pose = decode_from_server(data)
    assert isinstance(pose, m.Pose)
    return pose


def codes(messages: list[m.FromServer]) -> list[str]:
    return [message.code for message in messages if isinstance(message, m.Error)]


def the_pose(messages: list[m.FromServer]) -> m.Pose:
    (pose,) = [message for message in messages if isinstance(message, m.Pose)]
    return pose
