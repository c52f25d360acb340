"""How long it takes from one kind of motion to another, in both readings of Zhao and Safonova's (2008) table."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.study.breadth_first import UNREACHED, reversed_edges, ticks_from


@dataclass(frozen=True, eq=False)
class BehaviourTimes:
    """Seconds from kind a (row) to kind b (column), NaN where there is no way; kinds without frames are left out.

    Args:
        kinds: the words.
        least: from the frame of a that is nearest to b, to the nearest frame of b.  # (K, K)
        mean: from every frame of a that has a way to b, to the nearest frame of b.  # (K, K)
    """

    kinds: tuple[str, ...]
    least: NDArray[np.float64]
    mean: NDArray[np.float64]

    @property
    def mean_off_diagonal(self) -> tuple[float | None, float | None]:
        """Means of the least and of the mean times over the pairs of different kinds that have a way."""
        apart = ~np.eye(len(self.kinds), dtype=bool)
        known = [table[apart & np.isfinite(table)] for table in (self.least, self.mean)]
        return known[0].mean().item() if known[0].size else None, known[1].mean().item() if known[1].size else None

    def tables(self) -> dict[str, dict[str, dict[str, float | None]]]:
        """Both tables by words, JSON-able."""
        return {"least_s": _by_words(self.kinds, self.least), "mean_s": _by_words(self.kinds, self.mean)}


def behaviour_times(
    edge_start: NDArray, target: NDArray, kind: NDArray, kinds: Sequence[str], frames: NDArray | None = None
) -> BehaviourTimes:
    """Times between kinds of motion in a graph given in CSR form; ways may lead over any node.

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        kind: index into ``kinds`` of each node, -1 for none.  # (N,)
        kinds: the words, such as a graph's labels or behaviours.
        frames: the nodes that kinds consist of, such as the captured frames; all where not given.  # (F,)
    """
    nodes = np.arange(len(kind)) if frames is None else np.asarray(frames)
    sets = {index: nodes[kind[nodes] == index] for index in range(len(kinds))}
    shown = [index for index in sets if len(sets[index])]
    back = reversed_edges(edge_start, target)
    least, mean = (np.full((len(shown), len(shown)), np.nan) for _ in range(2))
    for column, end in enumerate(shown):
        ticks = ticks_from(*back, sets[end])
        for row, start in enumerate(shown):
            known = ticks[sets[start]]
            known = known[known != UNREACHED]
            if known.size:
                least[row, column], mean[row, column] = known.min() * TICK, known.mean() * TICK
    return BehaviourTimes(tuple(kinds[index] for index in shown), least, mean)


def _by_words(kinds: tuple[str, ...], table: NDArray) -> dict[str, dict[str, float | None]]:
    return {
        start: {end: float(value) if np.isfinite(value) else None for end, value in zip(kinds, row, strict=True)}
        for start, row in zip(kinds, table, strict=True)
    }
