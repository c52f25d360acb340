"""The motion graph: nodes are frames, edges are what may be played next."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_range, require_shape
from footwork.motion.kinematics import forward
from footwork.motion.skeleton import Skeleton

NO_BEHAVIOUR = -1
_UNIT_TOLERANCE = 1e-3

# the arrays of a graph and what they hold, those of its nodes first
NODE_ARRAYS = {
    "clip": np.int32,
    "frame": np.int32,
    "other_clip": np.int32,
    "other_frame": np.int32,
    "weight": np.float32,
    "label": np.int16,
    "behaviour": np.int16,
    "contacts": np.bool_,
    "root_position": np.float32,
    "rotations": np.float32,
    "root_velocity": np.float32,
    "angular_velocity": np.float32,
}
EDGE_ARRAYS = {
    "target": np.int32,
    "cost": np.float32,
    "smoothness": np.float32,
    "displacement": np.float32,
    "natural": np.bool_,
}
ARRAYS = NODE_ARRAYS | {"edge_start": np.int32} | EDGE_ARRAYS


def captured(clip: ArrayLike, frame: ArrayLike) -> dict[str, NDArray]:
    """The source arrays of nodes that are captured frames.  # (N,) each"""
    clip, frame = np.asarray(clip), np.asarray(frame)
    weight = np.ones(len(clip))
    return {"clip": clip, "frame": frame, "other_clip": clip, "other_frame": frame, "weight": weight}


