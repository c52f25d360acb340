"""Edges over chains: along them, between like frames, and from one interpolated segment to the next."""

import numpy as np
import pytest

from footwork.motion.task import BEHAVIOURS
from footwork.training.chain_edges import ChainEdges, edges_of_chains
from footwork.training.chains import NO_CHAIN, Chains
from footwork.training.interpolation import interpolated
from footwork.training.row_metric import uniform_rows
from footwork.training.transitions import Minima
from motion_samples import sample_clip

NONE = Minima(np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0))
FAR = 1e9


@pytest.fixture(scope="module")
def chains() -> Chains:
    left = np.arange(48) // 12 % 2 == 0
    clips = [sample_clip(seed, 48) for seed in range(2)]
    for clip in clips:
        object.__setattr__(clip, "contacts", np.stack([left, ~left], axis=1))
    return interpolated(clips, BEHAVIOURS, 2)[0]


def joins(chains: Chains, edges: ChainEdges) -> np.ndarray:
    return np.flatnonzero(~edges.natural & np.isin(edges.source, chains.last_node))


def test_natural_edges_follow_every_chain_and_cost_nothing(chains):
    edges = edges_of_chains(chains, NONE, 1e-12)
    assert edges.natural.all()
    assert len(edges.source) == chains.node_count - chains.chain_count
    np.testing.assert_array_equal(edges.target, edges.source + 1)
    assert not edges.cost.any()
    assert not np.isin(edges.source, chains.last_node).any()


def test_joins_lead_from_a_segment_to_the_next_ones_of_both_sources(chains):
    edges = edges_of_chains(chains, NONE, FAR)
    found = joins(chains, edges)
    before = np.flatnonzero(chains.followers != NO_CHAIN)
    assert len(before) > 0
    np.testing.assert_array_equal(np.sort(edges.source[found]), np.sort(chains.last_node[before]))
    follower = chains.followers[chains.chain_of_node[edges.source[found]]]
    np.testing.assert_array_equal(edges.target[found], chains.first_node[follower])
    rows = chains.row_of_node[edges.source[found]], chains.row_of_node[edges.target[found]] - 1
    np.testing.assert_allclose(edges.cost[found], uniform_rows(chains).costs(*rows), atol=1e-12)


def test_joins_over_the_threshold_are_left_out(chains):
    costs = np.sort(edges_of_chains(chains, NONE, FAR).cost)
    threshold = float(costs[-1])
    kept = edges_of_chains(chains, NONE, threshold)
    assert len(kept.source) == len(costs) - np.sum(costs == threshold)


def test_a_minimum_leads_both_ways_to_the_frame_after_the_like_one(chains):
    i, j = 3, chains.last_node[1]
    edges = edges_of_chains(chains, Minima(np.array([i]), np.array([j]), np.array([0.1])), 1e-12)
    jumps = np.flatnonzero(~edges.natural)
    # the last frame of a clip has no frame after it, so nothing leads there
    assert edges.source[jumps].tolist() == [j]
    assert edges.target[jumps].tolist() == [i + 1]
    assert edges.cost[jumps].tolist() == [0.1]


def test_edges_are_sorted_by_source_the_natural_one_first(chains):
    random = np.random.default_rng(0)
    i, j = random.integers(0, 40, 30), random.integers(50, chains.node_count, 30)
    edges = edges_of_chains(chains, Minima(i, j, random.random(30)), FAR)
    keys = list(zip(edges.source, ~edges.natural, edges.target, strict=True))
    assert keys == sorted(keys)
