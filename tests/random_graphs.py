"""Random graphs of the kind that reduction works on: clips of originals, interpolated chains, transitions."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.training.path_cost import UNIT


class RandomGraph(NamedTuple):
    """The first arguments of ``reduced``, and which edges are natural."""

    nodes: int
    originals: int
    source: NDArray[np.int32]
    target: NDArray[np.int32]
    base: NDArray[np.int32]


def random_graph(
    seed: int, *, clips: int = 3, chains: int = 12, edges: int = 120, ties: bool = False, longest: int = 8
) -> RandomGraph:
    """Clips of 2 to ``longest`` frames, chains of 2 to 8, sorted edges of 1 to 6 frames, of few costs for ``ties``."""
    random = np.random.default_rng(seed)
    lengths = np.concatenate([random.integers(2, longest + 1, clips), random.integers(2, 9, chains)])
    count, originals = int(lengths.sum()), int(lengths[:clips].sum())
    natural = np.setdiff1d(np.arange(count), np.cumsum(lengths) - 1)
    steps = UNIT // 2 if ties else 1
    base = UNIT + steps * random.integers(0, 5 * UNIT // steps, edges)
    source = np.concatenate([natural, random.integers(0, count, edges)])
    target = np.concatenate([natural + 1, random.integers(0, count, edges)])
    base = np.concatenate([np.full(len(natural), UNIT), base])
    order = np.argsort(source, kind="stable")
    return RandomGraph(count, originals, *(array[order].astype(np.int32) for array in (source, target, base)))
