import numpy as np
import pytest

from footwork.study.measures import joined, quality
from footwork.study.motion_matching.controller import MotionMatchingController
from footwork.study.motion_matching.forms import FORMS, motion_matching
from footwork.study.motion_matching.options import STRONG
from footwork.study.motion_matching.tuning import split, total, tune, varied
from footwork.study.replay import Stage, replay
from footwork.training.embedded import embedded_clips
from made_traces import trace

TRACES = [trace("c.csv", 70, turn=0.05), trace("a.csv", 130, turn=-0.02, attack=1), trace("b.csv", 40, forward=0)]
CLIPS = [clip for clip in embedded_clips() if clip.frame_count < 150]


def test_every_second_trace_by_name_trains():
    training, testing = split(TRACES)
    assert [one.name for one in training] == ["a.csv", "c.csv"]
    assert [one.name for one in testing] == ["b.csv"]


@pytest.mark.parametrize("form", FORMS)
def test_what_is_tuned_is_the_total_of_the_score(form):
    controller = motion_matching(CLIPS, form)
    replays = [replay(one, controller, Stage(controller.graph)) for one in TRACES]
    scored = quality(joined([one.followed for one in replays]))["total"]
    assert total(controller, TRACES) == pytest.approx(scored, abs=1e-9)


def test_a_step_changes_a_few_numbers_and_keeps_counts_whole():
    random = np.random.default_rng(0)
    for _ in range(50):
        options = varied(STRONG, random)
        assert options != STRONG
        assert isinstance(options.search_ticks, int)
        assert min(options.search_ticks, options.skipped_end, options.skipped_around) >= 1
        assert options.turning.most == STRONG.turning.most


def test_tuning_never_ends_lower_than_it_began_and_repeats():
    graph = motion_matching(CLIPS, "strong").graph
    before = total(MotionMatchingController(graph, STRONG), TRACES)
    options, value = tune(graph, TRACES, trials=2)
    assert value >= before
    assert total(MotionMatchingController(graph, options), TRACES) == value
    assert tune(graph, TRACES, trials=2) == (options, value)
