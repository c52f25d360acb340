"""A second reading of BVH and ASF/AMC files, written plainly from the formats and sharing no code with footwork.

It trusts its input and takes one joint after the other through SciPy's rotations. Places are in the file's units.
"""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

CMU_UNIT = 0.0254 / 0.45
ACCAD_UNIT = 0.01


def plain_places(path: Path) -> dict[str, np.ndarray]:
    """World places (F, 3) in metres of every joint and tip: ``NAME`` for a joint, ``NAME tip`` for an end."""
    if path.suffix == ".bvh":
        return {name: place * ACCAD_UNIT for name, place in _bvh_places(path).items()}
    return {name: place * CMU_UNIT for name, place in _amc_places(path).items()}


def _bvh_places(path: Path) -> dict[str, np.ndarray]:
    header, motion = path.read_text().split("MOTION")
    numbers = motion.split("Frame Time:")[1].split()[1:]
    values = np.array(numbers, dtype=float).reshape(int(motion.split()[1]), -1)
    places: dict[str, np.ndarray] = {}
    turns: dict[str, Rotation] = {}
    stack: list[str] = []
    offset = np.zeros(3)
    for line in header.splitlines():
        words = line.split()
        match words[0] if words else "":
            case "ROOT" | "JOINT":
                stack.append(words[1])
            case "End":
                stack.append(f"{stack[-1]} tip")
            case "}":
                stack.pop()
            case "OFFSET":
                offset = np.array(words[1:], dtype=float)
                if stack[-1].endswith(" tip"):
                    places[stack[-1]] = places[stack[-2]] + turns[stack[-2]].apply(offset)
            case "CHANNELS":
                shift, local = _bvh_joint(offset, words[2:], values)
                values = values[:, len(words) - 2 :]
                root = len(stack) == 1
                places[stack[-1]] = shift if root else places[stack[-2]] + turns[stack[-2]].apply(shift)
                turns[stack[-1]] = local if root else turns[stack[-2]] * local
    return places


def _bvh_joint(offset: np.ndarray, channels: list[str], values: np.ndarray) -> tuple[np.ndarray, Rotation]:
    shift, local = np.tile(offset, (len(values), 1)), Rotation.identity(len(values))
    for column, channel in enumerate(channels):
        if channel.endswith("position"):
            shift[:, "XYZ".index(channel[0])] = values[:, column]
        else:
            local = local * Rotation.from_euler(channel[0].lower(), values[:, [column]], degrees=True)
    return shift, local


def _amc_places(path: Path) -> dict[str, np.ndarray]:
    """The recipe of motions/PROVENANCE.md: a bone's joint is its start, its tip is its end."""
    asf = path.with_name(path.stem.split("_")[0] + ".asf").read_text()
    bones = {}
    for block in asf.split(":bonedata")[1].split(":hierarchy")[0].split("begin")[1:]:
        lines = [line.split() for line in block.splitlines() if line.split()]
        bone = {line[0]: line[1:] for line in lines}
        bones[bone["name"][0]] = bone
    frames = _amc_frames(path)
    root = np.array([frame["root"] for frame in frames])
    tips = {"root": root[:, :3]}
    turns = {"root": _rz_ry_rx(root[:, 3:])}
    places = {"root": root[:, :3]}
    for line in asf.split(":hierarchy")[1].splitlines():
        parent, *children = line.split() or ["begin"]
        for name in children:
            bone = bones[name]
            axis = _rz_ry_rx(np.array([bone["axis"][:3]], dtype=float))
            angles = np.zeros((len(frames), 3))
            for index, channel in enumerate(bone.get("dof", [])):
                angles[:, "xyz".index(channel[1])] = [frame[name][index] for frame in frames]
            reach = np.array(bone["direction"], dtype=float) * float(bone["length"][0])
            turns[name] = turns[parent] * axis * _rz_ry_rx(angles) * axis.inv()
            places[name] = tips[parent]
            tips[name] = tips[parent] + turns[name].apply(reach)
    return places | {f"{name} tip": tip for name, tip in tips.items()}


def _amc_frames(path: Path) -> list[dict[str, list[float]]]:
    frames: list[dict[str, list[float]]] = []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[0].isdigit():
            frames.append({})
        elif words[0][0] not in "#:":
            frames[-1][words[0]] = [float(word) for word in words[1:]]
    return frames


def _rz_ry_rx(degrees: np.ndarray) -> Rotation:
    x, y, z = (Rotation.from_euler(axis, degrees[:, [index]], degrees=True) for index, axis in enumerate("xyz"))
    return z * y * x
