"""Blends and the foot skate in them, on made motion whose feet slide by known amounts."""

from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.alignment import Alignment
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.kinematics import forward
from footwork.motion.metrics import metric_of
from footwork.motion.window import LENGTH
from footwork.study.blends import AROUND, BLEND, MARGIN, RUN, blended, fading, inside, laid, runs_of
from footwork.study.skating import skating_steps, weighted_speeds
from footwork.study.slide_figures import figures_of, gains
from footwork.study.transition_slide import foot_slide, slide_of_picks, slide_of_transitions
from footwork.training.transitions import Minima
from motion_samples import sample_clips

FRAMES = 40
STILL = Alignment(*(np.zeros(1) for _ in range(4)))


def standing_at(x: float, speed: float = 0.0, contacts=(True, True)) -> Clip:
    """A still body that glides along z, both feet said to be in contact or not."""
    body = default_body()
    place = np.tile([x, 0.94, 0.0], (FRAMES, 1))
    place[:, 2] = speed * np.arange(FRAMES) / 30.0
    rotations = np.tile(quaternion.IDENTITY, (FRAMES, body.joint_count, 1))
    return Clip(f"at {x}", body, 30.0, place, rotations, np.tile(contacts, (FRAMES, 1)))


def slide(first: Clip, second: Clip):
    return slide_of_transitions([first, second], [20], [FRAMES + 20], STILL)


