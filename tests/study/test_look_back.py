import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from footwork.motion.actions import Actions, actions_of, onward_edges
from footwork.motion.lookahead import reward_of
from footwork.motion.turn_warp import turn_warp
from footwork.study.look_back import LookBack, between_bins
from planning import TASK, graph_of_whole_turns

BINS, DISCOUNT, HEADING = 36, 0.9, 0.4


def slowly(actions: Actions, node: int, wanted: int, after) -> np.ndarray:
    """What a node is worth facing each yaw: every action, one after the other."""
    found, rules = np.full(BINS, -np.inf), actions.rules
    earn: Any = reward_of  # of arrays, too
    yaws = -math.pi + 2.0 * math.pi / BINS * np.arange(BINS)
    for edge in range(actions.edge_start[node], actions.edge_start[node + 1]):
        there = int(actions.target[edge])
        for level in range(len(actions.level) if actions.turn_limit[there] > 0.0 else 1):
            faced = yaws + float(actions.yaw[edge]) + actions.level[level] * actions.turn_limit[there]
            matches = wanted >= 0 and actions.behaviour[there] == wanted
            control = TASK.control_quality(HEADING - faced, np.array(wanted), actions.behaviour[there]) * matches
            quality = float(actions.smoothness[edge]) * actions.turn_smoothness[there, level]
            worth = np.array([between_bins(after[there], yaw) for yaw in faced])
            found = np.maximum(found, earn(control, quality, rules.additive, rules.weight) + DISCOUNT * worth)
    return found


@pytest.mark.parametrize("reward", ["sum", "product"])
@pytest.mark.parametrize("spread", [0.1, 3.0])  # alike, so that edges can be left out at a glance, and not
def test_edges_left_out_are_none_of_the_best(reward, spread):
    graph, random = graph_of_whole_turns(3), np.random.default_rng(7)
    task = replace(TASK, reward=reward)
    actions = actions_of(graph, task, turn_warp(graph))
    looking = LookBack(actions, onward_edges(graph), BINS, DISCOUNT)
    after = random.uniform(0.0, spread, (graph.node_count, BINS)).astype(np.float32)
    before, nodes = np.zeros_like(after), np.arange(graph.node_count, dtype=np.int32)
    for wanted in (-1, 0, 1, 3):
        looking.over(nodes, nodes, HEADING, wanted, after, before)
        for node in range(0, graph.node_count, 3):
            np.testing.assert_allclose(before[node], slowly(actions, node, wanted, after), atol=2e-5)
