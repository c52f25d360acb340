import json
from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.bundle import read_bundle, write_bundle
from footwork.motion.task import SteeringTask
from footwork.training.build import build_bundle
from footwork.training.connectivity import largest_component
from footwork.training.graph_options import GraphOptions
from made_traces import trace
from motion_samples import SampleMotions, sample_clip, sample_clips

SAMPLES = SampleMotions(sample_clips(4, 80), [{"file": "sample", "sha256": "1" * 64}], ["Made up."])


@pytest.fixture(scope="module")
def built():
    return build_bundle(SAMPLES, GraphOptions(threshold=1.0))


def test_the_graph_can_be_walked_without_end(built):
    graph = built[0].graph
    assert largest_component(graph.node_count, graph.source, graph.target).size == graph.node_count


def test_the_report_has_the_fields_that_tools_read(built):
    bundle, report = built
    assert list(report) == [
        "frames",
        "nodes",
        "edges",
        "scc_nodes",
        "scc_fraction",
        "threshold",
        "seconds",
        "peak_rss_mb",
        "policy",
        "missing_behaviours",
        "digest",
    ]
    assert list(report["seconds"]) == ["read", "metric", "graph", "policy", "total"]
    assert list(report["policy"]) == ["states", "sweeps", "residual", "converged"]
    assert report["frames"] == report["nodes"] == 320
    assert report["scc_nodes"] == bundle.graph.node_count
    assert report["scc_fraction"] == pytest.approx(report["scc_nodes"] / 320)
    assert report["policy"]["states"] == report["scc_nodes"] * 4 * 36
    assert report["policy"]["converged"] is True
    assert report["peak_rss_mb"] > 10
    json.dumps(report, allow_nan=False)


def test_the_bundle_written_has_the_digest_reported(built, tmp_path):
    bundle, report = built
    assert write_bundle(tmp_path / "b.footwork", bundle) == report["digest"] == bundle.digest
    read = read_bundle(tmp_path / "b.footwork")
    assert read.attribution == ("Made up.",)
    assert read.provenance["options"]["threshold"] == 1.0
    assert read.provenance["files"][0]["file"] == "sample"
    assert read.provenance["counts"]["scc_nodes"] == read.graph.node_count


def test_the_same_clips_give_the_same_bundle(built):
    again, _ = build_bundle(SAMPLES, GraphOptions(threshold=1.0))
    assert again.digest == built[0].digest


def test_progress_goes_through_the_stages():
    told: list[tuple[str, float]] = []
    build_bundle(
        SampleMotions(sample_clips(2, 80)),
        GraphOptions(threshold=1.0),
        progress=lambda stage, share: told.append((stage, share)),
    )
    stages = list(dict.fromkeys(stage for stage, _ in told))
    assert stages == ["metric", "graph", "policy"]
    assert all(0.0 <= share <= 1.0 for _, share in told)
    assert told[-1] == ("policy", 1.0)


@pytest.mark.parametrize("threshold", [0.0, -1.0, float("nan"), float("inf"), 1e999])
def test_a_threshold_that_is_no_positive_number_is_refused(threshold):
    with pytest.raises(InputError, match="expected a positive number"):
        build_bundle(SampleMotions(sample_clips(1, 40)), GraphOptions(threshold=threshold))


def test_clips_that_are_missing_or_too_short_are_refused():
    with pytest.raises(InputError, match="no clips"):
        build_bundle(SampleMotions([]), GraphOptions(threshold=1.0))
    short = replace(sample_clip(0, 40).cut(0, 10), name="short.bvh")
    with pytest.raises(InputError, match=r"short.bvh: 10 frames at 30 Hz, expected at least the 11"):
        build_bundle(SampleMotions([sample_clip(0, 40), short]), GraphOptions(threshold=1.0))


def test_more_frames_than_memory_has_room_for_are_refused():
    long = sample_clip(0, 10_000)
    with pytest.raises(InputError, match=r"motions: 100000000 frames at 30 Hz, expected \d+ at most"):
        build_bundle(SampleMotions([long] * 10_000), GraphOptions(threshold=1.0))


def test_behaviours_that_no_frame_shows_are_named(built):
    assert built[1]["missing_behaviours"] == []
    _, report = build_bundle(
        SampleMotions([sample_clip(seed, 80, "idle") for seed in range(2)]), GraphOptions(threshold=1.0)
    )
    assert report["missing_behaviours"] == ["walk", "run", "jump"]


def test_a_threshold_that_connects_nothing_names_one_that_does():
    # one straight walk that swings faster and faster is never quite the same again
    clips = [sample_clip(seed, 80, turn=0.0) for seed in range(3)]
    with pytest.raises(
        InputError, match=r"no transitions at threshold 1e-05.*threshold of [\d.]+ would connect half"
    ) as caught:
        build_bundle(SampleMotions([clip.cut(0, 28) for clip in clips]), GraphOptions(threshold=1e-5))
    needed = float(str(caught.value).split("threshold of ")[1].split()[0])
    _, report = build_bundle(SampleMotions([clip.cut(0, 28) for clip in clips]), GraphOptions(threshold=needed))
    assert report["scc_fraction"] >= 0.5


def test_clips_that_never_meet_say_so():
    with pytest.raises(InputError, match="nor at any other threshold"):
        build_bundle(SampleMotions([sample_clip(0, 14)]), GraphOptions(threshold=1.0))


def test_a_policy_that_does_not_converge_is_refused():
    with pytest.raises(InputError, match="not converged: residual"):
        build_bundle(
            SampleMotions(sample_clips(2, 60)),
            GraphOptions(threshold=1.0),
            task=SteeringTask(discount=0.999999, heading_bins=8),
        )


def test_a_bundle_knows_the_players_that_its_policy_learned_from(built, tmp_path):
    players = [replace(trace(f"{turn}.csv", turn=turn), digest=f"{turn:064}") for turn in (0.0, 0.1)]
    bundle, _ = build_bundle(SAMPLES, GraphOptions(threshold=1.0), players=players)
    write_bundle(tmp_path / "b.footwork", bundle)
    player = read_bundle(tmp_path / "b.footwork").table("steering").player
    assert player is not None
    assert [(file.name, file.digest) for file in player.learned_from] == [(one.name, one.digest) for one in players]
    assert built[0].table("steering").player is None
    assert (bundle.table("steering").values != built[0].table("steering").values).any()


def test_motion_without_a_behaviour_that_can_be_asked_for_gets_a_graph_and_no_policy():
    clips = [replace(clip, labels=np.full(clip.frame_count, "attack")) for clip in sample_clips(2, 80)]
    bundle, report = build_bundle(SampleMotions(clips), GraphOptions(threshold=1.0))
    assert (dict(bundle.tables), report["policy"]) == ({}, None)
    assert report["missing_behaviours"] == list(SteeringTask().behaviours)
    with pytest.raises(InputError, match="no table 'steering'"):
        bundle.table("steering")
