"""Where the joints of a glTF body are in the world, at rest and while an animation plays."""

from collections.abc import Mapping

import numpy as np
from msgspec import UNSET
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from footwork.errors import InputError
from footwork.motion.gltf_curves import Curve
from footwork.motion.gltf_nodes import Body, NodeTree
from footwork.motion.textfile import MAX_SIZE

_SKEWED = 1e-2  # cosine between two axes of a joint, which are at right angles
_SMALLEST = 1e-6  # scale

Curves = Mapping[tuple[int, str], Curve]
"""What an animation says, by node and by what of it."""


def world_poses(
    tree: NodeTree, body: Body, curves: Curves, seconds: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places (n, J, 3) and rotations xyzw (n, J, 4) of a body's nodes in the world, at times (n,).

    Without curves it is the rest of the file. Scale takes part in the places alone.

    Raises:
        InputError: for joints that are sheared, mirrored or without size, and numbers that are not of ordinary size.
    """
    when = np.atleast_1d(np.asarray(seconds, dtype=np.float64))
    axes: dict[int, NDArray] = {-1: np.eye(3)[None]}
    places: dict[int, NDArray] = {-1: np.zeros((1, 3))}
    for node in (*body.above, *body.nodes):
        parent = tree.parent[node]
        own_axes, own_place = _local(tree, node, curves, when)
        axes[node] = axes[parent] @ own_axes
        places[node] = places[parent] + np.einsum("...ij,...j->...i", axes[parent], own_place)
    shape = (len(when), len(body.nodes))
    joined = np.empty((*shape, 3))
    turns = np.empty((*shape, 4))
    for joint, node in enumerate(body.nodes):
        joined[:, joint] = places[node]
        turns[:, joint] = _rotations(axes[node], f"{tree.where}: node {node}")
    if not (np.abs(joined) < MAX_SIZE).all():
        raise InputError(f"its joints come to places that are not finite ones under {MAX_SIZE:g} m", tree.where)
    return joined, turns


def _local(tree: NodeTree, number: int, curves: Curves, when: NDArray) -> tuple[NDArray, NDArray]:
    """A node's axes (n or 1, 3, 3), columns as long as its scale, and its place (n or 1, 3), in its parent."""
    node, where = tree.nodes[number], f"{tree.where}: node {number}"

    def value(path: str, still: tuple[float, ...]) -> NDArray[np.float64]:
        curve = curves.get((number, path))
        return np.array([still]) if curve is None else curve.at(when)

    if node.matrix is not UNSET:
        matrix = _finite(np.array(node.matrix), where).reshape(4, 4).T
        return matrix[None, :3, :3], matrix[None, :3, 3]
    rotation = _finite(value("rotation", node.rotation), where)
    if not np.linalg.norm(rotation, axis=-1).min() > _SMALLEST:
        raise InputError("a rotation of no length, expected 1", where)
    scale = _finite(value("scale", node.scale), where)
    return Rotation.from_quat(rotation).as_matrix() * scale[:, None, :], _finite(
        value("translation", node.translation), where
    )


def _finite(values: NDArray[np.float64], where: str) -> NDArray[np.float64]:
    if not (np.abs(values) < MAX_SIZE).all():
        raise InputError(f"holds numbers that are not finite ones under {MAX_SIZE:g}", where)
    return values


def _rotations(axes: NDArray[np.float64], where: str) -> NDArray[np.float64]:
    """The rotations of axes that may be scaled.  # (n, 3, 3) -> (n, 4)"""
    lengths = np.linalg.norm(axes, axis=-2, keepdims=True)
    if not (lengths.min() > _SMALLEST and lengths.max() < MAX_SIZE):
        raise InputError(f"its scale is {lengths.min():.3g} to {lengths.max():.3g}, expected ordinary numbers", where)
    units = axes / lengths
    skew = np.abs(np.swapaxes(units, -1, -2) @ units - np.eye(3)).max()
    if not skew < _SKEWED:
        raise InputError("is sheared, expected scales that are the same along all axes", where)
    if np.linalg.det(units).min() < 0.0:
        raise InputError("is mirrored, expected scales above 0", where)
    return Rotation.from_matrix(units).as_quat()
