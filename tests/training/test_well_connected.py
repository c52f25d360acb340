"""The well-connected motion graph: what is put together of chains, and what a build of it reports."""

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.graph import ARRAYS
from footwork.motion.kinematics import forward
from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import SteeringTask
from footwork.training.build import build_bundle
from footwork.training.chain_edges import edges_of_chains
from footwork.training.chain_graph import graph_of_chains
from footwork.training.chains import chains_of_clips
from footwork.training.connectivity import largest_component
from footwork.training.dataset import load_clips
from footwork.training.graph_options import GraphOptions
from footwork.training.interpolation import interpolated
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transition_search import search
from footwork.training.transitions import local_minima
from motion_samples import SampleMotions, sample_clip, stepping
from shared_data import MOTIONS, needs_motions
from toy_graphs import wandering_clip

TASK = SteeringTask()
THRESHOLD = 1.0


@pytest.fixture(scope="module")
def mixed():
    clips = [stepping(sample_clip(seed, 50), 12) for seed in range(3)]
    chains, _ = interpolated(clips, TASK.behaviours, 2)
    edges = edges_of_chains(chains, search(chains, THRESHOLD), THRESHOLD)
    graph = graph_of_chains(clips, chains, np.arange(chains.node_count), edges, 1.0)
    return clips, chains, edges, graph


def test_without_interpolation_it_is_the_standard_graph():
    clips, threshold = [wandering_clip(seed, 60) for seed in range(3)], 60.0
    chains = chains_of_clips(clips, TASK.behaviours)
    edges = edges_of_chains(chains, search(chains, threshold), threshold)
    graph = graph_of_chains(clips, chains, np.arange(chains.node_count), edges, 1.0)
    metric, nodes = PointCloudMetric.of_clips(clips), nodes_of(clips, TASK.behaviours)
    minima = local_minima(metric.all_pairs(), nodes.lengths, threshold)
    standard = standard_graph(nodes, metric, minima, 1.0)
    assert not standard.natural.all()
    for name in ARRAYS:
        np.testing.assert_allclose(getattr(graph, name), getattr(standard, name), atol=2e-6, err_msg=name)


def test_poses_stand_where_their_chains_have_them(mixed):
    _, chains, _, graph = mixed
    natural = np.flatnonzero(graph.natural & ~graph.original[graph.source])
    source, step = graph.source[natural], graph.displacement[natural].astype(float)
    before = forward(graph.skeleton, graph.root_position[source], graph.rotations[source])[0]
    after = forward(graph.skeleton, graph.root_position[graph.target[natural]], graph.rotations[graph.target[natural]])[
        0
    ]
    after = quaternion.rotate(quaternion.from_yaw(step[:, None, 2]), after)
    after[..., [0, 2]] += step[:, None, :2]
    true_before, true_after = (chains.places[chains.row_of_node[nodes]] for nodes in (source, graph.target[natural]))
    np.testing.assert_allclose(
        np.linalg.norm(after - before, axis=-1), np.linalg.norm(true_after - true_before, axis=-1), atol=2e-6
    )


def test_the_first_frame_of_a_chain_has_the_velocity_of_its_context(mixed):
    _, chains, _, graph = mixed
    starts = chains.first_node[chains.context > 0]
    rows = chains.row_of_node[starts]
    moved = 30.0 * np.linalg.norm(chains.places[rows, 0] - chains.places[rows - 1, 0], axis=-1)
    np.testing.assert_allclose(np.linalg.norm(graph.root_velocity[starts], axis=-1), moved, atol=1e-4)


def test_transitions_lay_the_frame_after_the_like_one_down(mixed):
    """Where source and the row before the target are alike, so are where they lead to."""
    _, chains, edges, graph = mixed
    jumps = np.flatnonzero(~graph.natural & (edges.cost < 0.2))
    assert jumps.size
    source, step = graph.source[jumps], graph.displacement[jumps]
    rows = chains.row_of_node[graph.target[jumps]]
    travelled = np.linalg.norm((chains.places[rows, 0] - chains.places[rows - 1, 0])[:, [0, 2]], axis=-1)
    # the roots of two windows an s of 0.2 apart are some centimetres apart at most
    assert np.abs(np.linalg.norm(step[:, :2], axis=-1) - travelled).max() < 0.12
    assert (source != graph.target[jumps]).all()


def test_a_build_reports_the_sizes_before_and_after():
    motions = SampleMotions([stepping(sample_clip(seed, 50), 12) for seed in range(3)])
    options = GraphOptions(graph="well-connected", threshold=THRESHOLD, weights=2)
    bundle, report = build_bundle(motions, options)
    again, _ = build_bundle(motions, options)
    assert again.digest == bundle.digest
    assert list(report["seconds"]) == ["read", "interpolation", "transitions", "reduction", "graph", "policy", "total"]
    assert report["frames"] == 150
    assert 150 <= report["nodes"] <= report["before_reduction"]["nodes"]
    assert report["edges"] <= report["before_reduction"]["edges"]
    graph = bundle.graph
    assert report["scc_fraction"] == pytest.approx(graph.original.sum() / 150)
    assert largest_component(graph.node_count, graph.source, graph.target).size == graph.node_count
    assert bundle.provenance["options"]["weights"] == 2
    standard = build_bundle(motions, GraphOptions(threshold=THRESHOLD))[1]
    assert report["scc_fraction"] >= standard["scc_fraction"]


@needs_motions
def test_real_steps_of_different_lengths_are_connected():
    motions = load_clips(MOTIONS / "dataset1", labels=MOTIONS / "labels.csv", ranges=MOTIONS / "core_ranges.csv")
    well = build_bundle(motions, GraphOptions(graph="well-connected", threshold=0.4))[1]
    standard = build_bundle(motions, GraphOptions(threshold=0.4))[1]
    assert well["scc_fraction"] > 1.5 * standard["scc_fraction"]
