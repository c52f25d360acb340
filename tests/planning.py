"""A small graph to plan on, whose turns are whole bins; players for it; and the slow way to the best plan."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.motion.actions import Actions, actions_of
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.task import SteeringTask
from footwork.motion.turn_warp import turn_warp
from toy_bundle import toy_bundle

BIN = math.radians(10.0)
TASK = SteeringTask(
    reward="sum", weight=0.7, warp=math.radians(5.0), warp_share={"walk": 1.0, "jump": 1.0}, warp_levels=3
)


def graph_of_whole_turns(seed: int = 0) -> MotionGraph:
    """The toy graph with a turn of -2 to 2 half bins and a smoothness of its own for each edge."""
    graph, random = toy_bundle().graph, np.random.default_rng(seed)
    displacement = graph.displacement.copy()
    displacement[:, 2] = 0.5 * BIN * random.integers(-2, 3, graph.edge_count)
    smoothness = np.where(graph.natural, 1.0, random.uniform(0.5, 1.0, graph.edge_count))
    return replace(graph, displacement=displacement, smoothness=smoothness)


def player(seed: int, ticks: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Headings of whole bins and behaviours, which change now and then; some of them nothing can answer."""
    random = np.random.default_rng(seed)
    hold = random.integers(1, 4)
    heading = BIN * np.repeat(random.integers(-9, 10, ticks), hold)[:ticks].astype(np.float64)
    return heading, np.repeat(random.choice([-1, 0, 1, 1, 3], ticks), hold)[:ticks].astype(np.int32)


def rewards(
    actions: Actions, task: SteeringTask, node: int, yaw: float, heading: float, wanted: int
) -> list[tuple[int, float, float]]:
    """Where every action leads, the yaw there, and what it earns."""
    found = []
    for edge in range(actions.edge_start[node], actions.edge_start[node + 1]):
        there = int(actions.target[edge])
        for level in range(len(actions.level) if actions.turn_limit[there] > 0 else 1):
            faced = yaw + float(actions.yaw[edge]) + actions.level[level] * actions.turn_limit[there]
            smoothness = float(actions.smoothness[edge]) * actions.turn_smoothness[there, level]
            control = 0.0
            if wanted >= 0:
                control = float(
                    task.control_quality(np.array(heading - faced), np.array(wanted), actions.behaviour[there])
                )
            found.append((there, faced, control + task.weight * (smoothness - 1.0)))
    return found


def best_sum(graph: MotionGraph, task: SteeringTask, discount: float, node: int, heading, behaviour) -> float:
    """The greatest sum of rewards over all ways from a node at yaw 0, every one of them walked."""
    actions = actions_of(graph, task, turn_warp(graph))

    def best(tick: int, node: int, yaw: float) -> float:
        if tick == len(heading):
            return 0.0
        ways = rewards(actions, task, node, yaw, float(heading[tick]), int(behaviour[tick]))
        return max(reward + discount * best(tick + 1, there, faced) for there, faced, reward in ways)

    return best(0, node, 0.0)


def played_sum(task: SteeringTask, controller: Controller, discount: float, node: int, heading, behaviour) -> float:
    """The sum of what a controller's moves earn from a node at yaw 0."""
    graph = controller.graph
    actions, moves, total, yaw = actions_of(graph, task, turn_warp(graph)), no_moves(1), 0.0, 0.0
    controller.begin(0)
    for tick, (wanted, asked) in enumerate(zip(heading, behaviour, strict=True)):
        place = np.array([[0.0, 0.0, yaw]])
        at = np.array([node], np.int32)
        controller.choose(Situations(np.zeros(1, np.intp), at, place, np.array([wanted]), np.array([asked])), moves)
        edge, node = int(moves.edge[0]), int(moves.target[0])
        turn = float(moves.adjustment[0, 2])
        yaw += float(moves.displacement[0, 2]) + turn
        quality = float(actions.smoothness[edge]) * np.exp(-4.0 * actions.price[node] * np.sin(0.5 * turn) ** 2)
        control = 0.0
        if asked >= 0:
            control = float(task.control_quality(np.array(wanted - yaw), np.array(asked), actions.behaviour[node]))
        total += discount**tick * (control + task.weight * (quality - 1.0))
    return total
