"""Checks and read-only views of the arrays that every type here is made of."""

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from footwork.errors import InputError


def frozen(values: ArrayLike, dtype: DTypeLike) -> NDArray:
    """A contiguous, read-only copy of ``values`` (or ``values`` itself, where it is that already)."""
    array = np.ascontiguousarray(values, dtype=dtype)
    if array.flags.writeable:
        array = array.copy()
        array.flags.writeable = False
    return array


def require_shape(array: NDArray, shape: tuple[int | None, ...], name: str, where: str) -> None:
    """Raise InputError unless ``array`` has ``shape``; None stands for any length."""
    fits = len(shape) == array.ndim and all(want in (None, got) for want, got in zip(shape, array.shape, strict=True))
    if not fits:
        wanted = "(" + ", ".join("any" if want is None else str(want) for want in shape) + ")"
        raise InputError(f"{name} has shape {array.shape}, expected {wanted}", where)


def require_finite(array: NDArray, name: str, where: str) -> None:
    """Raise InputError, naming the first bad place, if ``array`` holds NaN or infinity."""
    bad = ~np.isfinite(array)
    if bad.any():
        place = tuple(int(index) for index in np.argwhere(bad)[0])
        raise InputError(f"{name}{list(place)} is {array[place]}, expected a finite number", where)


def require_range(array: NDArray, low: int, high: int, name: str, where: str) -> None:
    """Raise InputError unless every entry lies in ``low <= entry < high``."""
    if array.size and (array.min() < low or array.max() >= high):
        raise InputError(f"{name} holds {array.min()} to {array.max()}, expected {low} to {high - 1}", where)
