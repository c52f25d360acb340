"""The HIERARCHY part of a BVH file: its joints with their offsets, channels and end sites."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from footwork.errors import InputError
from footwork.motion.textfile import MAX_JOINTS, MAX_NAME, number, whole_number, words

POSITIONS = ("Xposition", "Yposition", "Zposition")
ROTATIONS = ("Xrotation", "Yrotation", "Zrotation")


@dataclass
class BvhJoint:
    """One ROOT or JOINT, in the file's units.

    Args:
        name: its name.
        parent: index of the parent, -1 for the root.
        offset: the three numbers of OFFSET.
        channels: the names of its channels in the order declared.
        end: the OFFSET of its first end site, None where it has none.
    """

    name: str
    parent: int
    offset: list[float] | None = None
    channels: list[str] | None = None
    end: list[float] | None = None


def read_hierarchy(path: str | Path, lines: list[bytes]) -> list[BvhJoint]:
    """The joints in the order of the file, so parents before children, from the lines before MOTION.

    Raises:
        InputError: naming the line, for anything but one balanced tree of joints with known channels.
    """
    source = _Words(path, lines)
    source.expect("HIERARCHY")
    source.expect("ROOT")
    joints = [BvhJoint(source.name(), parent=-1)]
    open_joints = [0]
    while open_joints:
        _read_entry(source, joints, open_joints)
    rest = source.next_or_none()
    if rest is not None:
        problem = "a second ROOT" if rest == "ROOT" else f"{rest[:40]!r} after the last brace"
        raise source.error(f"{problem}, expected MOTION")
    return joints


class _Words:
    """The words of some lines one after another; ``line`` is that of the last word handed out."""

    def __init__(self, path: str | Path, lines: list[bytes]) -> None:
        self.path = path
        self.line = 1
        self._words = self._split(lines)

    @staticmethod
    def _split(lines: list[bytes]) -> Iterator[tuple[str, int]]:
        for line, text in enumerate(lines, start=1):
            for word in words(text.replace(b"{", b" { ").replace(b"}", b" } ")):
                yield word, line

    def next_or_none(self) -> str | None:
        word, self.line = next(self._words, (None, self.line))
        return word

    def next(self, wanted: str) -> str:
        word = self.next_or_none()
        if word is None:
            raise self.error(f"the hierarchy ends where {wanted} was expected: truncated, or braces out of balance")
        return word

    def expect(self, wanted: str) -> None:
        found = self.next(repr(wanted))
        if found != wanted:
            raise self.error(f"{found[:40]!r} where {wanted!r} was expected")

    def numbers(self, count: int) -> list[float]:
        return [number(self.next("a number"), self.where) for _ in range(count)]

    def name(self) -> str:
        """All words up to the brace, for names may hold spaces."""
        parts: list[str] = []
        while (word := self.next("'{'")) != "{":
            parts.append(word)
        name = " ".join(parts)
        if len(name) > MAX_NAME:
            raise self.error(f"a name of {len(name)} letters, expected {MAX_NAME} at most")
        return name

    @property
    def where(self) -> str:
        return f"{self.path}:{self.line}"

    def error(self, problem: str) -> InputError:
        return InputError(problem, self.where)


def _read_entry(source: _Words, joints: list[BvhJoint], open_joints: list[int]) -> None:
    joint = joints[open_joints[-1]]
    match source.next("'}'"):
        case "OFFSET" if joint.offset is None:
            joint.offset = source.numbers(3)
        case "CHANNELS" if joint.channels is None:
            joint.channels = _read_channels(source)
        case "JOINT":
            _open_joint(source, joints, open_joints)
        case "End":
            end = _read_end_site(source)
            joint.end = end if joint.end is None else joint.end
        case "}":
            _close_joint(source, joint)
            open_joints.pop()
        case word:
            raise source.error(
                f"{word[:40]!r} in joint {joint.name!r}, "
                "expected one OFFSET, one CHANNELS, then JOINT, End Site or '}'"
            )


def _open_joint(source: _Words, joints: list[BvhJoint], open_joints: list[int]) -> None:
    if len(joints) == MAX_JOINTS:
        raise source.error(f"more than {MAX_JOINTS} joints")
    name = source.name()
    if any(joint.name == name for joint in joints):
        raise source.error(f"joint name {name!r} is used twice")
    joints.append(BvhJoint(name, parent=open_joints[-1]))
    open_joints.append(len(joints) - 1)


def _close_joint(source: _Words, joint: BvhJoint) -> None:
    missing = "OFFSET" if joint.offset is None else "CHANNELS" if joint.channels is None else None
    if missing:
        raise source.error(f"joint {joint.name!r} ends without {missing}")


def _read_channels(source: _Words) -> list[str]:
    valid = POSITIONS + ROTATIONS
    count = whole_number(source.next("a number of channels"), source.where)
    if count > len(valid):
        raise source.error(f"{count} channels, expected {len(valid)} at most")
    channels = [source.next("a channel") for _ in range(count)]
    for channel in channels:
        if channel not in valid:
            raise source.error(f"unknown channel {channel[:40]!r}, expected one of {', '.join(valid)}")
    if len(set(channels)) < count:
        raise source.error("the same channel twice in one joint")
    return channels


def _read_end_site(source: _Words) -> list[float]:
    source.name()
    source.expect("OFFSET")
    offset = source.numbers(3)
    source.expect("}")
    return offset
