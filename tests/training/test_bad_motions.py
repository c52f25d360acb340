"""Motions and options that no graph should be made of, or only a small one: one error that says what, or a result."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.clip import Clip
from footwork.training import room
from footwork.training.build import build_bundle
from footwork.training.connectivity import largest_component
from footwork.training.graph_options import GraphOptions
from motion_samples import SampleMotions, sample_clip, sample_clips


def built(clips: list[Clip], **options: Any) -> tuple[Bundle, dict[str, Any]]:
    chosen: dict[str, Any] = {"graph": "well-connected", "weights": 1} | options
    return build_bundle(SampleMotions(clips), GraphOptions(**chosen))


def standing(clip: Clip, stands: bool) -> Clip:
    return replace(clip, contacts=np.full((clip.frame_count, 2), stands))


@pytest.mark.parametrize("stands", [False, True])
def test_clips_whose_feet_never_or_always_stand_make_a_graph(stands):
    bundle, report = built([standing(clip, stands) for clip in sample_clips(2, 60)])
    graph = bundle.graph
    assert largest_component(graph.node_count, graph.source, graph.target).size == graph.node_count
    assert 0.0 < report["scc_fraction"] <= 1.0


def test_one_clip_makes_a_graph():
    bundle, report = built([sample_clip(0, 100)])
    assert report["frames"] == 100
    assert set(bundle.graph.clip.tolist()) == {0}


def test_the_same_clip_twice_makes_a_graph():
    assert built([sample_clip(0, 50), replace(sample_clip(0, 50), name="again")])[1]["scc_fraction"] > 0.5


def test_clips_far_from_the_origin_make_the_same_graph_as_near_it():
    near = built(sample_clips(2, 60))[1]
    there = np.array([1e5, 0.0, 0.0])
    far = built([replace(clip, root_position=clip.root_position + there) for clip in sample_clips(2, 60)])[1]
    assert (far["nodes"], far["edges"]) == (near["nodes"], near["edges"])


def test_no_clips_short_clips_and_other_bodies_are_refused():
    with pytest.raises(InputError, match="motions: no clips, expected at least one"):
        built([])
    with pytest.raises(InputError, match="sample0: 10 frames at 30 Hz, expected at least the 11"):
        built([sample_clip(0, 10), sample_clip(1, 60)])
    clip, other = sample_clips(2, 60)
    taller = replace(other.skeleton, offsets=other.skeleton.offsets * 1.1)
    with pytest.raises(InputError, match="sample1: another body than that of sample0, expected the common body"):
        built([clip, replace(other, skeleton=taller)])
    with pytest.raises(InputError, match="sample0: 60 frames a second, expected 30"):
        built([replace(clip, fps=60.0)])


def test_motion_that_never_meets_itself_is_refused():
    with pytest.raises(InputError, match=r"threshold: .*walked without end"):
        built([sample_clip(0, 14)])


def test_a_huge_threshold_makes_a_transition_of_every_local_minimum():
    usual, huge = (built(sample_clips(2, 60), threshold=threshold)[1] for threshold in (0.5, 1e300))
    assert huge["before_reduction"]["nodes"] == usual["before_reduction"]["nodes"]
    assert huge["before_reduction"]["edges"] > 1.5 * usual["before_reduction"]["edges"]


def test_a_tiny_threshold_is_refused_or_finds_the_poses_that_are_the_same():
    twins = [sample_clip(0, 60), replace(sample_clip(0, 60), name="again")]
    assert built(twins, threshold=1e-9)[1]["scc_fraction"] > 0.0
    with pytest.raises(InputError, match=r"threshold: .*walked without end"):
        built([sample_clip(0, 25)], threshold=1e-9)


@pytest.mark.parametrize("mu", [1.0, 1e9])
def test_mu_at_the_ends_of_what_is_allowed_makes_a_graph(mu):
    assert built(sample_clips(2, 60), mu=mu)[1]["scc_fraction"] > 0.5


def test_rows_that_memory_has_no_room_for_are_refused_with_the_figures(monkeypatch):
    monkeypatch.setattr(room, "available_bytes", lambda: 1_000_000)
    with pytest.raises(InputError, match=r"motions: \d+ .* need about 0\.\d GB of memory where 0\.0 GB are left"):
        built(sample_clips(2, 60), weights=50)
