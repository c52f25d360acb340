"""The AMC motion format of Acclaim and of CMU's recordings; its skeleton is read by ``asf``.

A bone's local rotation is C L C^-1 with L the product of its degrees of freedom, the last listed outermost: Rz Ry Rx
for rx ry rz (source: motions/PROVENANCE.md, "Formats, units, axes").
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.asf import AsfSkeleton, read_asf
from footwork.motion.clip import Clip
from footwork.motion.euler import from_euler
from footwork.motion.textfile import number_rows, read_lines, whole_number

__all__ = ["CMU_RATE", "AsfSkeleton", "read_amc", "read_asf"]

CMU_RATE = 120.0


@dataclass
class _Track:
    """What the file says of one bone: its numbers, a line a frame."""

    lines: list[int] = field(default_factory=list)
    texts: list[bytes] = field(default_factory=list)


def read_amc(path: str | Path, asf: AsfSkeleton, fps: float = CMU_RATE) -> Clip:
    """The motion of an AMC file on the skeleton of its ASF file, in metres and seconds.

    Args:
        path: the file.
        asf: its skeleton.
        fps: frames a second, which an AMC file does not say; CMU's run at 120.

    Raises:
        InputError: naming file and line, for a truncated file, frame numbers out of order, a bone that the skeleton
            lacks or that a frame lacks, a wrong count of numbers, NaN or 1e999.
    """
    starts, tracks = _split(path, read_lines(path), asf)
    rotations = np.empty((len(starts), asf.skeleton.joint_count, 4))
    root = np.zeros((len(starts), 3))
    for joint, (name, channels) in enumerate(zip(asf.skeleton.names, asf.channels, strict=True)):
        values = _values(path, name, len(channels), tracks.get(name, _Track()), starts)
        turns = [index for index, channel in enumerate(channels) if channel[0] == "r"]
        # Outermost first, for from_euler multiplies from the left.
        axes = "".join(channels[index][1].upper() for index in reversed(turns))
        angles = values[:, turns[::-1]] * asf.radians
        turn = from_euler(axes, angles)
        axis = asf.axes[joint]
        rotations[:, joint] = quaternion.multiply(quaternion.multiply(axis, turn), quaternion.conjugate(axis))
        if joint == 0:
            root = values[:, [channels.index(channel) for channel in ("tx", "ty", "tz")]] * asf.unit
    return Clip(name=Path(path).name, skeleton=asf.skeleton, fps=fps, root_position=root, rotations=rotations)


def _split(path: str | Path, lines: list[bytes], asf: AsfSkeleton) -> tuple[list[int], dict[str, _Track]]:
    """The line at which each frame starts, and each bone's rows."""
    known = {name.encode(): _Track() for name in asf.skeleton.names}
    starts: list[int] = []
    for line, text in enumerate(lines, start=1):
        row = text.split(None, 1)
        track = known.get(row[0]) if row else None
        if track is not None and starts:
            track.lines.append(line)
            track.texts.append(row[1] if len(row) == 2 else b"")
        elif not row or row[0][:1] in (b"#", b":"):
            _check_flag(row, asf, f"{path}:{line}")
        else:
            _check_frame_number(row, len(starts) + 1, f"{path}:{line}")
            starts.append(line)
    if not starts:
        raise InputError("has no frames: truncated, or no AMC file", path)
    return starts, {name.decode(): track for name, track in known.items()}


def _check_flag(row: list[bytes], asf: AsfSkeleton, where: str) -> None:
    valid = (b":FULLY-SPECIFIED", b":RADIANS" if asf.radians == 1.0 else b":DEGREES")
    if row and row[0].startswith(b":") and row[0].upper() not in valid:
        expected = " or ".join(flag.decode() for flag in valid)
        raise InputError(f"{row[0][:40].decode(errors='replace')!r}, but its skeleton allows only {expected}", where)


def _check_frame_number(row: list[bytes], wanted: int, where: str) -> None:
    if len(row) > 1 or not row[0].isdigit():
        name = row[0][:40].decode(errors="replace")
        raise InputError(f"{name!r} is neither a bone of the skeleton nor a frame number", where)
    found = whole_number(row[0], where)
    if found != wanted:
        raise InputError(f"frame number {found}, expected {wanted}", where)


def _values(path: str | Path, name: str, width: int, track: _Track, starts: list[int]) -> NDArray[np.float64]:
    """One bone's numbers  # (F, width); a bone without degrees of freedom needs no lines."""
    if width == 0 and not track.texts:
        return np.empty((len(starts), 0))
    lines = np.array(track.lines, dtype=np.int64)
    # The i-th row of the bone must lie in frame i: count the rows of each frame.
    counts = np.bincount(np.searchsorted(starts, lines) - 1, minlength=len(starts))
    odd = np.flatnonzero(counts != 1)
    if odd.size:
        frame = int(odd[0])
        raise InputError(
            f"frame {frame + 1} has {counts[frame]} lines for bone {name!r}, expected 1: truncated?",
            f"{path}:{starts[frame]}",
        )
    return number_rows(track.texts, track.lines, width, path)
