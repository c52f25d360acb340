"""Name tables: files that say which joint of a capture's skeleton is which of the common body's.

docs/bring-your-own-skeleton.md tells how to write one; those that come along lie in skeletons/.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from footwork.errors import InputError
from footwork.motion.body import NAMES
from footwork.motion.skeleton import Skeleton
from footwork.motion.toml_file import only_keys, read_toml, shown, text_of

END = ":end"
_AXES = ("left", "up", "forward")  # +x, +y and +z of the common body at rest
_KEYS = ("name", "attribution", "recognise", "up", "forward", "joints")
_JOINT_KEYS = ("turn", "place", *_AXES)
_PARALLEL = 1e-3

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class JointRule:
    """Where one joint of the common body finds its place and its rotation in the source.

    Args:
        turn: the source joint whose rotation it takes.
        place: the source joints whose mean is its place; ``name:end`` is the tip of a joint's segment.
        axes: none, one or two of ``left``, ``up`` and ``forward``: the directions in the source joint's own frame
            that point to the body's left, up and forward while the body stands in its T pose; the first one counts
            in full, the second as far as it lies across. With none the source's rest pose is such a T pose. A
            foot may give ``up`` alone (at right angles to its sole): its forward is the way to the toes.
    """

    turn: str
    place: tuple[str, ...]
    axes: dict[str, Vector]

    @cached_property
    def frame(self) -> NDArray[np.float64]:
        """The rotation from the body's rest axes to the source joint's own, for a rule with two axes.  # (4,)"""
        return frame_of({axis: np.array(vector) for axis, vector in self.axes.items()})


@dataclass(frozen=True)
class NameTable:
    """A map from one kind of skeleton to the common body.

    Args:
        name: what the kind of skeleton is called.
        attribution: text that the data's licence asks to carry, empty for none.
        recognise: joint names that must all be present for the table to fit.
        world: rotation that turns the source's world to +y up and +z forward, xyzw.  # (4,)
        joints: one rule for each joint of the common body.
        where: the file it came from.
    """

    name: str
    attribution: str
    recognise: tuple[str, ...]
    world: NDArray[np.float64]
    joints: dict[str, JointRule]
    where: str

    def missing(self, skeleton: Skeleton) -> list[str]:
        """The joints that the table needs and ``skeleton`` lacks."""
        wanted = list(self.recognise)
        for rule in self.joints.values():
            wanted += [rule.turn, *(place.removesuffix(END) for place in rule.place)]
        return [name for name in dict.fromkeys(wanted) if name not in skeleton.names]


def read_name_table(path: str | Path) -> NameTable:
    """Read a name table from a TOML file.

    Raises:
        InputError: for a file that cannot be read or is not TOML, and for a missing, unknown or malformed key.
    """
    values = read_toml(Path(path), "a name table")
    where = str(path)
    only_keys(values, _KEYS, where)
    return NameTable(
        name=text_of(values, "name", where),
        attribution=text_of(values, "attribution", where) if "attribution" in values else "",
        recognise=_names(values, "recognise", where),
        world=_world(values, where),
        joints=_joints(values, where),
        where=where,
    )


@cache
def built_in_tables() -> tuple[NameTable, ...]:
    """The tables that come along: CMU, ACCAD and the common body itself."""
    folder = Path(__file__).parent / "skeletons"
    return tuple(read_name_table(path) for path in sorted(folder.glob("*.toml")))


def table_for(skeleton: Skeleton, tables: Sequence[NameTable] = ()) -> NameTable:
    """The table that fits ``skeleton``: the first of ``tables``, else of those that come along.

    Raises:
        InputError: where none fits, naming the nearest and the joints it misses.
    """
    candidates = (*tables, *built_in_tables())
    missing = [table.missing(skeleton) for table in candidates]
    for table, lacks in zip(candidates, missing, strict=True):
        if not lacks:
            return table
    table, lacks = min(zip(candidates, missing, strict=True), key=lambda pair: len(pair[1]))
    raise InputError(
        f"no name table fits its joints; nearest is {table.name} ({table.where}), which also needs "
        f"{', '.join(lacks[:8])}{' ...' if len(lacks) > 8 else ''}; give a table of your own",
        skeleton.where,
    )


