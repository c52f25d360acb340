from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.study.inspection_plots import inspection_plots
from footwork.study.portrait import draw_character
from motion_samples import sample_clip
from toy_bundle import toy_bundle

plt = pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed")


def test_a_bundle_gets_a_sheet_a_clip_its_measures_and_its_values(tmp_path):
    paths = inspection_plots(toy_bundle(), tmp_path / "plots")
    assert [path.name for path in paths] == [
        "wander0.png",
        "wander1.png",
        "wander2.png",
        "transitions.png",
        "ways.png",
        "transition_times.png",
        "values_steering.png",
    ]
    assert all(plt.imread(path)[..., :3].std() > 0.01 for path in paths)


def test_a_graph_of_two_labels_with_frames_between_two_is_shown_on_a_tour(tmp_path):
    bundle = toy_bundle()
    graph = bundle.graph
    label = graph.behaviour > 1
    mixed = replace(graph, label=label, labels=("walk", "jump"), weight=np.where(graph.frame % 5 == 3, 0.5, 1.0))
    paths = inspection_plots(replace(bundle, graph=mixed), tmp_path)
    shown = [path.name for path in paths]
    assert shown[-4:] == ["label_times.png", "maneuverability.png", "tour.png", "values_steering.png"]
    assert all(plt.imread(path)[..., :3].std() > 0.01 for path in paths)


def test_a_portrait_has_the_size_asked_for_and_shows_the_character(tmp_path):
    pixels = plt.imread(draw_character(tmp_path / "one.png", sample_clip(), size=(640, 200)))[..., :3]
    assert pixels.shape == (200, 640, 3)
    orange = pixels[..., 0] - pixels[..., 2] > 0.25
    assert np.ptp(np.flatnonzero(orange.any(axis=0))) > 300


def test_a_portrait_of_frames_that_are_not_there_is_refused(tmp_path):
    with pytest.raises(InputError, match="expected some of 0 to 119"):
        draw_character(tmp_path / "one.png", sample_clip(), frames=[0, 120])
