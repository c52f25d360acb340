"""The BVH motion format: a reader for any channels on any joint, and a writer.

Conventions: a joint's rotation is the product of its rotation channels in the order declared, angles in degrees.
Position channels give the joint's place in its parent's frame and replace its OFFSET, on the root as on any other
joint (the root OFFSET of ACCAD's files repeats a first frame and must not be added); an axis without a position
channel keeps the OFFSET.
"""

from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.bvh_hierarchy import POSITIONS, ROTATIONS, BvhJoint, read_hierarchy
from footwork.motion.clip import Clip
from footwork.motion.euler import from_euler, to_euler
from footwork.motion.skeleton import Skeleton
from footwork.motion.textfile import number, number_rows, read_lines, whole_number, write_whole

CENTIMETRE = 0.01
FRAME_TIMES = (1e-4, 10.0)
WRITTEN_AXES = "ZXY"


def read_bvh(path: str | Path, unit: float = CENTIMETRE) -> Clip:
    """The motion of a BVH file, in metres and seconds.

    A frame time that is a whole rate's period as far as its digits go (0.0333333) becomes that rate (30). End sites
    become the skeleton's ``ends`` (the first, where a joint has several). Joints other than the root that have
    position channels give the clip's ``translations``.

    Args:
        path: the file.
        unit: metres in one unit of length of the file; nothing in a BVH file says it, and centimetres are the habit.

    Raises:
        InputError: naming file and line, for a file that is truncated, unbalanced or has two roots, unknown or
            repeated channels, a count of frames or of numbers in a line that does not fit, NaN or 1e999.
    """
    lines = read_lines(path)
    start = next((index for index, line in enumerate(lines) if line.strip() == b"MOTION"), None)
    if start is None:
        raise InputError("has no MOTION line: truncated, or no BVH file", f"{path}:{len(lines)}")
    joints = read_hierarchy(path, lines[:start])
    fps, values = _read_motion(path, lines, start, sum(len(joint.channels or ()) for joint in joints))
    return _clip(path, joints, fps, values, unit)


def _read_motion(path: str | Path, lines: list[bytes], start: int, width: int) -> tuple[float, NDArray[np.float64]]:
    """Frames a second, and every frame's numbers (F, width); ``start`` is the index of the MOTION line."""
    body = [(line, text) for line, text in enumerate(lines[start + 1 :], start=start + 2) if text.strip()]
    if len(body) < 2:
        raise InputError("ends inside the MOTION header", f"{path}:{len(lines)}")
    frames_line, count = _header(path, *body[0], [b"Frames:"])
    time_line, seconds = _header(path, *body[1], [b"Frame", b"Time:"])
    frames = whole_number(count, f"{path}:{frames_line}")
    fps = _frame_rate(seconds, f"{path}:{time_line}")
    if frames == 0:
        raise InputError("no frames, expected at least one", f"{path}:{frames_line}")
    if len(body) - 2 != frames:
        raise InputError(f"{len(body) - 2} frames, but line {frames_line} says {frames}", f"{path}:{body[-1][0]}")
    return fps, number_rows([text for _, text in body[2:]], [line for line, _ in body[2:]], width, path)


def _header(path: str | Path, line: int, text: bytes, key: list[bytes]) -> tuple[int, bytes]:
    row = text.split()
    if len(row) != len(key) + 1 or row[:-1] != key:
        raise InputError(f"expected '{b' '.join(key).decode()} NUMBER'", f"{path}:{line}")
    return line, row[-1]


def _frame_rate(word: bytes, where: str) -> float:
    seconds = number(word, where)
    low, high = FRAME_TIMES
    if not low <= seconds <= high:
        raise InputError(f"a frame time of {seconds:g} s, expected {low:g} to {high:g}", where)
    last_digit = 10.0 ** int(Decimal(word.decode()).as_tuple().exponent)
    whole = max(round(1.0 / seconds), 1)
    # Writers round or cut off the period; the 2 percent keep a coarse 0.4 s from becoming 0.5 s.
    near = abs(1.0 / whole - seconds) <= min(last_digit, 0.02 * seconds)
    return float(whole) if near else 1.0 / seconds


def _clip(path: str | Path, joints: list[BvhJoint], fps: float, values: NDArray[np.float64], unit: float) -> Clip:
    offsets = np.array([joint.offset for joint in joints], dtype=np.float64) * unit
    places, moved = _places(joints, offsets, values, unit)
    root = places[:, 0].copy()
    places[:, 0] = offsets[0] = 0.0
    skeleton = Skeleton(
        names=tuple(joint.name for joint in joints),
        parents=np.array([joint.parent for joint in joints]),
        offsets=offsets,
        ends=np.array([joint.end or (0.0, 0.0, 0.0) for joint in joints]) * unit,
        where=str(path),
    )
    return Clip(
        name=Path(path).name,
        skeleton=skeleton,
        fps=fps,
        root_position=root,
        rotations=_rotations(joints, values),
        translations=places if moved else None,
    )


def _columns(joints: list[BvhJoint]) -> Iterator[tuple[int, int, str]]:
    """(joint, column, channel) of every column of the motion block."""
    column = 0
    for index, joint in enumerate(joints):
        for channel in joint.channels or ():
            yield index, column, channel
            column += 1


