"""Values of a policy table as they are kept: as they are, or in sixteen bits.

In sixteen bits a row of headings, which is of one node under one request, is codes with a least value and a step of
its own. How values compare is what matters. Half precision errs thirty times as much; one range for all rows of a node
would tell rows apart that are alike (convention).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_shape

LARGEST_CODE = np.iinfo(np.uint16).max


class CodedValues(NamedTuple):
    """Values low + step code.

    Args:
        codes: of each value: float32, which are the values themselves, or uint16.  # (N, Q, H)
        low: what code 0 stands for in each row.  # (N, Q) float32
        step: what one code is worth in each row, zero where all its values are alike.  # (N, Q) float32
    """

    codes: NDArray
    low: NDArray[np.float32]
    step: NDArray[np.float32]

    @property
    def values(self) -> NDArray[np.float32]:
        """What the codes stand for.  # (N, Q, H)"""
        if self.codes.dtype == np.float32:
            return self.codes
        return (self.low[..., None] + self.step[..., None] * self.codes.astype(np.float64)).astype(np.float32)

    @property
    def nbytes(self) -> int:
        """What they take."""
        return self.codes.nbytes + self.low.nbytes + self.step.nbytes

    def checked(self, behaviours: int, headings: int, where: str) -> "CodedValues":
        """The same, read-only.

        Raises:
            InputError: for arrays of other shapes or kinds, or that are not finite.
        """
        kind = self.codes.dtype
        if kind not in (np.float32, np.uint16):
            raise InputError(f"codes are {kind}, expected float32 or uint16", where)
        kept = CodedValues(frozen(self.codes, kind), frozen(self.low, np.float32), frozen(self.step, np.float32))
        require_shape(kept.codes, (None, behaviours, headings), "values", where)
        for name in ("low", "step"):
            require_shape(getattr(kept, name), kept.codes.shape[:2], name, where)
            require_finite(getattr(kept, name), name, where)
        require_finite(kept.codes, "values", where)
        return kept


def exact(values: NDArray) -> CodedValues:
    """Values as they are, to float32.  # (N, Q, H)"""
    rows = values.shape[:2]
    return CodedValues(values.astype(np.float32), np.zeros(rows, np.float32), np.ones(rows, np.float32))


def quantised(values: NDArray) -> CodedValues:
    """Finite values in sixteen bits, within half a step of each.  # (N, Q, H)"""
    low = values.min(axis=-1).astype(np.float32)
    above = values - low[..., None].astype(np.float64)
    step = (above.max(axis=-1) / LARGEST_CODE).astype(np.float32)
    codes = np.rint(above / np.where(step > 0.0, step, 1.0)[..., None])
    return CodedValues(np.clip(codes, 0, LARGEST_CODE).astype(np.uint16), low, step)