def frame_of(axes: dict[str, NDArray[np.float64]]) -> NDArray[np.float64]:
    """The rotation from the body's axes to the frame in which two of them are ``axes``, xyzw.  # (4,)

    Args:
        axes: two of ``left``, ``up`` and ``forward``, not parallel; the first is met exactly.  # (3,) each
    """
    (first, a), (second, b) = axes.items()
    a = a / np.linalg.norm(a)
    b = b - np.dot(a, b) * a
    columns = {first: a, second: b / np.linalg.norm(b)}
    third = next(axis for axis in _AXES if axis not in columns)
    after, last = (_AXES[(_AXES.index(third) + step) % 3] for step in (1, 2))
    columns[third] = np.cross(columns[after], columns[last])
    return Rotation.from_matrix(np.stack([columns[axis] for axis in _AXES], axis=-1)).as_quat()


def _names(values: dict[str, Any], key: str, where: str) -> tuple[str, ...]:
    value = values.get(key)
    if not isinstance(value, list) or not value or not all(isinstance(name, str) for name in value):
        raise InputError(f"{key} is {shown(value)}, expected a list of joint names", where)
    return tuple(value)


def _vector(values: dict[str, Any], key: str, where: str) -> Vector:
    value = values[key]
    numbers = isinstance(value, list) and len(value) == 3 and all(type(part) in (int, float) for part in value)
    if not (numbers and all(abs(part) < 1e9 for part in value) and math.hypot(*value) > 1e-6):
        raise InputError(f"{key} is {shown(value)}, expected a direction such as [0, 1, 0]", where)
    x, y, z = value
    return float(x), float(y), float(z)


def _world(values: dict[str, Any], where: str) -> NDArray[np.float64]:
    """The inverse of the frame of the source's ``up`` and ``forward``, +y and +z unless given."""
    given = {"up": [0, 1, 0], "forward": [0, 0, 1]} | values
    axes = {key: np.array(_vector(given, key, where)) for key in ("up", "forward")}
    _require_apart(axes, where)
    return Rotation.from_quat(frame_of(axes)).inv().as_quat()


def _require_apart(axes: dict[str, NDArray[np.float64]], where: str) -> None:
    (first, a), (second, b) = axes.items()
    if np.linalg.norm(np.cross(a, b)) < _PARALLEL * np.linalg.norm(a) * np.linalg.norm(b):
        raise InputError(f"{first} and {second} are parallel, expected two directions", where)


def _joints(values: dict[str, Any], where: str) -> dict[str, JointRule]:
    given = values.get("joints")
    if not isinstance(given, dict):
        raise InputError(f"joints is {shown(given)}, expected a table of the common body's joints", where)
    only_keys(given, NAMES, f"{where}: joints")
    missing = [name for name in NAMES if name not in given]
    if missing:
        raise InputError(f"joints lacks {', '.join(missing)}", where)
    rules = {name: _joint(given[name], f"{where}: joints.{name}") for name in NAMES}
    for name, rule in rules.items():
        if len(rule.axes) == 1 and not name.endswith("_foot"):
            raise InputError("gives one of left, up and forward, expected two", f"{where}: joints.{name}")
    return rules


def _joint(value: Any, where: str) -> JointRule:
    if isinstance(value, str):
        return JointRule(value, (value,), {})
    if not isinstance(value, dict):
        raise InputError(f"{shown(value)}, expected a joint name or a table with turn", where)
    only_keys(value, _JOINT_KEYS, where)
    turn = text_of(value, "turn", where)
    place = _names(value, "place", where) if "place" in value else (turn,)
    axes = {key: _vector(value, key, where) for key in value if key in _AXES}
    if len(axes) > 2:
        raise InputError("gives left, up and forward, expected at most two of them", where)
    if len(axes) == 2:
        _require_apart({key: np.array(axis) for key, axis in axes.items()}, where)
    return JointRule(turn, place, axes)
