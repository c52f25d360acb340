"""What the characters of a recording did, as it was shown."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.clip import Clip
from footwork.motion.glb_writer import Part
from footwork.motion.tick import TICK_RATE
from footwork.runtime import recording as r
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
    """Keeps the poses of a replay by character: a slot may hold several, one after the other."""

    def __init__(self, replay: Replay) -> None:
        self._replay = replay
        self._kept = 0
        self._spawned = {slot: [] for slot in range(replay.recording.header.capacity)}
        self.characters: dict[tuple[int, int], _Character] = {}
        for record in replay.recording.records:
            if isinstance(record, r.Spawned) and record.slot in self._spawned:
                self._spawned[record.slot].append(record.tick)

    def see(self, tick: int, poses: NDArray[np.float32]) -> None:
        """Take the poses (ticks, frames, characters, 3 + 4 J) of the ticks up to one."""
        self._kept += poses.size
        if self._kept > MAX_NUMBERS:
            raise InputError("shows more than can be exported at once", self._replay.recording.where)
        first = tick - len(poses) + 1
        for row, slot in enumerate(self._replay.simulation.world.slots.tolist()):
            born = sum(spawned <= first for spawned in self._spawned[slot])
            character = self.characters.setdefault((slot, born), _Character(first))
            character.poses.append(poses[:, :, row].copy())


def recorded_motion(recording: r.Recording, bundle: Bundle) -> list[Part]:
    """What every character of a recording did, as it was shown: smoothed, with held feet, at the recorded rate.

    Args:
        recording: what took effect.
        bundle: what it was recorded with.

    Returns:
        A part for each character, called ``character 0`` and so on in the order in which they came; they start when
        each was first shown after the first of them.

    Raises:
        InputError: as ``Replay``, for a recording of nobody, and for one that is too long.
    """
    replay = Replay(recording, bundle)
    watch = _Watch(replay)
    replay.run(watch.see)
    characters = sorted(watch.characters.values(), key=lambda character: character.first)
    if not characters:
        raise InputError("shows no character, expected at least one", recording.where)
    rate = float(recording.header.rate)
    begin = characters[0].first
    return [
        Part(f"character {number}", _clip(bundle, character, rate, number), (character.first - begin) / TICK_RATE)
        for number, character in enumerate(characters)
    ]


def _clip(bundle: Bundle, character: _Character, rate: float, number: int) -> Clip:
    skeleton = bundle.graph.skeleton
    poses = np.concatenate(character.poses).astype(np.float64).reshape(-1, 3 + 4 * skeleton.joint_count)
    rotations = poses[:, 3:].reshape(len(poses), -1, 4)
    return Clip(f"character {number}", skeleton, rate, poses[:, :3], rotations)
