from dataclasses import replace

import numpy as np
import pytest

from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import BEHAVIOURS
from footwork.training.bridges import NEAR_GROUND, STAY, bridged
from footwork.training.graph_options import GraphOptions
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import moved, relative, standard_graph
from footwork.training.transitions import MIN_GAP, Minima
from toy_graphs import wandering_clip

STOP, WALK, RUN = 0, 1, 2
FRAMES = 40


def clip(seed: int, labels: list[str]):
    return replace(wandering_clip(seed, FRAMES), labels=np.array(labels))


CLIPS = [
    clip(1, ["walk"] * FRAMES),
    clip(2, ["idle"] * 25 + ["walk"] * 15),
    clip(3, ["run"] * (STAY - 1) + ["idle"] * (FRAMES - STAY + 1)),
]
METRIC = PointCloudMetric.of_clips(CLIPS)
NODES = nodes_of(CLIPS, BEHAVIOURS)
NONE = Minima(np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0))
BARE = standard_graph(NODES, METRIC, NONE, 1.0)


def expected(node: int, behaviour: int, ways: int) -> list[float]:
    """Costs by brute force: lowest minima of s along the frames before those that stay in the behaviour."""
    costs, ends, shown = METRIC.pair_costs(node, np.arange(len(NODES.ends))), NODES.ends, BARE.behaviour

    def leads(j: int) -> bool:
        return j >= 0 and j + STAY <= ends[j] and bool((shown[j + 1 : j + 1 + STAY] == behaviour).all())

    found = []
    for j in range(len(ends)):
        near = ends[j] == ends[node] and abs(j - node) < MIN_GAP
        if leads(j) and not near and shown[node] != behaviour:
            beside = [k for k in (j - 1, j + 1) if leads(k) and ends[k] == ends[j]]
            if all(costs[j] < costs[k] for k in beside):
                found.append(j)
    return sorted(costs[found])[:ways]


@pytest.mark.parametrize("ways", [1, 3])
def test_bridges_lead_to_the_least_unlike_frames_of_the_other_behaviours(ways):
    graph = bridged(BARE, ways, 1.0)
    for node in range(graph.node_count):
        edges = np.arange(graph.edge_start[node], graph.edge_start[node + 1])
        targets = graph.target[edges[~graph.natural[edges]]]
        for behaviour in (STOP, WALK, RUN):
            found = METRIC.pair_costs(node, targets[graph.behaviour[targets] == behaviour] - 1)
            np.testing.assert_allclose(np.sort(found), expected(node, behaviour, ways), rtol=1e-4)


def test_a_bridge_costs_and_leads_as_a_transition_between_those_frames_does():
    graph = bridged(BARE, 2, 0.7)
    bridges = np.flatnonzero(~graph.natural)
    source, similar = graph.source[bridges], graph.target[bridges] - 1
    cost = METRIC.pair_costs(source, similar)
    np.testing.assert_allclose(graph.cost[bridges], cost, rtol=1e-5)
    np.testing.assert_allclose(graph.smoothness[bridges], np.exp(-cost / 0.7), atol=1e-6)
    there = moved(NODES.places[similar + 1], METRIC.align(source, similar))
    np.testing.assert_allclose(graph.displacement[bridges], relative(NODES.places[source], there), atol=1e-5)


def test_no_behaviour_is_offered_that_is_over_at_once():
    graph = bridged(BARE, 4, 1.0)
    assert (BARE.behaviour == RUN).any()
    assert not (graph.behaviour[graph.target[~graph.natural]] == RUN).any()


def test_edges_that_are_there_already_stay_as_they_are():
    once = bridged(BARE, 2, 1.0)
    twice = bridged(once, 2, 1.0)
    assert twice.edge_count == once.edge_count
    for name in ("edge_start", "target", "cost", "displacement", "natural"):
        np.testing.assert_array_equal(getattr(once, name), getattr(twice, name))
    assert once.natural[once.edge_start[0]]


@pytest.mark.parametrize("bridges", [-1, 65])
def test_a_number_of_bridges_out_of_range_is_refused(bridges):
    with pytest.raises(Exception, match=r"--bridges: .* expected 0 to 64"):
        GraphOptions(bridges=bridges)


def jumping(aloft: slice):
    """A clip that jumps all along, with both feet off the ground in some frames."""
    bare, contacts = wandering_clip(5, FRAMES), np.ones((FRAMES, 2), bool)
    contacts[aloft] = False
    return replace(bare, labels=np.array(["jump"] * FRAMES), contacts=contacts)


def test_a_jump_is_entered_shortly_before_it_takes_off_and_left_when_it_is_about_to_land():
    clips = [replace(CLIPS[0], contacts=np.ones((FRAMES, 2), bool)), jumping(slice(20, 30))]
    nodes = nodes_of(clips, BEHAVIOURS)
    graph = bridged(standard_graph(nodes, PointCloudMetric.of_clips(clips), NONE, 1.0), 8, 1.0)
    source, target = graph.source[~graph.natural], graph.target[~graph.natural]
    frame = graph.frame[target[source < FRAMES]]
    assert frame.size
    assert ((frame >= 20 - NEAR_GROUND) & (frame < 20)).all()
    left = graph.frame[source[source >= FRAMES]]
    assert set(range(20)) | set(range(30 - NEAR_GROUND, FRAMES)) == set(left.tolist())
