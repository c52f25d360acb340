"""The ASF skeleton format of Acclaim and of CMU's recordings.

Every bone becomes a joint at the bone's start, with its end as the offset of its children. Directions and axes of an
ASF file stand in the global frame of the rest pose, so the rest offsets do too, and a bone's local rotation is
C L C^-1, where C is its axis and L the rotation of its degrees of freedom (source: motions/PROVENANCE.md, "Formats,
units, axes").
"""

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.euler import from_euler
from footwork.motion.skeleton import Skeleton
from footwork.motion.textfile import MAX_JOINTS, MAX_NAME, number, read_lines, words

INCH = 0.0254
ROOT = "root"
ROOT_CHANNELS = ("tx", "ty", "tz", "rx", "ry", "rz")
BONE_CHANNELS = ("rx", "ry", "rz")


@dataclass(frozen=True, eq=False)
class AsfSkeleton:
    """What an ASF file says.

    Args:
        skeleton: joint 0 is the root, then one joint a bone, in metres.
        unit: metres in one unit of length of the file, its ``length`` in inches: 0.0254 / length.
        radians: 1 where the file's angles are radians, pi / 180 where they are degrees.
        channels: each joint's channels in the order of an AMC line, such as ``("rx", "rz")``.  # (J,)
        axes: each joint's axis C, quaternions xyzw.  # (J, 4)
    """

    skeleton: Skeleton
    unit: float
    radians: float
    channels: tuple[tuple[str, ...], ...]
    axes: NDArray[np.float64]


@dataclass
class _Bone:
    line: int
    name: str = ""
    direction: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    length: float = 0.0
    axis: NDArray[np.float64] = field(default_factory=lambda: np.array([0.0, 0.0, 0.0, 1.0]))
    channels: tuple[str, ...] = ()


class _Line:
    """A line of the file as words, with its place for messages."""

    def __init__(self, path: str | Path, line: int, text: list[str]) -> None:
        self.line, self.key, self.rest = line, text[0], text[1:]
        self.where = f"{path}:{line}"

    def error(self, problem: str) -> InputError:
        return InputError(problem, self.where)

    def numbers(self, count: int) -> list[float]:
        if len(self.rest) < count:
            raise self.error(f"{self.key} has {len(self.rest)} numbers, expected {count}")
        return [number(word, self.where) for word in self.rest[:count]]

    def one_of(self, valid: dict[str, float]) -> float:
        if len(self.rest) != 1 or self.rest[0] not in valid:
            raise self.error(f"{self.key} {' '.join(self.rest)[:40]!r}, expected one of {', '.join(valid)}")
        return valid[self.rest[0]]


def read_asf(path: str | Path) -> AsfSkeleton:
    """The skeleton of an ASF file, in metres.

    Raises:
        InputError: naming file and line, for a file that is truncated, numbers that are not finite, unknown degrees of
            freedom, bones named twice, and a hierarchy that has a cycle, a loose bone or a second parent.
    """
    sections = _sections(path)
    unit, radians = _read_units(path, sections["units"])
    root_channels = _read_root(path, sections["root"], radians)
    bones = _read_bones(path, sections["bonedata"], radians)
    parents = _read_hierarchy(path, sections["hierarchy"], bones)
    bones[ROOT] = _Bone(line=sections["root"][0].line, name=ROOT, channels=root_channels)
    order = _order(path, bones, parents)
    return AsfSkeleton(
        skeleton=_skeleton(path, order, bones, parents, unit),
        unit=unit,
        radians=radians,
        channels=tuple(bones[name].channels for name in order),
        axes=np.array([bones[name].axis for name in order]),
    )


def _sections(path: str | Path) -> dict[str, list[_Line]]:
    """The lines under each of the headings that matter; each list starts with the heading itself."""
    sections: dict[str, list[_Line]] = {}
    current: list[_Line] = []
    for index, raw in enumerate(read_lines(path), start=1):
        text = words(raw.split(b"#")[0])
        if not text:
            continue
        if text[0].startswith(":"):
            current = sections.setdefault(text[0][1:].lower(), [])
        current.append(_Line(path, index, text))
    for name in ("units", "root", "bonedata", "hierarchy"):
        if name not in sections:
            raise InputError(f"has no :{name} section: truncated, or no ASF file", path)
    return sections


def _read_units(path: str | Path, lines: list[_Line]) -> tuple[float, float]:
    length, radians = 0.0, math.radians(1.0)
    for line in lines[1:]:
        if line.key == "length":
            (length,) = line.numbers(1)
        elif line.key == "angle":
            radians = line.one_of({"deg": math.radians(1.0), "rad": 1.0})
    if not 1e-6 < length < 1e6:
        raise InputError(f"unit of length is {length:g}, expected 1e-6 to 1e6, such as 'length 0.45'", path)
    return INCH / length, radians


