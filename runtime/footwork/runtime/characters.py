"""What a tick reads and writes, as tuples of arrays that its kernels take whole."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.moves import LEAP
from footwork.runtime.foot_lock import legs_of, lowest_balls
from footwork.runtime.inertialisation import ticks_to_settle
from footwork.runtime.motion_rows import node_rows, offset_rows


class Characters(NamedTuple):
    """All that a world remembers of its characters, a row for each slot.

    Args:
        node: where each is on the graph.  # (C,) int32
        place: planar place (x, z, yaw), metres and radians.  # (C, 3) float64
        edge: the edge last taken, ``LEAP`` for none.  # (C,) int32
        natural: whether the last move followed the capture.  # (C,) bool
        glide: the even planar motion that the last move added over its tick, m and rad a tick.  # (C, 3) float64
        ticks_left: after how many more ticks the offsets are dropped, 0 where there are none.  # (C,) int32
        offsets: ``motion_rows.offset_rows`` as the tick began, rad and rad/s.  # (C, 6, padded J) float32
        roots: offset (m) and its velocity (m/s) of the root, as the tick began.  # (C, 2, 3) float64
        locked: which feet stay where they are.  # (C, feet) bool
        anchor: where: ball x and z in the world, sine and cosine of the foot's yaw.  # (C, feet, 4) float64
        slip: of feet not locked, offset and its velocity, as the tick began.  # (C, feet, 2, 3) float64
        stride: how many ticks are left of each foot's step.  # (C, feet) int32
    """

    node: NDArray[np.int32]
    place: NDArray[np.float64]
    edge: NDArray[np.int32]
    natural: NDArray[np.bool_]
    glide: NDArray[np.float64]
    ticks_left: NDArray[np.int32]
    offsets: NDArray[np.float32]
    roots: NDArray[np.float64]
    locked: NDArray[np.bool_]
    anchor: NDArray[np.float64]
    slip: NDArray[np.float64]
    stride: NDArray[np.int32]


def no_characters(capacity: int, joints: int, feet: int) -> Characters:
    """Room for so many characters of one body."""
    return Characters(
        node=np.zeros(capacity, dtype=np.int32),
        place=np.zeros((capacity, 3)),
        edge=np.full(capacity, LEAP, dtype=np.int32),
        natural=np.ones(capacity, dtype=np.bool_),
        glide=np.zeros((capacity, 3)),
        ticks_left=np.zeros(capacity, dtype=np.int32),
        offsets=offset_rows(capacity, joints),
        roots=np.zeros((capacity, 2, 3)),
        locked=np.zeros((capacity, feet), dtype=np.bool_),
        anchor=np.zeros((capacity, feet, 4)),
        slip=np.zeros((capacity, feet, 2, 3)),
        stride=np.zeros((capacity, feet), dtype=np.int32),
    )


class Motion(NamedTuple):
    """What characters move on: the arrays of a graph and its body that a tick reads.

    Args:
        edge_start: of the graph, and so are ``target`` to ``root_velocity``.  # (N + 1,)
        target: where each edge leads.  # (E,)
        contacts: which feet stand.  # (N, feet)
        root_position: metres.  # (N, 3)
        root_velocity: m/s.  # (N, 3)
        nodes: ``motion_rows.node_rows``.  # (N, 7, padded J)
        legs: ``foot_lock.legs_of`` the body.  # (feet, 4)
        bones: its rest offsets, metres.  # (J, 3)
        spans: lengths of thigh and shank, metres.  # (feet, 2)
        floor: height of the lowest balls, metres.
    """

    edge_start: NDArray
    target: NDArray
    contacts: NDArray
    root_position: NDArray
    root_velocity: NDArray
    nodes: NDArray[np.float32]
    legs: NDArray[np.int32]
    bones: NDArray[np.float64]
    spans: NDArray[np.float64]
    floor: float


def motion_of(graph: MotionGraph) -> Motion:
    """What a tick reads of a graph."""
    legs, bones = legs_of(graph.skeleton), graph.skeleton.offsets
    return Motion(
        edge_start=graph.edge_start,
        target=graph.target,
        contacts=graph.contacts,
        root_position=graph.root_position,
        root_velocity=graph.root_velocity,
        nodes=node_rows(graph),
        legs=legs,
        bones=bones,
        spans=np.linalg.norm(bones[legs[:, 1:3]], axis=-1),
        floor=lowest_balls(graph, legs),
    )


class Smoothing(NamedTuple):
    """How much of what is shown differs from the capture.

    Args:
        inertialise: whether transitions are smoothed.
        foot_lock: whether feet that stand stay where they are shown.
        halflife: of what inertialisation adds, s.
        settle_ticks: after how many ticks that is dropped.
    """

    inertialise: bool
    foot_lock: bool
    halflife: float
    settle_ticks: int


def smoothing(inertialise: bool, foot_lock: bool, halflife: float) -> Smoothing:
    """Smoothing whose offsets are dropped once they are too small to be seen."""
    return Smoothing(inertialise, foot_lock, float(halflife), ticks_to_settle(halflife))
