from dataclasses import replace

import numpy as np
import pytest

from footwork.controllers.controller import Situations
from footwork.motion.moves import no_moves
from footwork.motion.task import SteeringTask
from footwork.study.oracle import Oracle
from footwork.study.scoring import score
from made_traces import trace
from planning import TASK, best_sum, graph_of_whole_turns, played_sum, player
from toy_bundle import toy_bundle
from toy_graphs import edge_between


@pytest.mark.parametrize("seed", range(2))
def test_its_path_earns_what_the_best_of_all_paths_earns(seed):
    graph, (heading, behaviour) = graph_of_whole_turns(seed), player(seed, 6)
    priced = replace(TASK, transition_price=0.2)  # which no score is charged
    controller = Oracle(graph, priced).knowing(heading, behaviour)
    for node in (2, 30, 61):
        best = best_sum(graph, TASK, 1.0, node, heading, behaviour)
        assert played_sum(TASK, controller, 1.0, node, heading, behaviour) == pytest.approx(best, abs=2e-4)


def test_it_begins_where_most_can_be_earned():
    graph, (heading, behaviour) = graph_of_whole_turns(), player(5, 5)
    begun = Oracle(graph, TASK).knowing(heading, behaviour).start_node("stop")
    # the last frames of the clip that stops have no natural way on
    worth = {node: best_sum(graph, TASK, 1.0, node, heading, behaviour) for node in range(0, 23)}
    assert worth[begun] == pytest.approx(max(worth.values()), abs=1e-4)


def test_values_made_again_in_parts_are_those_of_one_go():
    graph, (heading, behaviour) = graph_of_whole_turns(), player(2, 50)
    controller = Oracle(graph, TASK).knowing(heading, behaviour)
    again = Oracle(graph, TASK).knowing(heading, behaviour)
    again._plan._fill(0)  # type: ignore[attr-defined]  (as if it had gone back)
    sums = [played_sum(TASK, one, 1.0, 4, heading, behaviour) for one in (controller, again)]
    assert sums[0] == sums[1]


def test_it_is_scored_like_a_controller_and_none_of_its_time_in_a_batch():
    bundle = toy_bundle()
    oracle = Oracle(bundle.graph, SteeringTask(behaviours=bundle.graph.behaviours))
    report = score(bundle, [trace("a.csv", 60, turn=0.03, attack=1)], oracle)
    assert report["control"] > 0.4
    assert report["batch"] is None
    assert report["table_mb"] is None


def test_its_facing_is_exact_between_the_bins():
    graph, node = graph_of_whole_turns(), 27
    yaw = float(graph.displacement[edge_between(graph, node, node + 1), 2])
    off, still = 0.03, np.zeros((1, 3))  # less than the warp
    free = replace(TASK, weight=1e-6)  # so that it is worth turning for so little
    controller = Oracle(graph, free).knowing(np.array([yaw + off]), np.array([1], np.int32))
    controller.begin(0)
    moves, at = no_moves(1), np.array([node], np.int32)
    controller.choose(Situations(np.zeros(1, np.intp), at, still, np.zeros(1), np.zeros(1, np.int32)), moves)
    assert moves.displacement[0, 2] + moves.adjustment[0, 2] == pytest.approx(yaw + off, abs=1e-9)
