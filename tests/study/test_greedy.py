import numpy as np

from footwork.motion.actions import actions_of
from footwork.motion.turn_warp import turn_warp
from footwork.study.greedy import greedy
from planning import TASK, graph_of_whole_turns, played_sum, player, rewards


def test_it_takes_the_best_reward_of_each_tick():
    graph, (heading, behaviour) = graph_of_whole_turns(), player(3, 1)
    behaviour = np.maximum(behaviour, 1)
    controller, actions = greedy(graph, TASK), actions_of(graph, TASK, turn_warp(graph))
    for node in range(graph.node_count):
        best = max(reward for *_, reward in rewards(actions, TASK, node, 0.0, heading[0], behaviour[0]))
        assert played_sum(TASK, controller, 1.0, node, heading, behaviour) >= best - 1e-6
