"""Motions looked at through a metric."""

import json

import pytest

from footwork.errors import InputError
from footwork.motion.metrics import NAMES, metric_of
from footwork.study.metric_report import knee_plot, metric_report
from footwork.training.knee import threshold_at_knee
from footwork.training.transitions import local_minima
from toy_graphs import wandering_clip

CLIPS = [wandering_clip(seed, 120) for seed in range(3)]


@pytest.mark.parametrize("name", NAMES)
def test_the_report_has_the_knee_that_a_build_takes(name):
    report, knee = metric_report(CLIPS, name)
    lengths = [120] * 3
    taken = threshold_at_knee(local_minima(metric_of(name, CLIPS).all_pairs(), lengths), lengths)
    assert report["threshold_at_knee"] == knee.threshold == taken.threshold
    assert report["cost_of_share_of_pairs"]["0.5"] == report["median_cost"]
    json.dumps(report, allow_nan=False)


def test_the_curve_is_drawn(tmp_path):
    _, knee = metric_report(CLIPS, "uniform")
    assert knee_plot(knee, "uniform", tmp_path / "knee.svg").read_text().startswith("<svg")


def test_an_unknown_metric_is_refused():
    with pytest.raises(InputError, match="no metric 'taxicab'"):
        metric_report(CLIPS, "taxicab")
