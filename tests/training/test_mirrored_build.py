"""Graphs of clips and their mirror images."""

import numpy as np
import pytest

from footwork.motion.mirror import MIRRORED
from footwork.motion.moves import moves_along
from footwork.runtime.world import World
from footwork.training.build import build_bundle
from footwork.training.graph_options import PAIRINGS, GraphOptions
from motion_samples import SampleMotions, sample_clip, sample_clips, stepping

SAMPLES = SampleMotions(sample_clips(2, 70), [{"file": "sample"}], ["Made up."])


def both(options: GraphOptions, motions: SampleMotions = SAMPLES):
    return build_bundle(motions, options)


@pytest.fixture(scope="module")
def built():
    return both(GraphOptions(mirror=True, threshold=50.0))


def test_every_clip_is_followed_by_its_mirror_image_and_counted_once(built):
    bundle, report = built
    names = tuple(clip.name for clip in SAMPLES.clips)
    assert bundle.graph.clips == (*names, *(name + MIRRORED for name in names))
    assert (report["frames"], report["mirrored_frames"], report["nodes"]) == (140, 140, 280)
    assert report["scc_fraction"] == pytest.approx(report["scc_nodes"] / 280)
    assert bundle.provenance["options"]["mirror"] is True
    assert bundle.provenance["counts"]["frames"] == 280
    assert bundle.provenance["counts"]["mirrored_frames"] == 140
    assert bundle.attribution == ("Made up.",)


def test_the_mirrored_half_holds_the_same_motion_the_other_way_round(built):
    graph = built[0].graph
    half = len(graph.clips) // 2
    number = {
        (int(clip), int(frame)): node for node, (clip, frame) in enumerate(zip(graph.clip, graph.frame, strict=True))
    }
    image = [number.get(((clip + half) % (2 * half), frame), -1) for clip, frame in number]
    edges = {(int(s), int(t)): k for k, (s, t) in enumerate(zip(graph.source, graph.target, strict=True))}
    compared = 0
    for (source, target), edge in edges.items():
        other = edges.get((image[source], image[target]))
        if other is not None:
            x, z, yaw = graph.displacement[edge]
            np.testing.assert_allclose(graph.displacement[other], [-x, z, -yaw], atol=1e-5)
            assert graph.cost[other] == pytest.approx(graph.cost[edge], abs=1e-5)
            compared += 1
    assert compared > 0.9 * len(edges)


def test_a_body_may_go_over_to_its_own_mirror_image():
    """A clip alone, whose mirror image is like it half a swing later, is connected through that."""
    graph = both(GraphOptions(mirror=True, threshold=50.0), SampleMotions([sample_clip(0, 70)]))[0].graph
    assert (graph.clip[graph.source] != graph.clip[graph.target]).any()


@pytest.mark.parametrize("pairing", PAIRINGS)
def test_well_connected_graphs_lie_between_mirrored_clips_too(pairing):
    motions = SampleMotions([stepping(clip, 12) for clip in sample_clips(2, 50)])
    options = GraphOptions("well-connected", 30.0, mirror=True, weights=1, pairing=pairing)
    bundle, report = both(options, motions)
    graph = bundle.graph
    assert (report["frames"], report["mirrored_frames"]) == (100, 100)
    assert report["scc_fraction"] == pytest.approx(graph.original.sum() / 200)
    across = (graph.clip < 2) != (graph.other_clip < 2)
    assert across.any()


def test_without_mirroring_nothing_is_told_of_it():
    bundle, report = both(GraphOptions())
    assert "mirrored_frames" not in report
    assert "mirrored_frames" not in bundle.provenance["counts"]
    assert bundle.provenance["options"]["mirror"] is False


def test_a_mirrored_character_walks(built):
    graph = built[0].graph
    node = int(np.flatnonzero(graph.clip >= 2)[0])
    world = World(graph, 1)
    world.spawn(node, 0.0, 0.0, 0.0)
    world.step(moves_along(graph, graph.edge_start[[node]]))
    assert np.isfinite(world.show(1.0)[1]).all()
