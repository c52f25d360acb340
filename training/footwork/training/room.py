"""Whether there is memory for what is about to be done: refused beforehand, with figures, not killed on the way."""

from footwork.errors import InputError
from footwork.training.memory import available_bytes


def require_room(needed: float, what: str, instead: str, where: str = "motions") -> None:
    """Raise InputError unless so much memory can still be taken.

    Args:
        needed: bytes, an estimate.
        what: what needs it, in the plural, with its figures.
        instead: what would need less.
        where: the place of the input that is too large.
    """
    there = available_bytes()
    if needed > there:
        problem = (
            f"{what} need about {_gigabytes(needed)} of memory where {_gigabytes(there)} are left, expected less: "
        )
        raise InputError(problem + instead, where)


def _gigabytes(count: float) -> str:
    return f"{count / 1e9:,.1f} GB"
