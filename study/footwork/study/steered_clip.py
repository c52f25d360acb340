"""A clip of a character that follows a few orders: what a bundle looks like when it is played."""

from collections.abc import Sequence

import numpy as np

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.clip import Clip
from footwork.motion.tick import TICK_RATE
from footwork.runtime.simulation import Simulation
from footwork.study.placing import clip_of_poses


def steered_clip(bundle: Bundle, orders: Sequence[tuple[float, float, str]]) -> Clip:
    """The poses shown at each tick while a character follows orders, from standing at yaw 0.

    Args:
        bundle: the character's.
        orders: seconds, heading in degrees (positive left), behaviour; one after the other.

    Raises:
        InputError: for no orders, or a behaviour that the bundle lacks.
    """
    graph, simulation = bundle.graph, Simulation(bundle, 1)
    slot = simulation.spawn(0.0, 0.0, 0.0)
    root, rotations, nodes = [], [], []
    for seconds, heading, behaviour in orders:
        simulation.give(slot, simulation.vocabulary.outright(float(np.radians(heading)), behaviour))
        for _ in range(round(seconds * TICK_RATE)):
            simulation.step()
            shown = simulation.show(1.0)
            root.append(shown.root[slot].copy())
            rotations.append(shown.rotations[slot].copy())
            nodes.append(int(simulation.world.node[slot]))
    if not nodes:
        raise InputError("no orders of at least one tick, expected some", "orders")
    return clip_of_poses(graph, nodes, root, rotations, "steered")
