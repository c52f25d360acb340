import json
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from footwork.cli.main import main
from footwork.errors import InputError
from footwork.motion.bundle import write_bundle
from footwork.study.inspection_plots import inspection_plots
from footwork.study.portrait import draw_character
from motion_samples import sample_clip
from toy_bundle import toy_bundle

plt = pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed")


def shows_something(path: Path) -> bool:
    if path.suffix == ".png":
        return plt.imread(path)[..., :3].std() > 0.01
    picture = ElementTree.parse(path).getroot()
    return len(list(picture.iter())) > 50


def test_a_bundle_gets_a_sheet_a_clip_its_measures_and_its_values_and_a_page_of_them(tmp_path, capsys):
    write_bundle(tmp_path / "toy.footwork", toy_bundle())
    assert main(["inspect", str(tmp_path / "toy.footwork"), "--plots", str(tmp_path / "plots"), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    page, paths = Path(report["page"]).read_text(), [Path(path) for path in report["plots"]]
    assert all(f'src="{path.name}"' in page for path in paths)
    assert [path.name for path in paths] == [
        "wander0.png",
        "wander1.png",
        "wander2.png",
        "transitions.svg",
        "ways.svg",
        "transition_times.svg",
        "values_steering.svg",
    ]
    assert all(shows_something(path) for path in paths)


def test_a_graph_of_two_labels_with_frames_between_two_is_shown_on_a_tour(tmp_path):
    bundle = toy_bundle()
    graph = bundle.graph
    label = graph.behaviour > 1
    mixed = replace(graph, label=label, labels=("walk", "jump"), weight=np.where(graph.frame % 5 == 3, 0.5, 1.0))
    paths = inspection_plots(replace(bundle, graph=mixed), tmp_path)
    shown = [path.name for path in paths]
    assert shown[-4:] == ["label_times.svg", "maneuverability.svg", "tour.png", "values_steering.svg"]
    assert all(shows_something(path) for path in paths)


def test_a_portrait_has_the_size_asked_for_and_shows_the_character(tmp_path):
    pixels = plt.imread(draw_character(tmp_path / "one.png", sample_clip(), size=(640, 200)))[..., :3]
    assert pixels.shape == (200, 640, 3)
    orange = pixels[..., 0] - pixels[..., 2] > 0.25
    assert np.ptp(np.flatnonzero(orange.any(axis=0))) > 300


def test_a_portrait_of_frames_that_are_not_there_is_refused(tmp_path):
    with pytest.raises(InputError, match="expected some of 0 to 119"):
        draw_character(tmp_path / "one.png", sample_clip(), frames=[0, 120])
