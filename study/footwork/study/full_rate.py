"""Comparing frames at the rate of the capture, with windows, blends and contacts as they are at 30 Hz.

The capture is taken at 30 Hz once from each of its first frames on; a frame of any of these clips may go with any
frame of any other, so every captured frame is compared with every other.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from footwork.motion.clip import Clip
from footwork.motion.frame_tables import FrameRange
from footwork.motion.tick import TICK_RATE
from footwork.study.blends import inside
from footwork.study.transition_picks import Ranking, knee_of, median_of_pairs
from footwork.training.dataset import load_clips
from footwork.training.knee import distinct
from footwork.training.transitions import MIN_GAP, Minima, local_minima


@dataclass(frozen=True, eq=False)
class FullRate:
    """A stretch of capture as clips at 30 Hz, one from each of its first few frames on.

    Args:
        clips: clip p holds the captured frames p, p + P, p + 2 P ...
    """

    clips: Sequence[Clip]

    @property
    def lengths(self) -> list[int]:
        """Frames of each clip."""
        return [clip.frame_count for clip in self.clips]

    def in_time(self) -> NDArray[np.intp]:
        """The number, through the clips laid end to end, of each captured frame in turn.  # (N,)"""
        phase = np.repeat(np.arange(len(self.clips)), self.lengths)
        frame = np.concatenate([np.arange(length) for length in self.lengths])
        return np.argsort(frame * len(self.clips) + phase, kind="stable")


def full_rate_of(folder: Path, part: FrameRange, phases: int) -> FullRate:
    """The clips of a part of a file whose rate is ``phases`` times 30 Hz.

    Raises:
        InputError: as ``load_clips``.
    """
    clips = []
    with TemporaryDirectory() as place:
        table = Path(place) / "ranges.csv"
        for phase in range(phases):
            row = f"{folder.name},{part.file},{part.start + phase},{part.end}"
            table.write_text(f"set,file,start_frame,end_frame\n{row}\n", encoding="utf-8")
            clips += load_clips(folder, ranges=table).clips
    return FullRate(clips)


def phases_of(source_fps: float) -> int:
    """How many clips a rate needs; 1 for one that is no multiple of 30 Hz."""
    times = round(source_fps / TICK_RATE)
    return times if times > 1 and abs(source_fps - times * TICK_RATE) < 1e-6 else 1


def full_rate_ranking(costs: NDArray[np.float64], capture: FullRate, most: int) -> Ranking:
    """The ranking over every captured frame; its frames are numbered through the clips laid end to end.

    Distances in time, and how many ranks the knee is looked for in, are as at 30 Hz.

    Args:
        costs: s of every pair, frames numbered so.  # (N, N)
        capture: the clips.
        most: places to keep.
    """
    order, phases = capture.in_time(), len(capture.clips)
    ordered = costs[np.ix_(order, order)]
    near = np.arange(len(ordered))
    for apart in range(phases * MIN_GAP):
        ordered[near[apart:], near[: len(near) - apart]] = ordered[near[: len(near) - apart], near[apart:]] = np.inf
    minima = local_minima(ordered, [len(ordered)])
    whole = inside(capture.lengths, order[minima.i]) & inside(capture.lengths, order[minima.j])
    i, j, cost = minima.i[whole], minima.j[whole], minima.cost[whole]
    slow, length = Minima(i // phases, j // phases, cost), [-(-len(ordered) // phases)]
    median = median_of_pairs(costs)
    knee = knee_of(slow, length, median)
    kept = distinct(slow, length, max(most, knee.rank if knee else 0)).cost
    by_cost = np.argsort(cost, kind="stable")
    chosen = by_cost[np.searchsorted(cost[by_cost], kept)]
    return Ranking(Minima(order[i[chosen]], order[j[chosen]], cost[chosen]), knee, median)