def _read_root(path: str | Path, lines: list[_Line], radians: float) -> tuple[str, ...]:
    channels: tuple[str, ...] = ()
    for line in lines[1:]:
        if line.key == "order":
            channels = _channels(line, ROOT_CHANNELS)
        elif line.key in ("position", "orientation") and any(line.numbers(3)):
            raise line.error(f"a root {line.key} other than 0 0 0 is not supported")
    if len(channels) != len(ROOT_CHANNELS):
        raise InputError(f"the root needs 'order' with all of {' '.join(ROOT_CHANNELS)}", lines[0].where)
    return channels


def _channels(line: _Line, valid: tuple[str, ...]) -> tuple[str, ...]:
    channels = tuple(word.lower() for word in line.rest)
    for channel in channels:
        if channel not in valid:
            raise line.error(f"unknown degree of freedom {channel[:40]!r}, expected {', '.join(valid)}")
    if len(set(channels)) < len(channels):
        raise line.error("the same degree of freedom twice in one bone")
    return channels


def _read_bones(path: str | Path, lines: list[_Line], radians: float) -> dict[str, _Bone]:
    bones: dict[str, _Bone] = {}
    bone: _Bone | None = None
    for line in lines[1:]:
        if line.key == "begin":
            bone = _Bone(line.line)
        elif bone is None:
            raise line.error(f"{line.key[:40]!r} outside of begin and end")
        elif line.key == "end":
            _add_bone(bones, bone, line)
            bone = None
        else:
            _read_property(bone, line, radians)
    if bone is not None:
        raise InputError("the bone that begins here has no end: truncated", f"{path}:{bone.line}")
    return bones


def _add_bone(bones: dict[str, _Bone], bone: _Bone, line: _Line) -> None:
    if not 0 < len(bone.name) <= MAX_NAME or bone.name == ROOT or bone.name in bones:
        raise line.error(f"bone name {bone.name[:40]!r}, expected a name used once and other than 'root'")
    if len(bones) >= MAX_JOINTS:
        raise line.error(f"more than {MAX_JOINTS} bones")
    bones[bone.name] = bone


def _read_property(bone: _Bone, line: _Line, radians: float) -> None:
    match line.key:
        case "name" if line.rest:
            bone.name = line.rest[0]
        case "direction":
            bone.direction = np.array(line.numbers(3))
        case "length":
            (bone.length,) = line.numbers(1)
        case "axis":
            bone.axis = _axis(line, radians)
        case "dof":
            bone.channels = _channels(line, BONE_CHANNELS)


def _axis(line: _Line, radians: float) -> NDArray[np.float64]:
    """C: for the order XYZ it is Rz Ry Rx of the three angles."""
    angles = np.array(line.numbers(3)) * radians
    order = line.rest[3] if len(line.rest) == 4 else ""
    if sorted(order) != ["X", "Y", "Z"]:
        raise line.error("expected 'axis' with three angles and an order such as XYZ")
    return from_euler(order[::-1], angles[::-1])


def _read_hierarchy(path: str | Path, lines: list[_Line], bones: dict[str, _Bone]) -> dict[str, str]:
    """The parent of each bone."""
    parents: dict[str, str] = {}
    if lines[-1].key != "end":
        raise InputError("the hierarchy has no end: truncated", lines[-1].where)
    for line in lines[1:]:
        if line.key in ("begin", "end"):
            continue
        for child in line.rest:
            if child not in bones or (line.key != ROOT and line.key not in bones):
                raise line.error(f"{line.key[:40]!r} to {child[:40]!r}: not bones of this file")
            if child in parents:
                raise line.error(f"bone {child!r} has a second parent: {parents[child]!r} and {line.key!r}")
            parents[child] = line.key
    return parents


def _order(path: str | Path, bones: dict[str, _Bone], parents: dict[str, str]) -> list[str]:
    """Root first, then depth first in the order of the hierarchy."""
    children: dict[str, list[str]] = {}
    for child, parent in parents.items():
        children.setdefault(parent, []).append(child)
    order: list[str] = []
    pending = [ROOT]
    while pending:
        order.append(pending.pop())
        pending += reversed(children.get(order[-1], []))
    loose = [name for name in bones if name not in set(order)]
    if loose:
        where = f"{path}:{bones[loose[0]].line}"
        raise InputError(f"bone {loose[0]!r} is not reached from the root: loose, or on a cycle", where)
    return order


def _skeleton(
    path: str | Path, order: list[str], bones: dict[str, _Bone], parents: dict[str, str], unit: float
) -> Skeleton:
    reach = {name: bones[name].direction * bones[name].length * unit for name in order}
    inner = set(parents.values())
    return Skeleton(
        names=tuple(order),
        parents=np.array([order.index(parents[name]) if name in parents else -1 for name in order]),
        offsets=np.array([reach[parents[name]] if name in parents else np.zeros(3) for name in order]),
        ends=np.array([np.zeros(3) if name in inner else reach[name] for name in order]),
        where=str(path),
    )
