import math

import numpy as np
import pytest

from footwork.controllers.controller import Situations
from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion.coded_values import exact
from footwork.motion.moves import no_moves
from footwork.motion.table import PolicyTable
from footwork.study.foresight import Foresight
from planning import TASK, best_sum, graph_of_whole_turns, played_sum, player


def table(graph, seed: int | None = None) -> PolicyTable:
    shape = graph.node_count, len(TASK.behaviours), TASK.heading_bins
    values = np.zeros(shape) if seed is None else np.random.default_rng(seed).uniform(0.0, 3.0, shape)
    return PolicyTable(TASK, exact(values), 0.0, 1, True)


@pytest.mark.parametrize("seed", range(2))
def test_who_knows_all_that_is_to_come_earns_the_best_there_is(seed):
    graph, (heading, behaviour) = graph_of_whole_turns(seed), player(seed, 6)
    controller = Foresight(graph, table(graph), 1.0).knowing(heading, behaviour)
    for node in (2, 30):
        best = best_sum(graph, TASK, TASK.discount, node, heading, behaviour)
        assert played_sum(TASK, controller, TASK.discount, node, heading, behaviour) == pytest.approx(best, abs=2e-4)


def test_without_foresight_it_does_what_the_table_says():
    graph, (heading, behaviour) = graph_of_whole_turns(), player(8, 60)
    behaviour = np.maximum(behaviour, 0)
    known = Foresight(graph, table(graph, 3), 0.0).knowing(heading, behaviour)
    steering = SteeringController(graph, table(graph, 3))
    node, yaw, one, other = 5, 0.0, no_moves(1), no_moves(1)
    for wanted, asked in zip(heading, behaviour, strict=True):
        place = np.array([[0.0, 0.0, yaw]])
        at = np.array([node], np.int32)
        situations = Situations(np.zeros(1, np.intp), at, place, np.array([wanted]), np.array([asked]))
        known.choose(situations, one)
        steering.choose(situations, other)
        assert one.edge[0] == other.edge[0]
        np.testing.assert_allclose(one.adjustment, other.adjustment, atol=1e-12)
        node, yaw = int(one.target[0]), yaw + float(one.displacement[0, 2] + one.adjustment[0, 2])


@pytest.mark.parametrize(("seconds", "changed"), [(0.2, 20), (0.8, 38)])  # plans that last for 3 ticks, and for 4
def test_what_is_not_known_yet_changes_nothing(seconds, changed):
    graph, (heading, behaviour) = graph_of_whole_turns(), player(1, 40)
    other = heading.copy()
    other[changed:] += 1.0
    known = [Foresight(graph, table(graph, 4), seconds).knowing(each, behaviour) for each in (heading, other)]
    sums = [played_sum(TASK, one, 1.0, 30, heading[:14], behaviour[:14]) for one in known]
    assert sums[0] == sums[1]


@pytest.mark.parametrize("seconds", [-0.1, math.nan, 6.0])
def test_foresight_that_is_none_is_refused(seconds):
    graph = graph_of_whole_turns()
    with pytest.raises(InputError, match=r"--foresight: .*expected 0 to 5"):
        Foresight(graph, table(graph), seconds)
