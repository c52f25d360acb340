"""What an edge costs a path: a weighted mean of its length and its roughness, in whole units (conventions.md 4)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

UNIT = 1024  # of one frame: sums of whole numbers are exact, so that paths compare the same in every order
ROUGHNESS = 5.0  # frames of detour that avoiding an edge of no smoothness at all is worth


def path_costs(cost: ArrayLike, natural: ArrayLike, sigma: float) -> NDArray[np.int32]:
    """Cost of each edge to a path, 1 / UNIT frames: UNIT for natural edges, from UNIT to 6 UNIT for the others.

    1 + 5 (1 - t) frames with the smoothness t = exp(-s / sigma) of Zhao and Safonova (2008), whose weights are not
    stated; the 5 is convention.

    Args:
        cost: s of each edge.  # (E,)
        natural: which edges follow the capture.  # (E,)
        sigma: the task's smoothness_sigma, above 0.
    """
    rough = -np.expm1(-np.asarray(cost, dtype=np.float64) / sigma)
    units = np.rint(UNIT * (1.0 + ROUGHNESS * rough)).astype(np.int32)
    units[np.asarray(natural, dtype=bool)] = UNIT
    return units
