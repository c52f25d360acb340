import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from footwork.motion.body import FEET, default_body, rest_height
from footwork.motion.clip import Clip
from footwork.motion.contacts import _latched, detect_contacts, drop_short_runs, point_contacts
from footwork.motion.quaternion import IDENTITY


def stepping_point(fps, plants):
    """A point that stands in ``plants`` (start, end) seconds and swings 12 cm high at 2 m/s between them."""
    time = np.arange(0.0, 3.0, 1.0 / fps)
    standing = np.any([(time >= start) & (time < end) for start, end in plants], axis=0)
    forward = np.cumsum(np.where(standing, 0.0, 2.0 / fps))
    height = np.where(standing, 0.03, 0.15)
    return np.stack([0.0 * time, height, forward], axis=-1), standing


@pytest.mark.parametrize("fps", [30.0, 60.0, 120.0])
def test_planted_stretches_are_found_to_a_frame(fps):
    points, standing = stepping_point(fps, [(0.0, 0.6), (1.0, 1.7), (2.2, 3.0)])
    found = point_contacts(points, fps)
    assert np.count_nonzero(found != standing) <= 4  # one frame at each of the four edges
    assert np.count_nonzero(np.diff(found)) == 4


def test_a_point_needs_both_height_and_speed():
    still_but_high, _ = stepping_point(30.0, [(0.0, 1.0)])
    still_but_high[60:] = still_but_high[60] + [0.0, 0.0, 0.0]
    low_but_fast, _ = stepping_point(30.0, [(0.0, 1.0)])
    low_but_fast[:, 1] = 0.03
    for points in (still_but_high, low_but_fast):
        found = point_contacts(points, 30.0)
        assert found[:28].all()
        assert not found[31:].any()


def test_flickers_shorter_than_half_the_median_filter_go():
    points, _ = stepping_point(120.0, [(0.0, 3.0)])
    points[100:104, 1] += 0.1  # off for six frames, of the thirteen of the filter
    assert point_contacts(points, 120.0).all()
    points[100:120, 1] += 0.1
    assert not point_contacts(points, 120.0)[105:115].any()


@pytest.mark.parametrize(("speed", "stands"), [(0.19, True), (0.21, False)])
def test_a_foot_comes_to_stand_below_the_speed_of_the_convention(speed, stands):
    points = np.stack([np.zeros(60), np.full(60, 0.03), speed * np.arange(60) / 30.0], axis=-1)
    assert (point_contacts(points, 30.0) == stands).all()


@pytest.mark.parametrize(("speed", "stands"), [(0.34, True), (0.36, False)])
def test_a_standing_foot_leaves_above_the_speed_of_the_convention(speed, stands):
    steps = np.where(np.arange(60) < 30, 0.0, speed / 30.0)
    points = np.stack([np.zeros(60), np.full(60, 0.03), np.cumsum(steps)], axis=-1)
    found = point_contacts(points, 30.0)
    assert found[:28].all()
    assert (found[32:] == stands).all()


def test_the_ground_is_the_second_percentile_of_the_heights():
    height = np.full(1000, 0.041)
    height[:30] = 0.0  # three in a hundred are lower by more than a foot may stand above the ground
    points = np.stack([np.zeros(1000), height, np.zeros(1000)], axis=-1)
    assert not point_contacts(points, 1.0)[40:].any()
    points[:30, 1] = [0.0] * 15 + [0.041] * 15
    assert point_contacts(points, 1.0)[40:].all()


def test_hysteresis_holds_between_the_thresholds():
    height = np.full(60, 0.03)
    height[20:25] = 0.03 + 0.032  # above on, below off
    height[40:] = 0.03 + 0.032
    height[10:14] = 0.03 + 0.05
    points = np.stack([np.zeros(60), height, np.zeros(60)], axis=-1)
    found = point_contacts(points, 1.0)  # one frame a second: speeds play no part
    assert found[20:25].all()
    assert found[40:].all()
    assert not found[10:14].any()


@given(arrays(bool, st.tuples(st.integers(1, 40), st.just(2))))
def test_latch_is_the_state_machine(on):
    off = np.roll(on, 3, axis=0) & ~on
    expected = np.zeros_like(on)
    for point in range(on.shape[1]):
        state = False
        for frame in range(len(on)):
            state = bool(on[frame, point]) or (state and not off[frame, point])
            expected[frame, point] = state
    assert np.array_equal(_latched(on, off), expected)


def test_runs_shorter_than_three_frames_go():
    contacts = np.array([[1, 1, 0, 1, 1, 1, 0, 1], [0, 0, 1, 1, 1, 1, 0, 0]], dtype=bool).T
    kept = drop_short_runs(contacts, 3)
    assert kept.T.astype(int).tolist() == [[0, 0, 0, 1, 1, 1, 0, 0], [0, 0, 1, 1, 1, 1, 0, 0]]


def marching_clip(fps=30.0):
    """The default body on the spot: left foot lifted in 0.5-1.0 s, right foot in 1.5-2.0 s."""
    body = default_body()
    time = np.arange(0.0, 2.5, 1.0 / fps)
    rotations = np.tile(IDENTITY, (len(time), body.joint_count, 1))
    lift = {"left": (time >= 0.5) & (time < 1.0), "right": (time >= 1.5) & (time < 2.0)}
    for side, up in lift.items():
        for part, angle in (("thigh", -1.0), ("shank", 2.0), ("foot", -1.0)):
            half = 0.5 * angle * up
            rotations[:, body.index(f"{side}_{part}")] = np.stack(
                [np.sin(half), 0.0 * half, 0.0 * half, np.cos(half)], axis=-1
            )
    root = np.tile([0.0, rest_height(body), 0.0], (len(time), 1))
    return Clip("march", body, fps, root, rotations), np.stack([~lift["left"], ~lift["right"]], axis=-1)


def test_a_marching_body_has_the_feet_it_stands_on():
    clip, truth = marching_clip()
    found = detect_contacts(clip)
    assert found.shape == (clip.frame_count, len(FEET))
    assert np.count_nonzero(found != truth) <= 8


def test_the_floor_of_the_capture_does_not_matter():
    clip, _ = marching_clip()
    raised = Clip(clip.name, clip.skeleton, clip.fps, np.add(clip.root_position, [3.0, 0.37, -2.0]), clip.rotations)
    assert np.array_equal(detect_contacts(clip), detect_contacts(raised))


def test_one_frame_is_too_short_to_be_a_contact():
    clip, _ = marching_clip()
    assert not detect_contacts(clip.cut(0, 1)).any()
