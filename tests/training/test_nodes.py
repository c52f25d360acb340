from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.kinematics import clip_places, facing_yaw, forward
from footwork.motion.skeleton import Skeleton
from footwork.training.nodes import behaviours_of, nodes_of
from motion_samples import sample_clip

BEHAVIOURS = ("stop", "walk", "run", "jump")


def test_a_node_put_at_its_place_is_the_captured_pose():
    clips = [sample_clip(0, 20), sample_clip(1, 30)]
    nodes = nodes_of(clips, BEHAVIOURS)
    upright = quaternion.from_yaw(nodes.places[:, 2])
    root = quaternion.rotate(upright, nodes.arrays["root_position"])
    root[:, [0, 2]] += nodes.places[:, :2]
    rotations = nodes.arrays["rotations"].copy()
    rotations[:, 0] = quaternion.multiply(upright, rotations[:, 0])
    places, _ = forward(nodes.skeleton, root, rotations)
    expected = np.concatenate([clip_places(clip)[0] for clip in clips])
    np.testing.assert_allclose(places, expected, atol=1e-12)


def test_a_node_looks_along_its_planar_frame():
    nodes = nodes_of([sample_clip(2, 25)], BEHAVIOURS)
    places, _ = forward(nodes.skeleton, nodes.arrays["root_position"], nodes.arrays["rotations"])
    np.testing.assert_allclose(facing_yaw(nodes.skeleton, places), 0.0, atol=1e-12)
    np.testing.assert_allclose(nodes.arrays["root_position"][:, [0, 2]], 0.0)


def test_velocities_lead_back_to_the_frame_before():
    clip = sample_clip(3, 25)
    nodes = nodes_of([clip], BEHAVIOURS)
    upright = quaternion.from_yaw(-nodes.places[1:, 2])
    ground = np.stack([nodes.places[1:, 0], np.zeros(24), nodes.places[1:, 1]], axis=-1)
    before = nodes.arrays["root_position"][1:] - nodes.arrays["root_velocity"][1:] / 30.0
    expected = quaternion.rotate(upright, clip.root_position[:-1] - ground)
    np.testing.assert_allclose(before, expected, atol=1e-12)
    spin = quaternion.from_rotation_vector(-nodes.arrays["angular_velocity"][1:] / 30.0)
    turned = quaternion.multiply(spin, nodes.arrays["rotations"][1:])
    wanted = clip.rotations[:-1].copy()
    wanted[:, 0] = quaternion.multiply(upright, wanted[:, 0])
    np.testing.assert_allclose(np.abs(np.sum(turned * wanted, axis=-1)), 1.0, atol=1e-12)


def test_the_first_frame_moves_as_the_second():
    clip = sample_clip(4, 25, turn=0.0)
    nodes = nodes_of([clip], BEHAVIOURS)
    speed = np.linalg.norm(nodes.arrays["root_velocity"], axis=-1)
    assert speed[0] == pytest.approx(speed[1])
    np.testing.assert_allclose(nodes.arrays["angular_velocity"][0, 1:], nodes.arrays["angular_velocity"][1, 1:])


def test_frames_know_their_clip_label_and_end():
    clips = [sample_clip(0, 12, "walk"), sample_clip(1, 15, "idle"), sample_clip(2, 1, "duck")]
    nodes = nodes_of(clips, BEHAVIOURS)
    assert nodes.labels == ("duck", "idle", "walk")
    np.testing.assert_array_equal(nodes.arrays["clip"], [0] * 12 + [1] * 15 + [2])
    np.testing.assert_array_equal(nodes.arrays["frame"], [*range(12), *range(15), 0])
    np.testing.assert_array_equal(nodes.arrays["label"], [2] * 12 + [1] * 15 + [0])
    np.testing.assert_array_equal(nodes.arrays["behaviour"], [1] * 12 + [0] * 15 + [-1])
    np.testing.assert_array_equal(nodes.ends, [11] * 12 + [26] * 15 + [27])
    assert not nodes.arrays["root_velocity"][27].any()


@pytest.mark.parametrize(
    ("labels", "expected"),
    [
        ("idle walk turn walk", "stop walk walk walk"),
        ("run turn run", "run run run"),
        ("run turn turn", "run run run"),
        ("turn run", "run run"),
        ("run turn walk", "run walk walk"),
        ("turn turn", "walk walk"),
        ("jump duck pickup", "jump - -"),
    ],
)
def test_labels_give_behaviours(labels, expected):
    found = behaviours_of(np.array(labels.split()), BEHAVIOURS)
    assert [BEHAVIOURS[index] if index >= 0 else "-" for index in found] == expected.split()


def test_a_behaviour_not_asked_for_is_none():
    np.testing.assert_array_equal(behaviours_of(np.array(["walk", "jump"]), ("walk",)), [0, -1])


def test_clips_of_other_bodies_or_rates_are_refused():
    clip = sample_clip(0, 12)
    body = clip.skeleton
    longer = replace(
        clip, name="tall.bvh", skeleton=Skeleton(body.names, body.parents, body.offsets * 1.1, feet=body.feet)
    )
    with pytest.raises(InputError, match=r"tall.bvh: another body"):
        nodes_of([clip, longer], BEHAVIOURS)
    with pytest.raises(InputError, match="120 frames a second"):
        nodes_of([replace(clip, fps=120.0)], BEHAVIOURS)
    with pytest.raises(InputError, match="no clips"):
        nodes_of([], BEHAVIOURS)
