"""How long the shortest way from one frame to another takes: the mean over pairs of frames, exact or from a sample.

The transition time of Zhao and Safonova (2008). Convention: pairs of two different frames, those only that have a way
between them, every edge one tick.
"""

import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student_t

from footwork.errors import InputError
from footwork.motion.threads import THREADS
from footwork.motion.tick import TICK

CONFIDENCE = 0.95
_AT_ONCE = 64  # sources that share one search: a bit each of a machine word


@dataclass(frozen=True, eq=False)
class TransitionTimes:
    """The shortest ways between frames.

    Args:
        frames: how many frames there are.
        sources: the frames that ways were sought from, all of them or a sample.  # (S,)
        reached: other frames that each source reaches.  # (S,)
        ticks: the sum of the ticks to them.  # (S,)
        histogram: pairs by the ticks of their way; entry 0 is always 0.  # (longest + 1,)
    """

    frames: int
    sources: NDArray[np.int32]
    reached: NDArray[np.int64]
    ticks: NDArray[np.int64]
    histogram: NDArray[np.int64]

    @property
    def exact(self) -> bool:
        """Whether every frame was a source."""
        return len(self.sources) == self.frames

    @property
    def mean(self) -> float | None:
        """Mean seconds over the pairs that have a way, None without any."""
        pairs = int(self.reached.sum())
        return float(self.ticks.sum() * TICK / pairs) if pairs else None

    @property
    def interval(self) -> tuple[float, float] | None:
        """Where the mean over all frames lies with 95 % confidence, seconds; None where that cannot be told.

        Textbook ratio estimate over sources drawn without replacement (Cochran 1977, 6.3), Student's t for few.
        """
        mean, count = self.mean, len(self.sources)
        if mean is None or self.exact:
            return None if mean is None else (mean, mean)
        if count < 2:
            return None
        left = self.ticks * TICK - mean * self.reached
        spread = (1.0 - count / self.frames) * float(left @ left) / (count - 1) / count
        margin = float(student_t.ppf(0.5 + 0.5 * CONFIDENCE, count - 1)) * math.sqrt(spread) / self.reached.mean()
        return mean - float(margin), mean + float(margin)

    @property
    def reachable_share(self) -> float:
        """Share of the ordered pairs of different frames that have a way; 1 for a single frame."""
        pairs = len(self.sources) * (self.frames - 1)
        return float(self.reached.sum() / pairs) if pairs else 1.0

    def percentile(self, share: float) -> float | None:
        """Seconds that a share (0..1) of the ways do not exceed, None without any."""
        total = np.cumsum(self.histogram)
        return float(np.searchsorted(total, share * total[-1])) * TICK if total[-1] else None

    def summary(self) -> dict[str, Any]:
        """The figures, JSON-able."""
        return {
            "mean_s": self.mean,
            "interval_95_s": list(self.interval) if self.interval and not self.exact else None,
            "median_s": self.percentile(0.5),
            "p95_s": self.percentile(0.95),
            "longest_s": self.percentile(1.0),
            "sources": len(self.sources),
            "exact": self.exact,
        }


