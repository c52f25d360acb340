import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.metric import PointCloudMetric
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import edges_of, standard_graph
from footwork.training.transitions import Minima, local_minima
from motion_samples import sample_clip, sample_clips

BEHAVIOURS = ("stop", "walk", "run", "jump")


@pytest.fixture(scope="module")
def built():
    clips = sample_clips(4, 80)
    metric, nodes = PointCloudMetric.of_clips(clips), nodes_of(clips, BEHAVIOURS)
    minima = local_minima(metric.all_pairs(), nodes.lengths, 1.0)
    return clips, nodes, minima, standard_graph(nodes, metric, minima, sigma=0.5)


def world_places(graph, node, place):
    """Joints of a node put at a planar place x, z, yaw."""
    upright = quaternion.from_yaw(place[2])
    root = quaternion.rotate(upright, graph.root_position[node]) + np.array([place[0], 0.0, place[1]])
    rotations = graph.rotations[node].astype(np.float64)
    rotations[0] = quaternion.multiply(upright, rotations[0])
    return forward(graph.skeleton, root, rotations)[0]


def after(place, displacement):
    dx, dz, dyaw = displacement
    sine, cosine = np.sin(place[2]), np.cos(place[2])
    return np.array([place[0] + dx * cosine + dz * sine, place[1] - dx * sine + dz * cosine, place[2] + dyaw])


def test_edges_are_successors_and_both_sides_of_each_minimum(built):
    _, nodes, minima, graph = built
    found = set(zip(graph.source.tolist(), graph.target.tolist(), strict=True))
    frames = np.arange(graph.node_count)
    expected = {(f, f + 1) for f in frames[frames < nodes.ends].tolist()}
    natural = len(expected)
    for i, j in zip(minima.i.tolist(), minima.j.tolist(), strict=True):
        expected |= {(i, j + 1)} if j < nodes.ends[j] else set()
        expected |= {(j, i + 1)} if i < nodes.ends[i] else set()
    assert found == expected
    assert graph.natural.sum() == natural
    assert len(found) == graph.edge_count
    assert len(minima.i) > 20


def test_costs_belong_to_the_similar_frame_before_the_target(built):
    clips, _, _, graph = built
    metric = PointCloudMetric.of_clips(clips)
    jumps = np.flatnonzero(~graph.natural)
    expected = metric.pair_costs(graph.source[jumps], graph.target[jumps] - 1)
    np.testing.assert_allclose(graph.cost[jumps], expected, atol=1e-5)
    np.testing.assert_allclose(graph.smoothness, np.exp(-graph.cost / 0.5), rtol=1e-5)
    assert (graph.cost[graph.natural] == 0.0).all()
    assert (graph.cost < 1.0).all()


def test_a_natural_edge_comes_first(built):
    *_, graph = built
    starts = graph.edge_start[:-1][np.diff(graph.edge_start) > 0]
    leaves = graph.natural[starts] | ~np.isin(graph.source[starts], graph.source[graph.natural])
    assert leaves.all()


def test_walking_natural_edges_retraces_the_capture(built):
    clips, nodes, _, graph = built
    expected = clip_places(clips[1])[0]
    place = nodes.places[80]
    for frame in range(80):
        node = 80 + frame
        np.testing.assert_allclose(world_places(graph, node, place), expected[frame], atol=1e-4)
        place = after(place, graph.displacement[graph.edge_start[node]].astype(float))


def test_a_transition_between_copies_of_a_motion_is_the_motion():
    clip = sample_clip(5, 60)
    turned = quaternion.from_yaw(2.0)
    rotations = clip.rotations.copy()
    rotations[:, 0] = quaternion.multiply(turned, rotations[:, 0])
    moved = quaternion.rotate(turned, clip.root_position) + np.array([5.0, 0.0, -7.0])
    copy = type(clip)("copy", clip.skeleton, 30.0, moved, rotations, labels=clip.labels)
    metric, nodes = PointCloudMetric.of_clips([clip, copy]), nodes_of([clip, copy], BEHAVIOURS)
    frames = np.arange(10, 50)
    graph = standard_graph(nodes, metric, Minima(frames, frames + 60, np.zeros(40)), 1.0)
    for frame in frames:
        edges = slice(graph.edge_start[frame], graph.edge_start[frame + 1])
        np.testing.assert_array_equal(graph.target[edges], [frame + 1, frame + 61])
        np.testing.assert_allclose(graph.displacement[edges][0], graph.displacement[edges][1], atol=1e-5)


def test_a_transition_goes_on_from_the_aligned_window(built):
    clips, nodes, _, graph = built
    metric = PointCloudMetric.of_clips(clips)
    edge = int(np.flatnonzero(~graph.natural)[7])
    i, j = int(graph.source[edge]), int(graph.target[edge]) - 1
    found = metric.align([i], [j])
    place = after(nodes.places[i], graph.displacement[edge].astype(float))
    capture = np.concatenate([clip_places(clip)[0] for clip in clips])[j + 1]
    aligned = quaternion.rotate(quaternion.from_yaw(found.theta[0]), capture) + np.array(
        [found.x0[0], 0.0, found.z0[0]]
    )
    np.testing.assert_allclose(world_places(graph, j + 1, place), aligned, atol=1e-4)


def test_no_edge_leads_past_the_end_of_a_clip():
    ends = np.array([2, 2, 2, 5, 5, 5])
    edges = edges_of(ends, Minima(np.array([1, 2]), np.array([5, 4]), np.array([0.1, 0.2])))
    pairs = list(zip(edges.source.tolist(), edges.target.tolist(), strict=True))
    assert pairs == [(0, 1), (1, 2), (2, 5), (3, 4), (4, 5), (5, 2)]
