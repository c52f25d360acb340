"""Clips to GLB: a skeleton, a skin and a mesh of capsules for each body, and an animation for each take.

glTF's frame and units are those of footwork: metres, +y up, +z forward, quaternions xyzw.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from msgspec import UNSET, UnsetType
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import gltf_document as g
from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT
from footwork.motion.body_mesh import BodyMesh, body_mesh
from footwork.motion.clip import Clip
from footwork.motion.glb_container import write_container
from footwork.motion.kinematics import forward
from footwork.motion.skeleton import Skeleton
from footwork.motion.textfile import MAX_NAME

_COLOURS = ((0.36, 0.56, 0.80), (0.85, 0.48, 0.30), (0.45, 0.68, 0.42), (0.70, 0.52, 0.76))
_KINDS = {np.dtype(np.float32): g.FLOAT, np.dtype(np.uint16): g.UNSIGNED_SHORT, np.dtype(np.uint32): g.UNSIGNED_INT}
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


@dataclass(frozen=True, eq=False)
class Part:
    """What one body does in a take.

    Args:
        body: its name in the file.
        clip: its motion; clips of one body have one skeleton.
        start: when it begins, seconds into the take.
    """

    body: str
    clip: Clip
    start: float = 0.0


@dataclass(frozen=True, eq=False)
class Take:
    """What bodies do at the same time: an animation under a name."""

    name: str
    parts: Sequence[Part]


def take_of(clip: Clip, body: str = "character") -> Take:
    """A clip as a take of its own."""
    return Take(clip.name, (Part(body, clip),))


def write_glb(path: str | Path, takes: Sequence[Take], rights: str = "") -> None:
    """Write takes as one file.

    A joint's rest is its offset without rotation, so bodies stand at the origin in the pose of their skeletons' rest.
    A joint gets a translation channel where the clip's ``translations`` move it off its offset. Contacts,
    labels and the tips of segments have no place in the format.

    Args:
        path: the file.
        takes: at least one.
        rights: whose the motion is, for the file's copyright.

    Raises:
        InputError: for no takes, two skeletons of one body, or a file that is too long or cannot be written.
    """
    file = _File()
    bodies = {name: _put_body(file, name, number, body) for number, (name, body) in enumerate(_bodies(takes, path))}
    for take in takes:
        file.document.animations.append(_animation(file, take, bodies))
    file.document.asset.copyright = rights or UNSET
    file.document.buffers.append(g.Buffer(byte_length=len(file.blob)))
    write_container(path, file.document, bytes(file.blob))


def _bodies(takes: Sequence[Take], path: str | Path) -> list[tuple[str, Skeleton]]:
    bodies: dict[str, Skeleton] = {}
    for part in (part for take in takes for part in take.parts):
        body = bodies.setdefault(part.body, part.clip.skeleton)
        other = part.clip.skeleton
        if other.names != body.names or not np.allclose(other.offsets, body.offsets):
            raise InputError(f"{part.clip.name} has another skeleton than {part.body}, expected one a body", path)
    if not bodies:
        raise InputError("nothing to write, expected at least one take", path)
    return list(bodies.items())


@dataclass
class _File:
    """A document as it is put together, and its bytes."""

    document: g.Document = field(
        default_factory=lambda: g.Document(
            asset=g.Asset(version="2.0", generator=f"footwork {version('footwork')}"),
            scene=0,
            scenes=[g.Scene()],
        )
    )
    blob: bytearray = field(default_factory=bytearray)
    times: dict[tuple[int, float, float], int] = field(default_factory=dict)
    meshes: dict[int, dict[str, int]] = field(default_factory=dict)

    def accessor(self, values: NDArray, *, target: int | UnsetType = UNSET, bounded: bool = False) -> int:
        """Put an array (n,) or (n, k) into the file; returns its accessor."""
        self.blob += bytes(-len(self.blob) % 4)
        data = np.ascontiguousarray(values).tobytes()
        view = g.BufferView(buffer=0, byte_offset=len(self.blob), byte_length=len(data), target=target)
        self.document.buffer_views.append(view)
        self.blob += data
        rows = values.reshape(len(values), -1)
        accessor = g.Accessor(
            component_type=_KINDS[values.dtype],
            count=len(rows),
            type=_TYPES[rows.shape[1]],
            buffer_view=len(self.document.buffer_views) - 1,
        )
        if bounded:
            accessor.min, accessor.max = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
        self.document.accessors.append(accessor)
        return len(self.document.accessors) - 1

    def node(self, **parts: Any) -> int:
        """Put a node into the file; returns its number."""
        self.document.nodes.append(g.Node(**parts))
        return len(self.document.nodes) - 1

    def time(self, count: int, fps: float, start: float) -> int:
        """The accessor of a clip's times, one for all that share them."""
        key = count, fps, start
        if key not in self.times:
            seconds = (start + np.arange(count) / fps).astype(np.float32)
            self.times[key] = self.accessor(seconds, bounded=True)
        return self.times[key]