def _places(
    joints: list[BvhJoint], offsets: NDArray[np.float64], values: NDArray[np.float64], unit: float
) -> tuple[NDArray[np.float64], bool]:
    """Each joint's place in its parent's frame, metres (F, J, 3), and whether any but the root's has channels."""
    places = np.repeat(offsets[None], len(values), axis=0)
    moved = False
    for index, column, channel in _columns(joints):
        if channel in POSITIONS:
            places[:, index, POSITIONS.index(channel)] = values[:, column] * unit
            moved |= index > 0
    return places, moved


def _rotations(joints: list[BvhJoint], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Local rotations (F, J, 4), computed together for all joints that share an order of channels."""
    turns: list[list[tuple[str, int]]] = [[] for _ in joints]
    for index, column, channel in _columns(joints):
        if channel in ROTATIONS:
            turns[index].append((channel[0], column))
    groups: dict[str, list[int]] = {}
    for index, turn in enumerate(turns):
        groups.setdefault("".join(axis for axis, _ in turn), []).append(index)
    rotations = np.empty((len(values), len(joints), 4))
    for axes, members in groups.items():
        columns = np.array([[column for _, column in turns[index]] for index in members], dtype=np.intp)
        rotations[:, members] = from_euler(axes, np.radians(values[:, columns]))
    return rotations


def write_bvh(path: str | Path, clip: Clip, unit: float = CENTIMETRE) -> None:
    """Write a clip as BVH: rotations in the order Z X Y, lengths in ``unit`` metres, six digits after the point.

    Joints come out depth first, as the format asks, so their order may change. A joint gets position channels where
    the clip's ``translations`` move it off its offset. Contacts and labels have no place in the format.

    Raises:
        InputError: for a joint name that a BVH file cannot hold, or a file that cannot be written.
    """
    moves = _moving_joints(clip)
    order: list[int] = []
    text = ["HIERARCHY", *_hierarchy_lines(clip.skeleton, moves, unit, order)]
    text += ["MOTION", f"Frames: {clip.frame_count}", f"Frame Time: {1.0 / clip.fps:.10f}"]
    row = " ".join(["%.6f"] * sum(6 if moves[joint] else 3 for joint in order))
    text += [row % tuple(values) for values in _channel_values(clip, order, moves, unit)]
    write_whole(path, ("\n".join(text) + "\n").encode())


def _moving_joints(clip: Clip) -> NDArray[np.bool_]:
    """Which joints need position channels: the root, and those that leave their offsets.  # (J,)"""
    moves = np.zeros(clip.skeleton.joint_count, dtype=np.bool_)
    if clip.translations is not None:
        moves = (clip.translations != clip.skeleton.offsets).any(axis=(0, 2))
    moves[0] = True
    return moves


def _hierarchy_lines(skeleton: Skeleton, moves: NDArray[np.bool_], unit: float, order: list[int]) -> Iterator[str]:
    """The lines from ROOT to its closing brace; ``order`` is filled with the joints in the order written."""
    pending: list[tuple[int, int, bool]] = [(0, 0, False)]
    while pending:
        joint, depth, done = pending.pop()
        indent = "  " * depth
        if done:
            yield f"{indent}}}"
            continue
        order.append(joint)
        children = skeleton.children(joint)
        pending.append((joint, depth, True))
        pending += [(child, depth + 1, False) for child in reversed(children)]
        place = skeleton.offsets[joint] / unit if joint else np.zeros(3)
        yield f"{indent}{'JOINT' if joint else 'ROOT'} {_writable(skeleton, joint)}"
        yield f"{indent}{{"
        yield f"{indent}  OFFSET {_triple(place)}"
        channels = [*POSITIONS] * bool(moves[joint]) + [f"{axis}rotation" for axis in WRITTEN_AXES]
        yield f"{indent}  CHANNELS {len(channels)} {' '.join(channels)}"
        if not children or skeleton.ends[joint].any():
            yield from (f"{indent}  {line}" for line in ("End Site", "{"))
            yield f"{indent}    OFFSET {_triple(skeleton.ends[joint] / unit)}"
            yield f"{indent}  }}"


def _writable(skeleton: Skeleton, joint: int) -> str:
    name = skeleton.names[joint]
    if not name or name != " ".join(name.split()) or set(name) & set("{}"):
        raise InputError(f"joint name {name!r} cannot stand in a BVH file, expected words without braces", "write_bvh")
    return name


def _triple(values: NDArray[np.float64]) -> str:
    return " ".join(f"{value:.6f}" for value in values)


def _channel_values(clip: Clip, order: list[int], moves: NDArray[np.bool_], unit: float) -> NDArray[np.float64]:
    """Every frame's numbers in the order of the channels written.  # (F, channels)"""
    angles = np.degrees(to_euler(WRITTEN_AXES, clip.rotations))
    columns: list[NDArray[np.float64]] = []
    for joint in order:
        if joint == 0:
            columns.append(clip.root_position / unit)
        elif moves[joint] and clip.translations is not None:
            columns.append(clip.translations[:, joint] / unit)
        columns.append(angles[:, joint])
    return np.concatenate(columns, axis=1)
