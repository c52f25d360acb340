"""What compiled code takes whole: any number of arrays handed over at the cost of one.

Each array that Python hands to compiled code costs a third of a microsecond, and a tick reads eighty. So what stays the
same from call to call is handed over once, and kept in a structure of compiled code's own that holds on to it.
"""

from types import SimpleNamespace
from typing import Any

import numba
from numba.core import types
from numba.experimental import structref


@structref.register
class KeptType(types.StructRef):
    """The type of what is kept, to numba."""

    def preprocess_fields(self, fields: Any) -> Any:
        """Take each number for any of its kind, not for itself alone."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class Kept(structref.StructRefProxy):
    """A tuple that stays in compiled code, where ``parts`` is what was handed over.

    The arrays in it are those that were handed over, not copies: what either side writes the other reads.
    """

    parts: Any


structref.define_proxy(Kept, KeptType, ["parts"])


def keep(parts: Any) -> Any:
    """Hand a tuple over, of arrays, numbers and tuples of these; what compiled code takes for it, with ``parts``."""
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return SimpleNamespace(parts=parts)  # without a compiler there are no structures of its own
    return _compiled(parts)


@numba.njit(cache=True)
def _compiled(parts: Any) -> Kept:
    return Kept(parts)
