from dataclasses import replace

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.kinematics import forward
from footwork.study.foot_slide import (
    HEEL,
    slide_of_capture,
    slide_of_clip,
    slide_of_frames,
    slide_of_interpolation,
    soles,
)
from motion_samples import ring_graph


def gliding(speed: float, contacts: np.ndarray) -> Clip:
    body, frames = default_body(), len(contacts)
    place = np.zeros((frames, 3))
    place[:, 2], place[:, 1] = speed * np.arange(frames) / 30.0, 0.94 + 0.1 * np.arange(frames)
    return Clip("glide", body, 30.0, place, np.tile(quaternion.IDENTITY, (frames, body.joint_count, 1)), contacts)


def test_a_body_that_glides_slides_at_its_speed_and_rising_is_no_slide():
    assert slide_of_clip(gliding(0.25, np.ones((20, 2), dtype=bool))).cm_per_second == pytest.approx(25.0)


def test_a_foot_that_pivots_on_its_ball_slides_by_half_the_way_of_its_heel():
    turn = np.radians(6.0)
    body, yaw = default_body(), turn * np.arange(2)
    rotations = np.tile(quaternion.IDENTITY, (2, body.joint_count, 1))
    rotations[:, 0] = quaternion.from_yaw(yaw)
    ball = forward(body, np.zeros(3), rotations)[0][:, body.feet[0, 1]]
    standing = np.array([[True, False], [True, False]])
    slide = slide_of_clip(Clip("pivot", body, 30.0, ball[0] - ball, rotations, standing))
    assert slide.metres == pytest.approx(HEEL * np.sin(turn / 2))


def test_a_foot_that_rolls_onto_its_toes_does_not_slide():
    body = default_body()
    places = np.zeros((2, body.joint_count, 3))
    ankle = body.feet[:, 0]
    places[0, ankle, 2], places[1, ankle, 2] = -0.13, -0.05
    places[1, ankle, 1] = 0.12
    np.testing.assert_allclose(*soles(body, places), atol=1e-12)
    places[:, ankle, 2] = 0.0
    np.testing.assert_array_equal(soles(body, places), 0.0)


def test_only_steps_between_two_frames_in_contact_count():
    contacts = np.zeros((6, 2), dtype=bool)
    contacts[1:4, 0] = contacts[5, 1] = True
    slide = slide_of_clip(gliding(0.3, contacts))
    assert slide.seconds == pytest.approx(2 / 30)
    assert slide.metres == pytest.approx(2 * 0.3 / 30)


def test_without_contact_there_is_no_figure():
    assert slide_of_frames(np.zeros((4, 2, 2, 2)), np.zeros((4, 2)), 30.0).cm_per_second is None


def test_the_capture_in_a_graph_slides_as_its_natural_edges_move():
    graph = ring_graph(6)
    standing = type(graph)(**{**vars(graph), "contacts": np.ones((6, 2), dtype=bool)})
    assert slide_of_capture(standing).cm_per_second == pytest.approx(100 * 0.04 * 30, rel=1e-5)


def test_only_captured_frames_of_the_clips_meant_are_the_capture():
    graph = ring_graph(6)
    arrays = vars(graph) | {
        "contacts": np.ones((6, 2), dtype=bool),
        "clips": ("ring", "other"),
        "clip": np.repeat([0, 1], 3),
        "other_clip": np.repeat([0, 1], 3),
        "weight": np.array([1, 1, 0.5, 1, 1, 1]),
    }
    mixed = type(graph)(**arrays)
    # of six steps, two touch the frame between two and one goes from clip to clip
    assert slide_of_capture(mixed).seconds == pytest.approx(2 * 4 / 30)
    assert slide_of_capture(mixed, [0]).seconds == pytest.approx(2 * 1 / 30)


def test_interpolated_frames_are_set_against_the_captured_ones_they_are_made_of():
    # frames 0 and 1 are captured, 2 is a third of 0 and two thirds of 1; 3 comes from a frame that is not there
    graph = ring_graph(6)
    weight = np.ones(6, dtype=np.float32)
    weight[2:4] = 1.0 / 3.0
    displacement = graph.displacement.copy()
    displacement[graph.natural, :2] = [[0.0, 0.01 * (n + 1)] for n in range(6)]
    sources = {"frame": np.array([0, 1, 0, 5, 6, 7]), "other_frame": np.array([0, 1, 1, 9, 6, 7])}
    mixed = replace(graph, weight=weight, displacement=displacement, contacts=np.ones((6, 2), dtype=bool), **sources)
    own, captured = slide_of_interpolation(mixed)
    assert own.seconds == captured.seconds == pytest.approx(2 / 30)
    assert own.metres == pytest.approx(2 * 0.03, rel=1e-5)
    assert captured.metres == pytest.approx(2 * (0.01 / 3 + 0.02 * 2 / 3), rel=1e-5)
