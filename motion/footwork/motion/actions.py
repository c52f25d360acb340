"""What a character may do at every node of a graph, and what that earns, as flat arrays for kernels."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.node_speed import node_speeds
from footwork.motion.task import SteeringTask
from footwork.motion.turn_warp import TurnWarp


class Rules(NamedTuple):
    """What of a task the kernels need besides arrays.

    Args:
        heading_sigma: width of the Gaussian that judges the heading, radians.
        discount: the worth of the next tick's reward against this one's.
        additive: whether the reward is the sum.
        weight: of the transition quality in a sum.
        speed_sigma: SteeringTask.speed_sigma.
        speed_weight: SteeringTask.speed_weight.
    """

    heading_sigma: float
    discount: float
    additive: bool
    weight: float
    speed_sigma: float
    speed_weight: float


class Actions(NamedTuple):
    """Edges, each with any of L extra turns about the target's pivot, on a graph of N nodes and E edges.

    Kernels unpack it once and hand arrays on: to compiled code, each look into a tuple of arrays counts references.

    Args:
        edge_start: CSR row starts.  # (N + 1,)
        target: CSR columns.  # (E,)
        yaw: how far each edge turns, radians.  # (E,)
        smoothness: qt of each edge taken as it is, less SteeringTask.transition_price.  # (E,)
        behaviour: of each node.  # (N,)
        turn_limit: the largest extra turn on arriving at each node, radians.  # (N,)
        price: s / sigma of an extra turn there, divided by 4 sin^2(turn / 2).  # (N,)
        level: extra turns to choose among, as shares of the largest, none first.  # (L,)
        turn_smoothness: what each multiplies qt by.  # (N, L)
        headed: SteeringTask.headed.  # (B,)
        speed: of each node, m/s; zero where no speed can be asked for.  # (N,)
        rules: the scalars.
    """

    edge_start: NDArray[np.int32]
    target: NDArray[np.int32]
    yaw: NDArray[np.float32]
    smoothness: NDArray[np.float32]
    behaviour: NDArray[np.int16]
    turn_limit: NDArray[np.float64]
    price: NDArray[np.float64]
    level: NDArray[np.float64]
    turn_smoothness: NDArray[np.float64]
    headed: NDArray[np.bool_]
    speed: NDArray[np.float64]
    rules: Rules


def actions_of(graph: MotionGraph, task: SteeringTask, warp: TurnWarp | None = None) -> Actions:
    """The actions of a task whose behaviours are the graph's; ``warp`` is the graph's own, None where none turns."""
    limit = task.turn_limit(graph.behaviour)
    price = np.zeros(graph.node_count) if warp is None else warp.price / task.smoothness_sigma
    turn = limit[:, None] * task.turn_levels
    actions = Actions(
        edge_start=graph.edge_start,
        target=graph.target,
        yaw=np.ascontiguousarray(graph.displacement[:, 2]),
        smoothness=np.where(graph.natural, 1.0, 1.0 - task.transition_price).astype(np.float32) * graph.smoothness,
        behaviour=graph.behaviour,
        turn_limit=limit,
        price=price,
        level=task.turn_levels,
        turn_smoothness=np.exp(-4.0 * price[:, None] * np.sin(0.5 * turn) ** 2),
        headed=task.headed,
        speed=node_speeds(graph) if task.speeds else np.zeros(graph.node_count),
        rules=rules_of(task),
    )
    return _read_only(actions)


def _read_only(actions: Actions) -> Actions:
    """The same with no array to be written to: kernels are compiled anew for each mixture."""
    arrays = {name: part for name, part in actions._asdict().items() if isinstance(part, np.ndarray)}
    return actions._replace(**{name: frozen(array, array.dtype) for name, array in arrays.items()})


def rules_of(task: SteeringTask) -> Rules:
    """The scalars of a task."""
    return Rules(task.heading_sigma, task.discount, task.additive, task.weight, task.speed_sigma, task.speed_weight)


def onward_edges(graph: MotionGraph) -> NDArray[np.int32]:
    """How each node goes on while a decision holds: by its first natural edge, else by its smoothest.  # (N,)"""
    order = np.lexsort((np.where(graph.natural, -2.0, -graph.smoothness), graph.source))
    return order[graph.edge_start[:-1]].astype(np.int32)


def onward_actions(actions: Actions, onward: NDArray[np.int32]) -> Actions:
    """Only to go on, each node by one edge (N,), without an extra turn."""
    goes_on = actions._replace(
        edge_start=np.arange(len(onward) + 1, dtype=np.int32),
        target=actions.target[onward],
        yaw=actions.yaw[onward],
        smoothness=actions.smoothness[onward],
        level=np.zeros(1),
        turn_smoothness=np.ones((len(onward), 1)),
    )
    return _read_only(goes_on)
