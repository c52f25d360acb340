"""Paths bare and as the runtime shows them: how jerky they are, and how feet slide on them."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import clip_places
from footwork.motion.moves import moves_along
from footwork.runtime.world import World
from footwork.study.foot_slide import Slide
from footwork.study.graph_paths import path_nodes
from footwork.study.path_quality import slide_by_step
from footwork.study.placing import clip_of_poses


def played_clip(graph: MotionGraph, edges: NDArray[np.int64], *, as_shown: bool) -> Clip:
    """The poses of a character on its way along a path, from after its first tick on.  # (E',) -> E' frames

    Args:
        graph: the graph.
        edges: the path.
        as_shown: inertialised and with feet held, as the server shows them; as they are in the graph otherwise.

    Raises:
        InputError: for edges that are no path.
    """
    nodes = path_nodes(graph, edges)
    world = World(graph, 1, inertialise=as_shown, foot_lock=as_shown)
    slot = world.spawn(int(nodes[0]), 0.0, 0.0, 0.0)
    root, rotations = [], []
    for edge in edges.astype(np.int32):
        world.step(moves_along(graph, np.array([edge])))
        shown_root, shown_rotations = world.show(1.0)
        root.append(shown_root[slot].copy())
        rotations.append(shown_rotations[slot].copy())
    return clip_of_poses(graph, nodes[1:], root, rotations, "played")


def jerkiness(clip: Clip) -> NDArray[np.float64]:
    """How far each frame is off the middle of its neighbours: root mean square over joints, metres.  # (F - 2,)

    A jump of the pose by d shows as d / 2; smooth motion as its acceleration.
    """
    places = clip_places(clip)[0]
    off = places[1:-1] - 0.5 * (places[:-2] + places[2:])
    return np.sqrt(np.mean(np.sum(off**2, axis=-1), axis=-1))


def slide_inside(graph: MotionGraph, edges: NDArray[np.int64]) -> Slide:
    """The slide of the bare path over its natural edges alone: what captured and interpolated motion do themselves."""
    parts = slide_by_step(graph, edges)
    return parts["captured"] + parts["interpolated"]
