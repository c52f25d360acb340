"""What a glTF animation says of one node: keys at times, evaluated between them (glTF 2.0, appendix C)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion import gltf_document as g
from footwork.motion import quaternion
from footwork.motion.gltf_accessors import Numbers

INTERPOLATIONS = ("LINEAR", "STEP", "CUBICSPLINE")
_SHORTEST = 0.5  # under which four numbers are no rotation, even as bytes


@dataclass(frozen=True, eq=False)
class Curve:
    """Values at rising times.

    Args:
        times: seconds.  # (K,)
        values: at the times; of a spline tangent in, value and tangent out.  # (K, 3 or 4) or (K, 3, 3 or 4)
        interpolation: one of INTERPOLATIONS.
    """

    times: NDArray[np.float64]
    values: NDArray[np.float64]
    interpolation: str

    def at(self, seconds: ArrayLike) -> NDArray[np.float64]:
        """The values at some times, rotations of unit length; before the first key the first.  # (n,) -> (n, 3 or 4)"""
        when = np.clip(seconds, self.times[0], self.times[-1])
        before = np.minimum(np.searchsorted(self.times, when, side="right") - 1, max(len(self.times) - 2, 0))
        after = np.minimum(before + 1, len(self.times) - 1)
        step = self.times[after] - self.times[before]
        share = np.where(after > before, (when - self.times[before]) / np.where(after > before, step, 1.0), 0.0)
        return self._between(before, after, share, step)

    def _between(self, before: NDArray, after: NDArray, share: NDArray, step: NDArray) -> NDArray[np.float64]:
        values, turns = self.values, self.values.shape[-1] == 4
        if self.interpolation == "STEP":
            return values[np.where(share >= 1.0, after, before)]
        if self.interpolation == "CUBICSPLINE":
            spline = _spline(values[before], values[after], share[:, None], step[:, None])
            return quaternion.normalise(spline) if turns else spline
        if turns:
            return quaternion.slerp(values[before], values[after], share)
        return values[before] + share[:, None] * (values[after] - values[before])


def _spline(first: NDArray, second: NDArray, share: NDArray, step: NDArray) -> NDArray[np.float64]:
    """Hermite's cubic between two keys (n, 3, k)."""
    square, cube = share**2, share**3
    return (
        (2 * cube - 3 * square + 1) * first[:, 1]
        + step * (cube - 2 * square + share) * first[:, 2]
        + (3 * square - 2 * cube) * second[:, 1]
        + step * (cube - square) * second[:, 0]
    )


def read_curve(numbers: Numbers, sampler: g.Sampler, path: str) -> Curve:
    """The curve of a sampler.

    Args:
        numbers: of the file.
        sampler: of an animation of it.
        path: what it moves: translation, rotation or scale.

    Raises:
        InputError: for an unknown interpolation, times that do not rise from 0 or later, another number of values than
            of times, or four numbers that are no rotation.
    """
    where = f"{numbers.where}: sampler of accessors {sampler.input} and {sampler.output}"
    if sampler.interpolation not in INTERPOLATIONS:
        problem = f"interpolation {sampler.interpolation[:20]!r}, expected one of {', '.join(INTERPOLATIONS)}"
        raise InputError(problem, where)
    times = numbers.read(sampler.input, "SCALAR")[:, 0]
    if times[0] < 0.0 or (np.diff(times) <= 0.0).any():
        raise InputError("its times do not rise from 0 or later", where)
    values = numbers.read(sampler.output, "VEC4" if path == "rotation" else "VEC3")
    spline = sampler.interpolation == "CUBICSPLINE"
    if len(values) != len(times) * (3 if spline else 1):
        raise InputError(f"{len(values)} values for {len(times)} times", where)
    if spline:
        values = values.reshape(len(times), 3, -1)
    if path == "rotation":
        values = _rotations(values, spline, where)
    return Curve(times, values, sampler.interpolation)


def _rotations(values: NDArray[np.float64], spline: bool, where: str) -> NDArray[np.float64]:
    turns = values[:, 1] if spline else values
    lengths = np.linalg.norm(turns, axis=-1)
    if not lengths.min() > _SHORTEST:
        raise InputError(f"a rotation of length {lengths.min():.3g}, expected 1", where)
    return values if spline else quaternion.normalise(values)