@dataclass(frozen=True, eq=False)
class MotionGraph:
    """Flat, read-only arrays of N nodes, each a frame of motion, and E edges in CSR form, each one tick long.

    A node's planar frame stands on the ground under joint 0 and looks where the body faces
    (``kinematics.facing_yaw``). Poses and velocities of a node are given in it, so a character is a node and a
    planar place ``(x, z, yaw)``. Velocities are backward differences over one tick: the frame before the node is
    ``root_position - root_velocity / 30`` and ``exp(-angular_velocity / 30) rotations``.

    Args:
        skeleton: the common body.
        clips: names of the source clips.
        labels: the words that frames are labelled with.
        behaviours: the behaviours that commands may ask for (conventions.md 5).
        clip: source clip of each node, an index into ``clips``.  # (N,)
        frame: source frame of each node, at 30 Hz within its clip.  # (N,)
        other_clip: second source clip, ``clip`` itself for a captured frame.  # (N,)
        other_frame: its frame, ``frame`` itself for a captured frame.  # (N,)
        weight: share of the first source, above 0; 1 for a captured frame.  # (N,)
        label: index into ``labels``.  # (N,)
        behaviour: index into ``behaviours``, -1 where the label matches none.  # (N,)
        contacts: which feet stand on the ground.  # (N, feet)
        root_position: joint 0 in the planar frame, metres; x and z are 0.  # (N, 3)
        rotations: local rotations xyzw, joint 0 in the planar frame.  # (N, J, 4)
        root_velocity: of joint 0 in the planar frame, m/s.  # (N, 3)
        angular_velocity: of each local rotation, in the parent's frame, rad/s.  # (N, J, 3)
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node an edge leads to.  # (E,)
        cost: dissimilarity s of the frames an edge joins by the metric that the graph was built with, 0 for natural
            edges (conventions.md 2).  # (E,)
        smoothness: exp(-s / sigma) by the uniform metric, whichever built the graph; 1 for natural edges.  # (E,)
        displacement: the target's planar place (x, z, yaw) in the source's planar frame, metres and radians.  # (E, 3)
        natural: whether the edge follows the capture.  # (E,)

    Raises:
        InputError: for arrays that do not fit together, indices out of range, numbers that are not finite,
            rotations that are not of unit length, costs below 0 or smoothness outside 0..1.
    """

    skeleton: Skeleton
    clips: tuple[str, ...]
    labels: tuple[str, ...]
    behaviours: tuple[str, ...]
    clip: NDArray[np.int32]
    frame: NDArray[np.int32]
    other_clip: NDArray[np.int32]
    other_frame: NDArray[np.int32]
    weight: NDArray[np.float32]
    label: NDArray[np.int16]
    behaviour: NDArray[np.int16]
    contacts: NDArray[np.bool_]
    root_position: NDArray[np.float32]
    rotations: NDArray[np.float32]
    root_velocity: NDArray[np.float32]
    angular_velocity: NDArray[np.float32]
    edge_start: NDArray[np.int32]
    target: NDArray[np.int32]
    cost: NDArray[np.float32]
    smoothness: NDArray[np.float32]
    displacement: NDArray[np.float32]
    natural: NDArray[np.bool_]
    where: str = "graph"

    def __post_init__(self) -> None:
        for name, kind in ARRAYS.items():
            object.__setattr__(self, name, frozen(getattr(self, name), kind))
        for name in ("clips", "labels", "behaviours"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        self._check_shapes()
        self._check_indices()
        self._check_values()

    def _check_shapes(self) -> None:
        nodes, edges, joints = len(self.clip), len(self.target), self.skeleton.joint_count
        shapes = dict.fromkeys(("clip", "frame", "other_clip", "other_frame", "weight", "label", "behaviour"), (nodes,))
        shapes |= dict.fromkeys(("target", "cost", "smoothness", "natural"), (edges,))
        shapes |= {"root_position": (nodes, 3), "root_velocity": (nodes, 3), "displacement": (edges, 3)}
        shapes |= {"rotations": (nodes, joints, 4), "angular_velocity": (nodes, joints, 3)}
        shapes |= {"contacts": (nodes, len(self.skeleton.feet)), "edge_start": (nodes + 1,)}
        for name, shape in shapes.items():
            array = getattr(self, name)
            require_shape(array, shape, name, self.where)
            if array.dtype == np.float32:
                require_finite(array, name, self.where)

    def _check_indices(self) -> None:
        nodes, edges = self.node_count, self.edge_count
        require_range(self.clip, 0, len(self.clips), "clip", self.where)
        require_range(self.other_clip, 0, len(self.clips), "other_clip", self.where)
        require_range(self.label, 0, len(self.labels), "label", self.where)
        require_range(self.behaviour, NO_BEHAVIOUR, len(self.behaviours), "behaviour", self.where)
        require_range(self.target, 0, nodes, "target", self.where)
        require_range(np.diff(self.edge_start), 0, edges + 1, "edges of a node", self.where)
        require_range(self.edge_start[[0]], 0, 1, "edge_start[0]", self.where)
        require_range(self.edge_start[[-1]], edges, edges + 1, "edge_start[-1]", self.where)

    def _check_values(self) -> None:
        lengths = np.linalg.norm(self.rotations, axis=-1)
        if lengths.size and not np.abs(lengths - 1.0).max() < _UNIT_TOLERANCE:
            problem = f"rotations holds quaternions of length {lengths.min():g} to {lengths.max():g}, expected 1"
            raise InputError(problem, self.where)
        for name, high in (("cost", np.inf), ("smoothness", 1.0), ("weight", 1.0)):
            array = getattr(self, name)
            if array.size and not (array.min() >= 0.0 and array.max() <= high):
                raise InputError(f"{name} holds {array.min():g} to {array.max():g}, expected 0 to {high:g}", self.where)
        another = (self.clip != self.other_clip) | (self.frame != self.other_frame)
        if (self.original & another).any():
            node = np.flatnonzero(self.original & another)[0]
            raise InputError(f"node {node} has weight 1 and yet another source than its own", self.where)

    def require_no_dead_ends(self) -> None:
        """Raise InputError where a node has no edge: whoever came there could not go on."""
        ends = np.flatnonzero(np.diff(self.edge_start) == 0)
        if ends.size:
            raise InputError(f"node {ends[0]} leads nowhere, expected at least one edge from every node", self.where)

    @cached_property
    def joint_places(self) -> NDArray[np.float64]:
        """Places of the joints of every node in its planar frame, metres.  # (N, J, 3)"""
        return frozen(forward(self.skeleton, self.root_position, self.rotations)[0], np.float64)

    @property
    def original(self) -> NDArray[np.bool_]:
        """Which nodes are captured frames, not frames between two.  # (N,)"""
        return self.weight == 1.0

    @property
    def nearest_source(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Clip and frame of the source with the greater weight, of equal ones the first.  # (N,) each"""
        first = self.weight >= 0.5
        return np.where(first, self.clip, self.other_clip), np.where(first, self.frame, self.other_frame)

    @property
    def node_count(self) -> int:
        """The number of nodes N."""
        return len(self.clip)

    @property
    def edge_count(self) -> int:
        """The number of edges E."""
        return len(self.target)

    @property
    def source(self) -> NDArray[np.int32]:
        """The node each edge leaves from.  # (E,)"""
        return np.repeat(np.arange(self.node_count, dtype=np.int32), np.diff(self.edge_start))
