"""Weight tables: files that say how much each joint or segment counts in the metric; those we have lie in weights/."""

import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.point_cloud import PointCloud, joint_cloud, segment_cloud
from footwork.motion.skeleton import Skeleton
from footwork.motion.toml_file import only_keys, read_toml, shown, text_of

_KEYS = ("source", "on", "others", "weights")
_ON = ("joints", "segments")


@dataclass(frozen=True)
class WeightTable:
    """Weights by the names of joints, the left and the right alike.

    Args:
        source: where they come from.
        on: ``joints``, whose places count, or ``segments``: points along each from its joint to the next.
        others: weight of every joint or segment that is not named.
        weights: by name, without left or right.
        where: the file it came from.
    """

    source: str
    on: str
    others: float
    weights: dict[str, float]
    where: str

    def cloud(self, skeleton: Skeleton) -> PointCloud:
        """The points and weights for a body.

        Raises:
            InputError: for a name that the body lacks, weights that are all zero, or a segment that forks or ends.
        """
        parts = [name.removeprefix("left_").removeprefix("right_") for name in skeleton.names]
        missing = [name for name in self.weights if name not in parts]
        if missing:
            raise InputError(f"no joint {missing[0]!r}, expected some of {', '.join(dict.fromkeys(parts))}", self.where)
        weights = np.array([self.weights.get(part, self.others) for part in parts])
        if not weights.any():
            raise InputError("weights are all zero, expected at least one above it", self.where)
        return self._points(skeleton, weights)

    def _points(self, skeleton: Skeleton, weights: NDArray[np.float64]) -> PointCloud:
        return segment_cloud(skeleton, weights) if self.on == "segments" else joint_cloud(weights)


def read_weight_table(path: str | Path) -> WeightTable:
    """Read a weight table from a TOML file.

    Raises:
        InputError: for a file that cannot be read or is not TOML, and for a missing, unknown or malformed key.
    """
    values, where = read_toml(Path(path), "a weight table"), str(path)
    only_keys(values, _KEYS, where)
    on = text_of(values, "on", where)
    if on not in _ON:
        raise InputError(f"on is {shown(on)}, expected {' or '.join(_ON)}", where)
    weights = values.get("weights")
    if not isinstance(weights, dict):
        raise InputError(f"weights is {shown(weights)}, expected a table of joint names", where)
    return WeightTable(
        source=text_of(values, "source", where),
        on=on,
        others=_weight(values.get("others"), "others", where),
        weights={name: _weight(value, f"weights.{name}", where) for name, value in weights.items()},
        where=where,
    )


@cache
def built_in_weights(name: str) -> WeightTable:
    """The table weights/``name``.toml that comes along."""
    return read_weight_table(Path(__file__).parent / "weights" / f"{name}.toml")


def _weight(value: Any, key: str, where: str) -> float:
    if type(value) not in (int, float) or not (math.isfinite(value) and 0.0 <= value < 1e9):
        raise InputError(f"{key} is {shown(value)}, expected a number of zero or more", where)
    return float(value)
