"""What an edge costs a path: a weighted mean of its length and its roughness, in whole units (conventions.md 4)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

UNIT = 1024  # of one frame: sums of whole numbers are exact, so that paths compare the same in every order
ROUGHNESS = 5.0  # frames of detour that avoiding an edge of no smoothness at all is worth

_PART = 1 << 20


def path_costs(cost: ArrayLike, sigma: float) -> NDArray[np.int32]:
    """Cost of each edge to a path, 1 / UNIT frames: from UNIT for edges of no distance, natural ones too, to 6 UNIT.

    1 + 5 (1 - t) frames with the smoothness t = exp(-s / sigma) of Zhao and Safonova (2008), whose weights are not
    stated; the 5 is convention.

    Args:
        cost: s of each edge, 0 for natural edges.  # (E,)
        sigma: the task's smoothness_sigma, above 0.
    """
    costs = np.asarray(cost)
    units = np.empty(len(costs), dtype=np.int32)
    # a part at a time: graphs may have a hundred million edges
    for begin in range(0, len(costs), _PART):
        part = slice(begin, begin + _PART)
        rough = -np.expm1(-costs[part].astype(np.float64) / sigma)
        units[part] = np.rint(UNIT * (1.0 + ROUGHNESS * rough))
    return units
