"""What the characters of a recording did, as it was shown."""

from collections import Counter, deque
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.clip import Clip
from footwork.motion.glb_writer import Part
from footwork.motion.tick import TICK_RATE
from footwork.runtime import recording as r
from footwork.runtime.fight_recording import is_fight, replay_fight
from footwork.runtime.replay import Replay

MAX_NUMBERS = 1 << 27
"""Of all poses of a recording that are kept: some ten hours of one character at 30 Hz."""


@dataclass
class _Character:
    """One character of a recording.

    Args:
        first: the tick at which it is first shown.
        poses: of a run of ticks each.  # (ticks, frames, 3 + 4 J)
    """

    first: int
    poses: list[NDArray[np.float32]] = field(default_factory=list)


class _Watch:
    """Keeps the poses of a replay by character.

    Args:
        who: the characters that a run of ticks shows, by the first of them: in the order of their rows.
        where: the recording, for messages.
    """

    def __init__(self, who: Callable[[int], Sequence[Hashable]], where: str) -> None:
        self._who, self._where, self._kept = who, where, 0
        self.characters: dict[Hashable, _Character] = {}

    def see(self, tick: int, poses: NDArray[np.float32]) -> None:
        """Take the poses (ticks, frames, characters, 3 + 4 J) of the ticks up to one."""
        self._kept += poses.size
        if self._kept > MAX_NUMBERS:
            raise InputError("shows more than can be exported at once", self._where)
        first = tick - len(poses) + 1
        for row, name in enumerate(self._who(first) if len(poses) else ()):
            character = self.characters.setdefault(name, _Character(first))
            character.poses.append(poses[:, :, row].copy())


class Occupants:
    """Who is in which slot of a recording, as its ticks go by: a slot may hold several, one after the other."""

    def __init__(self, recording: r.Recording) -> None:
        self._coming = deque(record for record in recording.records if isinstance(record, r.Spawned))
        opposed = bool(recording.records) and isinstance(recording.records[0], r.Opposed)
        self._company = range(2 if opposed else 1)
        self._born: Counter[int] = Counter()

    def at(self, tick: int, slots: NDArray[np.intp]) -> list[tuple[int, int]]:
        """A name for whom each slot holds in a tick that is not before the one asked for last.  # (n,)"""
        while self._coming and self._coming[0].tick <= tick:
            slot = self._coming.popleft().slot
            self._born.update(slot + more for more in self._company)
        return [(self._born[slot], slot) for slot in slots.tolist()]


def recorded_motion(recording: r.Recording, bundle: Bundle) -> list[Part]:
    """What every character of a recording did, as it was shown: smoothed, with held feet, at the recorded rate.

    Args:
        recording: what took effect, or a match.
        bundle: what it was recorded with.

    Returns:
        A part for each character, called ``character 0`` and so on in the order in which they came; they start when
        each was first shown after the first of them.

    Raises:
        InputError: as ``Replay``, for a recording of nobody, and for one that is too long.
    """
    watch = _fight(recording, bundle) if is_fight(recording) else _game(recording, bundle)
    characters = sorted(watch.characters.values(), key=lambda character: character.first)
    if not characters:
        raise InputError("shows no character, expected at least one", recording.where)
    rate = float(recording.header.rate)
    begin = characters[0].first
    return [
        Part(f"character {number}", _clip(bundle, character, rate, number), (character.first - begin) / TICK_RATE)
        for number, character in enumerate(characters)
    ]


def _fight(recording: r.Recording, bundle: Bundle) -> _Watch:
    watch = _Watch(lambda _: (0, 1), recording.where)
    replay_fight(recording, bundle, watch.see)
    return watch


def _game(recording: r.Recording, bundle: Bundle) -> _Watch:
    replay, occupants = Replay(recording, bundle), Occupants(recording)
    watch = _Watch(lambda first: occupants.at(first, replay.simulation.world.slots), recording.where)
    replay.run(watch.see)
    return watch


def _clip(bundle: Bundle, character: _Character, rate: float, number: int) -> Clip:
    skeleton = bundle.graph.skeleton
    poses = np.concatenate(character.poses).astype(np.float64).reshape(-1, 3 + 4 * skeleton.joint_count)
    rotations = poses[:, 3:].reshape(len(poses), -1, 4)
    return Clip(f"character {number}", skeleton, rate, poses[:, :3], rotations)