def transition_times(
    edge_start: NDArray, target: NDArray, frames: NDArray, *, sources: int | None = None, seed: int = 0
) -> TransitionTimes:
    """The ways between frames of a graph given in CSR form.

    Sixty-four sources are sought from at once, a bit each: neighbouring frames reach the same nodes at much the same
    times, so that an edge is looked at once for many of them (Then and others 2014, The more the merrier).

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        frames: the nodes that count, such as the captured frames, ascending.  # (F,)
        sources: seek from so many frames drawn at random instead of from all.
        seed: of the draw.

    Raises:
        InputError: for no frames, or fewer than one source.
    """
    frames = np.asarray(frames, dtype=np.int32)
    if not len(frames):
        raise InputError("no captured frames among the nodes, expected at least 1", "transition times")
    if sources is not None and sources < 1:
        raise InputError(f"{sources} sources, expected at least 1", "transition times")
    chosen = frames
    if sources is not None and sources < len(frames):
        chosen = np.sort(np.random.default_rng(seed).choice(frames, sources, replace=False))
    counts = np.zeros(len(edge_start) - 1, dtype=np.bool_)
    counts[frames] = True
    with ThreadPoolExecutor(THREADS) as pool:
        parts = list(pool.map(lambda some: _search(edge_start, target, counts, some), _batches(chosen)))
    histogram = np.sum([part[2] for part in parts], axis=0)
    longest = int(np.flatnonzero(histogram).max(initial=0))
    return TransitionTimes(
        frames=len(frames),
        sources=chosen,
        reached=np.concatenate([part[0] for part in parts]),
        ticks=np.concatenate([part[1] for part in parts]),
        histogram=histogram[: longest + 1],
    )


def _batches(sources: NDArray[np.int32]) -> Iterator[NDArray[np.int32]]:
    for first in range(0, len(sources), _AT_ONCE):
        yield sources[first : first + _AT_ONCE]


def _search(edge_start: NDArray, target: NDArray, counts: NDArray, sources: NDArray) -> tuple[NDArray, ...]:
    """Frames reached from each source (S,), ticks to them (S,) and pairs by ticks (N + 1,)."""
    nodes = len(counts)
    reached, ticks = (np.zeros(len(sources), dtype=np.int64) for _ in range(2))
    histogram = np.zeros(nodes + 1, dtype=np.int64)
    seen, here, ahead = (np.zeros(nodes, dtype=np.uint64) for _ in range(3))
    active, coming = (np.empty(nodes, dtype=np.int32) for _ in range(2))
    seen[sources] = here[sources] = np.uint64(1) << np.arange(len(sources), dtype=np.uint64)
    active[: len(sources)] = sources
    waiting, tick = len(sources), 0
    while waiting:
        tick += 1
        found = _advance(edge_start, target, active[:waiting], seen, here, ahead, coming)
        _arrive(active[:waiting], coming[:found], seen, here, ahead, counts, tick, reached, ticks, histogram)
        active, coming, waiting = coming, active, found
    return reached, ticks, histogram


@numba.njit(cache=True, nogil=True)
def _advance(
    edge_start: NDArray,
    target: NDArray,
    active: NDArray,
    seen: NDArray,
    here: NDArray,
    ahead: NDArray,
    coming: NDArray,
) -> int:
    """Carry the sources of the active nodes one tick on; fill and count the nodes that some reach for the first time.

    Bit b of a node's word stands for source b: in ``seen`` those that have reached it, in ``here`` those that did so in
    this tick, in ``ahead`` those that do so in the next one.
    """
    found = 0
    none = np.uint64(0)
    for node in active:
        for edge in range(edge_start[node], edge_start[node + 1]):
            end = target[edge]
            new = here[node] & ~seen[end]
            if new != none:
                if ahead[end] == none:
                    coming[found] = end
                    found += 1
                ahead[end] |= new
    return found


@numba.njit(cache=True, nogil=True)
def _arrive(
    active: NDArray,
    coming: NDArray,
    seen: NDArray,
    here: NDArray,
    ahead: NDArray,
    counts: NDArray,
    tick: int,
    reached: NDArray,
    ticks: NDArray,
    histogram: NDArray,
) -> None:
    """Make the next tick this one, and count the frames that sources have come to."""
    one, none = np.uint64(1), np.uint64(0)
    for node in active:
        here[node] = none
    for node in coming:
        new = ahead[node]
        seen[node] |= new
        here[node], ahead[node] = new, none
        if counts[node]:
            for bit in range(reached.shape[0]):
                if (new >> np.uint64(bit)) & one != none:
                    reached[bit] += 1
                    ticks[bit] += tick
                    histogram[tick] += 1