def test_a_blend_fades_from_one_to_nought_in_a_third_of_a_second():
    share = fading()
    assert share[BLEND][0] == 1.0
    assert share[BLEND][-1] == 0.0
    assert LENGTH - 1 == 10  # a third of a second
    assert share[AROUND + (LENGTH - 1) // 2] == pytest.approx(0.5)
    assert (np.diff(share) <= 0).all()


def test_the_ends_of_a_blend_are_the_motions_themselves():
    clips = sample_clips(2)
    alignment = metric_of("uniform", clips).align([30, 50], [170, 190])
    before, after = runs_of(clips, [30, 50]), laid(runs_of(clips, [170, 190]), alignment)
    blend = blended(before, after)
    body = clips[0].skeleton
    places = [forward(body, runs.root_position, runs.rotations)[0] for runs in (blend, before, after)]
    first, last = slice(0, AROUND + 1), slice(BLEND.stop - 1, RUN)
    np.testing.assert_allclose(places[0][:, first], places[1][:, first], atol=1e-12)
    np.testing.assert_allclose(places[0][:, last], places[2][:, last], atol=1e-12)


def test_both_transitions_of_a_pick_are_laid_by_the_metric():
    clips = sample_clips(2)
    metric = metric_of("uniform", clips)
    both = slide_of_picks(clips, Minima(np.array([30]), np.array([170]), np.zeros(1)), metric)
    for at, (source, target) in enumerate([(30, 170), (170, 30)]):
        one = slide_of_transitions(clips, [source], [target], metric.align([source], [target]))
        np.testing.assert_allclose(both.weighted[at], one.weighted[0])


def test_turning_a_run_turns_all_of_its_body():
    clips = sample_clips(1)
    runs = runs_of(clips, [40])
    turned = laid(runs, Alignment(np.array([0.7]), np.array([1.0]), np.array([-2.0]), np.zeros(1)))
    here = forward(clips[0].skeleton, runs.root_position, runs.rotations)[0]
    there = forward(clips[0].skeleton, turned.root_position, turned.rotations)[0]
    expected = np.array([1.0, 0.0, -2.0]) + quaternion.rotate(quaternion.from_yaw(np.array(0.7)), here)
    np.testing.assert_allclose(there, expected, atol=1e-12)


def test_frames_without_room_for_a_blend_are_refused():
    clips = sample_clips(2, frames=40)
    with pytest.raises(InputError, match=f"nearer than {MARGIN} frames"):
        runs_of(clips, [MARGIN, 39])
    assert inside([40, 40], [MARGIN - 1, MARGIN, 39 - MARGIN, 40 - MARGIN, 40 + MARGIN]).tolist() == [
        False,
        True,
        True,
        False,
        True,
    ]


def test_a_foot_moved_by_eight_centimetres_slides_by_eight_both_ways():
    found = slide(standing_at(0.0), standing_at(0.08)).either
    np.testing.assert_allclose(found.straight, 8.0, atol=1e-9)
    np.testing.assert_allclose(found.arc, 8.0, atol=1e-9)
    np.testing.assert_allclose(found.seconds, 1 / 3)


def test_a_planted_foot_does_not_slide():
    found = slide(standing_at(0.3), standing_at(0.3))
    np.testing.assert_allclose(found.either.arc, 0.0, atol=1e-9)
    assert found.skating[0] == found.weighted[0] == 0.0


def test_what_the_sources_slide_is_told_beside():
    found = slide(standing_at(0.0, 0.3), standing_at(0.0, 0.3))
    np.testing.assert_allclose(found.either.arc, 10.0, atol=1e-9)
    np.testing.assert_allclose(found.own("arc"), 10.0, atol=1e-9)
    halves = slide(standing_at(0.0, 0.3), standing_at(0.0))
    np.testing.assert_allclose(halves.own("arc"), 5.0, atol=1e-9)
    one_stands = slide(standing_at(0.0, 0.3), standing_at(0.0, 0.0, (False, False)))
    np.testing.assert_allclose(one_stands.own("arc"), 10.0, atol=1e-9)


def test_feet_in_the_air_in_both_count_nowhere_and_in_one_only_under_either():
    none = slide(standing_at(0.0, contacts=(False, False)), standing_at(0.1, contacts=(False, False)))
    assert not none.either.stands.any()
    left = slide(standing_at(0.0, contacts=(True, False)), standing_at(0.1, contacts=(False, False)))
    assert left.either.stands.tolist() == [[True, False]]
    assert not left.both.stands.any()


def test_arcs_are_as_long_as_the_line_at_least_and_agree_with_a_plain_sum():
    rng = np.random.default_rng(0)
    balls, standing = rng.normal(size=(6, 11, 2, 3)), rng.random((6, 11, 2)) < 0.7
    found = foot_slide(balls, standing)
    assert (found.arc >= found.straight - 1e-9).all()
    for run, foot in np.ndindex(6, 2):
        held = standing[run, :, foot]
        ground = 100 * balls[run][:, foot][:, [0, 2]]
        edges = np.flatnonzero(np.diff(held, prepend=False, append=False)).reshape(-1, 2)
        ways = [ground[start:end] for start, end in edges]
        arc = sum(np.linalg.norm(way[k + 1] - way[k]) for way in ways for k in range(len(way) - 1))
        assert found.arc[run, foot] == pytest.approx(arc)
        assert found.straight[run, foot] == pytest.approx(sum(np.linalg.norm(way[-1] - way[0]) for way in ways))


def test_the_skating_ratio_counts_low_fast_steps_alone():
    balls = np.zeros((30, 1, 3))
    balls[:, 0, 2] = np.arange(30) * 0.6 / 30.0
    assert skating_steps(balls, 0.0).all()
    assert not skating_steps(balls * 0.8, 0.0).any()
    balls[10:, 0, 1] = 0.06
    assert skating_steps(balls, 0.0)[:, 0].tolist() == [True] * 9 + [False] * 20


@pytest.mark.parametrize(("height", "share"), [(0.0, 1.0), (0.0125, 2 - 2**0.5), (0.025, 0.0), (0.5, 0.0), (-0.1, 1.0)])
def test_the_weighted_speed_falls_with_height_as_zhang_and_others_have_it(height, share):
    balls = np.zeros((5, 2, 3))
    balls[..., 0] = np.arange(5)[:, None] * 0.5 / 30.0
    balls[..., 1] = 0.02 + height
    np.testing.assert_allclose(weighted_speeds(balls, 0.02), 0.5 * share, atol=1e-12)


def test_figures_of_equal_transitions_are_sure_and_gains_are_shares():
    clips = [standing_at(0.0), standing_at(0.08)]

    source, target = np.array([18, 20]), FRAMES + np.array([18, 20])
    unmoved = Alignment(*(np.zeros(4) for _ in range(4)))
    slide = slide_of_transitions(clips, np.append(source, target), np.append(target, source), unmoved)
    blend, own = figures_of(slide)["arc length"]
    assert blend == pytest.approx((8.0, 8.0, 8.0))
    assert own == pytest.approx((0.0, 0.0, 0.0))
    half = replace(slide, either=replace(slide.either, arc=slide.either.arc / 2))
    assert gains(half, slide, np.array([0, 1]))["arc length"] == pytest.approx((-0.5, -0.5, -0.5))
    assert gains(half, slide, np.array([-1, -1]))["arc length"].value == pytest.approx(-0.5)