def _put_body(file: _File, name: str, number: int, skeleton: Skeleton) -> int:
    """A body with its skin and its mesh; returns the node of its first joint, which the others follow."""
    document = file.document
    top = file.node(name=name)
    root = _put_joints(file, skeleton)
    document.nodes[top].children = [root]
    rest = forward(skeleton, _standing(skeleton), np.tile(quaternion.IDENTITY, (skeleton.joint_count, 1)))[0]
    inverse = np.tile(np.eye(4), (skeleton.joint_count, 1, 1))
    inverse[:, 3, :3] = -rest  # column by column, so the last row is the translation
    matrices = file.accessor(inverse.reshape(-1, 16).astype(np.float32))
    joints = list(range(root, root + skeleton.joint_count))
    document.skins.append(g.Skin(name=name, joints=joints, skeleton=top, inverse_bind_matrices=matrices))
    document.meshes.append(_mesh(file, skeleton, rest, name, number))
    # the file's rule: a skin moves a mesh, so the mesh's node stands at the top and is not moved as well
    skinned = file.node(name=f"{name} mesh", mesh=number, skin=number)
    document.scenes[0].nodes += [top, skinned]
    return root


def _standing(skeleton: Skeleton) -> NDArray[np.float64]:
    """Where the root is at rest: so high that the lowest joint stands on the floor.  # (3,)"""
    rest = forward(skeleton, np.zeros(3), np.tile(quaternion.IDENTITY, (skeleton.joint_count, 1)))[0]
    return np.array([0.0, BALL_HEIGHT - rest[:, 1].min(), 0.0])


def _put_joints(file: _File, skeleton: Skeleton) -> int:
    root = len(file.document.nodes)
    for joint, name in enumerate(skeleton.names):
        place = skeleton.offsets[joint] if joint else _standing(skeleton)
        file.node(
            name=name,
            translation=tuple(place.tolist()),
            children=[root + child for child in skeleton.children(joint)],
        )
    return root


def _mesh(file: _File, skeleton: Skeleton, rest: NDArray[np.float64], name: str, number: int) -> dict[str, Any]:
    key = id(skeleton)
    if key not in file.meshes:
        file.meshes[key] = _put_mesh(file, body_mesh(skeleton), rest)
    attributes = dict(file.meshes[key])
    indices = attributes.pop("indices")
    colour = [*_COLOURS[number % len(_COLOURS)], 1.0]
    surface = {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.8}
    file.document.materials.append({"name": name, "pbrMetallicRoughness": surface})
    return {"name": name, "primitives": [{"attributes": attributes, "indices": indices, "material": number}]}


def _put_mesh(file: _File, mesh: BodyMesh, rest: NDArray[np.float64]) -> dict[str, int]:
    """The mesh's accessors by attribute; every corner is moved by one joint alone."""
    corners = len(mesh.points)
    joints, weights = np.zeros((corners, 4), np.uint16), np.zeros((corners, 4), np.float32)
    joints[:, 0], weights[:, 0] = mesh.joint, 1.0
    colours = np.repeat(mesh.shade[:, None], 3, axis=1)

    def put(values: NDArray, bounded: bool = False) -> int:
        return file.accessor(values, target=g.VERTICES, bounded=bounded)

    return {
        "POSITION": put((rest[mesh.joint] + mesh.points).astype(np.float32), bounded=True),
        "NORMAL": put(mesh.normals.astype(np.float32)),
        "COLOR_0": put(colours.astype(np.float32)),
        "JOINTS_0": put(joints),
        "WEIGHTS_0": put(weights),
        "indices": file.accessor(mesh.triangles.ravel().astype(np.uint32), target=g.INDICES),
    }


def _animation(file: _File, take: Take, bodies: dict[str, int]) -> g.Animation:
    animation = g.Animation(name=take.name[:MAX_NAME], channels=[], samplers=[])
    for part in take.parts:
        times = file.time(part.clip.frame_count, part.clip.fps, part.start)
        for node, path, values in _movements(part.clip, bodies[part.body]):
            animation.samplers.append(g.Sampler(input=times, output=file.accessor(values.astype(np.float32))))
            target = g.Target(node=node, path=path)
            animation.channels.append(g.Channel(sampler=len(animation.samplers) - 1, target=target))
    return animation


def _movements(clip: Clip, root: int) -> Iterable[tuple[int, str, NDArray[np.float64]]]:
    """(node, what of it, values by frame) of all that moves."""
    yield root, "translation", clip.root_position
    if clip.translations is not None:
        for joint in np.flatnonzero((clip.translations != clip.skeleton.offsets).any(axis=(0, 2))):
            if joint > 0:
                yield root + int(joint), "translation", clip.translations[:, joint]
    rotations = quaternion.unroll(quaternion.normalise(clip.rotations))
    for joint in range(clip.skeleton.joint_count):
        yield root + joint, "rotation", rotations[:, joint]
