"""How long fighters' decisions take, each one made many times over in compiled code."""

import time
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.prediction import Paths, begin_paths
from footwork.controllers.supervisor import Minds, decide
from footwork.runtime.match import Match

_TIMES, _TRIES = 40, 3


@numba.njit(cache=True, nogil=True)
def _decide_often(
    minds: Minds, fighters: NDArray, who: int, paths: Paths, node: NDArray, place: NDArray, times: int
) -> int:
    """The sum of the edges decided on, so that no decision is left out."""
    edges = 0
    for _ in range(times):
        begin_paths(fighters, node, place, paths)
        edges += decide(minds, fighters, who, paths)[2]
    return edges


def decision_pace(match: Match, decisions: int) -> dict[str, float]:
    """Microseconds of so many decisions of a match, which goes on meanwhile: ``p50`` and ``p99``.

    A call with no decision in it is taken off; of a few tries the quickest counts, so that a busy machine does not.
    """
    times: list[float] = []
    _seconds(match, 0, 1)  # compiles
    while len(times) < decisions:
        for who in range(2):
            if match.undecided(who):
                often, never = (min(_seconds(match, who, n) for _ in range(_TRIES)) for n in (_TIMES, 0))
                times.append(1e6 * max(often - never, 0.0) / _TIMES)
        match.step()
    p50, p99 = np.percentile(times[:decisions], [50, 99]).tolist()
    return {"p50": p50, "p99": p99}


def _seconds(match: Match, who: int, times: int) -> float:
    fighters = match.fighters.copy()
    about: Any = match.minds, fighters, who, match.room.paths, match.world.node, match.world.place, times
    start = time.perf_counter()
    _decide_often(*about)
    return time.perf_counter() - start
