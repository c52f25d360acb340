"""GLB to clips: every animation of every body of a file, at the rate of its keys."""

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from msgspec import UNSET
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import gltf_document as g
from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.glb_container import read_container
from footwork.motion.gltf_accessors import Numbers
from footwork.motion.gltf_curves import read_curve
from footwork.motion.gltf_nodes import MOVES, Body, NodeTree, bodies_of
from footwork.motion.gltf_poses import Curves, world_poses
from footwork.motion.kinematics import local_rotations
from footwork.motion.resample import COMMON_RATE, MAX_FRAMES
from footwork.motion.skeleton import Skeleton

SEPARATOR = "#"
"""Between the name of a file that holds several clips, and the clip's own."""
MAX_POSES = 4_000_000  # frames times joints, of all clips together
_SLOWEST, _FASTEST = 5.0, 240.0  # keys a second
_EVEN, _WHOLE = 2e-3, 1e-4  # of an interval, of a rate
_STILL = 1e-6  # metres by which joints leave their offsets through rounding


class _Found(NamedTuple):
    animation: str
    body: Body
    curves: Curves
    fps: float
    start: float
    frames: int


def read_glb(path: str | Path) -> list[Clip]:
    """The animations of a GLB file, each as a clip for each body that it moves, in metres and seconds.

    A body is what a skin moves; in a file without skins it is what the animations move. How nodes stand in the file
    itself counts as its rest: rotations are those from there, so that at rest all joints look along the world's axes,
    as in a BVH file. A clip takes the rate at which its keys come. A file of one clip gives it its name; clips of
    several are called ``FILE#ANIMATION``, ``FILE#BODY`` or ``FILE#ANIMATION#BODY``.

    Raises:
        InputError: for a file that cannot be read or is no GLB; without animations; with accessors outside its bytes;
            numbers that are not finite; nodes on a cycle; joints that are sheared, mirrored or without size; or more
            than ``MAX_POSES`` frames times joints.
    """
    where = str(path)
    document, blob = read_container(path)
    if not any(animation.channels for animation in document.animations):
        raise InputError("has no animation, expected at least one", path)
    tree, numbers = NodeTree(document.nodes, where), Numbers(document, blob, where)
    found = list(_found(document, tree, numbers))
    if not found:
        raise InputError("no animation moves a joint of its bodies", path)
    return [_clip(tree, each, name) for each, name in zip(found, _names(found, Path(path).name), strict=True)]


def _found(document: g.Document, tree: NodeTree, numbers: Numbers) -> Iterator[_Found]:
    bodies, poses = bodies_of(document, tree), 0
    for number, animation in enumerate(document.animations):
        curves = _curves(animation, numbers)
        for body in bodies:
            nodes = {*body.above, *body.nodes}
            own = {key: curve for key, curve in curves.items() if key[0] in nodes}
            if own:
                found = _Found(animation.name or str(number), body, own, *_sampling(own, tree.where))
                poses += found.frames * len(body.nodes)
                if poses > MAX_POSES:
                    raise InputError(f"{poses} frames of joints and more, expected at most {MAX_POSES}", tree.where)
                yield found


def _curves(animation: g.Animation, numbers: Numbers) -> Curves:
    curves: dict[tuple[int, str], object] = {}
    for channel in animation.channels:
        target = channel.target
        if target.node is UNSET or target.path not in MOVES:
            continue
        if channel.sampler >= len(animation.samplers):
            problem = f"sampler {channel.sampler} of {len(animation.samplers)}, expected one that is there"
            raise InputError(problem, f"{numbers.where}: animation {animation.name!r}")
        curves[target.node, target.path] = read_curve(numbers, animation.samplers[channel.sampler], target.path)
    return curves  # type: ignore[return-value]


def _names(found: Sequence[_Found], file: str) -> list[str]:
    """One name for each, all different."""
    animations, bodies = ({getter(each) for each in found} for getter in (lambda x: x.animation, lambda x: x.body))
    names = []
    for each in found:
        parts = [each.animation] * (len(animations) > 1) + [each.body.name] * (len(bodies) > 1)
        names.append(SEPARATOR.join([file, *parts]))
    times = Counter(names)
    return [f"{name}.{number}" if times[name] > 1 else name for number, name in enumerate(names)]


def _clip(tree: NodeTree, found: _Found, name: str) -> Clip:
    body, curves, fps = found.body, found.curves, found.fps
    seconds = found.start + np.arange(found.frames) / fps
    rest_places, rest_turns = world_poses(tree, body, {}, 0.0)
    places, turns = world_poses(tree, body, curves, seconds)
    at = {node: joint for joint, node in enumerate(body.nodes)}
    parents = np.array([at.get(tree.parent[node], -1) for node in body.nodes])
    offsets = rest_places[0] - rest_places[0, np.maximum(parents, 0)]
    skeleton = Skeleton(
        names=tuple(tree.nodes[node].name or f"node {node}" for node in body.nodes),
        parents=parents,
        offsets=offsets,
        where=tree.where,
    )
    turns = quaternion.multiply(turns, quaternion.conjugate(rest_turns))
    reach = quaternion.rotate(quaternion.conjugate(turns[:, parents[1:]]), places[:, 1:] - places[:, parents[1:]])
    moved = np.concatenate([np.zeros((len(reach), 1, 3)), reach], axis=1)
    return Clip(
        name=name,
        skeleton=skeleton,
        fps=fps,
        root_position=places[:, 0],
        rotations=local_rotations(skeleton, turns),
        translations=moved if np.abs(moved - offsets).max() > _STILL else None,
    )


def _sampling(curves: Curves, where: str) -> tuple[float, float, int]:
    """Frames a second, when the first is, and how many: those of the keys, where these come evenly."""
    times = [curve.times for curve in curves.values()]
    start, end = min(keys[0] for keys in times), max(keys[-1] for keys in times)
    fps = _rate(max(times, key=len))
    frames = int((end - start) * fps + 0.01) + 1
    if frames > MAX_FRAMES:
        problem = f"{frames} frames at {fps:g} frames a second in one animation"
        raise InputError(f"{problem}, expected at most {MAX_FRAMES}", where)
    return fps, float(start), frames


def _rate(keys: NDArray[np.float64]) -> float:
    """The rate at which keys come; where they come unevenly, that of the nearest two, and 30 Hz for hardly any."""
    if len(keys) < 2:
        return COMMON_RATE
    steps = np.diff(keys)
    rounding = 2.0 * float(np.spacing(np.float32(keys[-1])))
    even = steps.max() - steps.min() <= _EVEN * steps.min() + rounding
    fps = (len(keys) - 1) / (keys[-1] - keys[0]) if even else 1.0 / steps.min()
    if not _SLOWEST <= fps <= _FASTEST:
        return COMMON_RATE if fps < _SLOWEST else _FASTEST
    slack = _WHOLE + fps * rounding / (keys[-1] - keys[0] if even else steps.min())
    return float(round(fps)) if abs(fps - round(fps)) <= fps * slack else float(fps)
