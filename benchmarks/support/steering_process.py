"""Decision processes of the structure of ours and of any size: random edges that shift headings by parts of bins."""

import math

import numpy as np

from footwork.motion.actions import Actions, rules_of
from footwork.motion.task import SteeringTask


def random_process(nodes: int, edges: int, task: SteeringTask, seed: int = 0) -> Actions:
    """As many edges from every node, to nodes at random."""
    rng = np.random.default_rng(seed)
    target = rng.integers(0, nodes, nodes * edges)
    return _actions(rng, np.full(nodes, edges), target, rng.uniform(0.3, 1.0, nodes * edges), task)


def captured_process(nodes: int, transitions: int, task: SteeringTask, seed: int = 0) -> Actions:
    """As a motion graph has it: every node leads to the next, and transitions lead elsewhere."""
    rng = np.random.default_rng(seed)
    leaves = np.bincount(rng.integers(0, nodes, transitions), minlength=nodes)
    first = np.concatenate([[0], np.cumsum(1 + leaves)[:-1]])
    target = rng.integers(0, nodes, nodes + transitions)
    target[first] = (np.arange(nodes) + 1) % nodes
    smoothness = rng.uniform(0.3, 1.0, len(target))
    smoothness[first] = 1.0
    return _actions(rng, 1 + leaves, target, smoothness, task)


def _actions(rng: np.random.Generator, edges: np.ndarray, target: np.ndarray, qt: np.ndarray, task) -> Actions:
    nodes = len(edges)
    behaviour = rng.integers(0, len(task.behaviours), nodes).astype(np.int16)
    limit, price = task.turn_limit(behaviour), rng.uniform(5.0, 25.0, nodes)
    turn = limit[:, None] * task.turn_levels
    return Actions(
        edge_start=np.concatenate([[0], np.cumsum(edges)]).astype(np.int32),
        target=target.astype(np.int32),
        yaw=rng.normal(0.0, math.radians(6.0), len(target)).astype(np.float32),
        smoothness=qt.astype(np.float32),
        behaviour=behaviour,
        turn_limit=limit,
        price=price,
        level=task.turn_levels,
        turn_smoothness=np.exp(-4.0 * price[:, None] * np.sin(0.5 * turn) ** 2),
        headed=task.headed,
        speed=np.zeros(nodes),
        rules=rules_of(task),
    )
