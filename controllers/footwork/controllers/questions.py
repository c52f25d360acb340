"""Whether what a controller is asked about is there at all."""

import numba
from numpy.typing import NDArray

from footwork.errors import FootworkError


class WrongQuestion(FootworkError):  # noqa: N818  (it reads as what happened)
    """A controller was asked about a node or a behaviour that its table does not have."""


def require_indices(index: NDArray, length: int, name: str) -> None:
    """Raise WrongQuestion unless all are indices into ``length`` things."""
    wrong = _first_outside(index, length)
    if wrong >= 0:
        raise WrongQuestion(f"{name} {index[wrong]} of character {wrong}, expected 0 to {length - 1}")


@numba.njit(cache=True, nogil=True)
def _first_outside(index: NDArray, length: int) -> int:
    """The first entry that is no index into ``length`` things, -1 for none."""
    for place in range(index.shape[0]):
        if not 0 <= index[place] < length:
            return place
    return -1
