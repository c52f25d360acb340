"""A player that plays by itself: what a person might do in half a minute, over a real socket, with what came back."""

import time
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from footwork.motion.angle import wrapped
from footwork.motion.keys import heading_of_keys
from footwork.protocol.client import Client
from footwork.protocol.messages import Keys, Pose

CHARACTER = 0
COMMANDS_A_SECOND = 50.0  # unlike the tick rate, so that commands fall at every moment of a tick


class _Phase(NamedTuple):
    seconds: float
    view_deg: float
    forward: int = 0
    strafe: int = 0
    run: bool = False
    jump: bool = False


_SCRIPT = (  # played over and over
    _Phase(0.7, 0),
    _Phase(2.3, 0, forward=1),
    _Phase(2.0, 90, forward=1),
    _Phase(2.0, 90, forward=1, run=True),
    _Phase(1.5, 0, forward=1, run=True),
    _Phase(0.5, 0, forward=1, jump=True),
    _Phase(1.5, 0, forward=1, strafe=1),
    _Phase(1.5, 0, forward=1, strafe=-1),
    _Phase(2.0, 180, forward=1),
    _Phase(1.0, 180),
)
_ENDS = np.cumsum([phase.seconds for phase in _SCRIPT])


@dataclass
class Played:
    """What was sent and what came back.

    Args:
        command_to_pose_ms: from each command's send to the first pose that acknowledges it or a later one.
        heading_error_deg: between the facing and the heading asked for, at each tick while moving was asked for.
        poses: how many poses came.
        travelled_m: how far the root went over the ground.
    """

    command_to_pose_ms: list[float] = field(default_factory=list)
    heading_error_deg: list[float] = field(default_factory=list)
    poses: int = 0
    travelled_m: float = 0.0


def keys_at(seconds: float) -> Keys:
    """The keys that the script holds after ``seconds`` of play."""
    phase = _SCRIPT[int(np.searchsorted(_ENDS, seconds % _ENDS[-1], side="right"))]
    view = float(np.radians(phase.view_deg))
    return Keys(view_yaw=view, forward=phase.forward, strafe=phase.strafe, run=phase.run, jump=phase.jump)


def play(client: Client, seconds: float) -> Played:
    """Spawn a character and steer it by the script for ``seconds``.

    Raises:
        RefusedError: where the server refuses something or ends the session.
    """
    player = _Player(client)
    client.spawn(CHARACTER)
    start = time.perf_counter()
    sends = 0
    while (now := time.perf_counter() - start) < seconds:
        if now >= sends / COMMANDS_A_SECOND:
            player.send(keys_at(now))
            sends += 1
            continue
        player.receive(sends / COMMANDS_A_SECOND - now)
    return player.played


class _Player:
    def __init__(self, client: Client) -> None:
        self.played = Played()
        self._client = client
        self._unanswered: dict[int, tuple[float, Keys]] = {}
        self._held: Keys | None = None
        self._tick = -1
        self._root: np.ndarray | None = None

    def send(self, keys: Keys) -> None:
        sent = time.perf_counter()
        self._unanswered[self._client.keys(CHARACTER, keys)] = (sent, keys)

    def receive(self, timeout: float) -> None:
        message = self._client.listen(timeout)
        if isinstance(message, Pose):
            self._answer(message, time.perf_counter())
            self._follow(message)

    def _answer(self, pose: Pose, now: float) -> None:
        answered = [sequence for sequence in self._unanswered if sequence <= pose.acknowledged]
        for sequence in answered:
            sent, self._held = self._unanswered.pop(sequence)
            self.played.command_to_pose_ms.append(1000.0 * (now - sent))

    def _follow(self, pose: Pose) -> None:
        self.played.poses += 1
        root = np.frombuffer(pose.root, dtype="<f4")[[0, 2]]
        if self._root is not None:
            self.played.travelled_m += float(np.hypot(*(root - self._root)))
        self._root = root
        if pose.tick != self._tick and self._held and (self._held.forward or self._held.strafe):
            self.played.heading_error_deg.append(_heading_error(pose, self._held))
        self._tick = pose.tick


def _heading_error(pose: Pose, keys: Keys) -> float:
    wanted = heading_of_keys(keys.view_yaw, keys.forward, keys.strafe)
    return float(np.degrees(np.abs(wrapped(wanted - pose.facing))))
