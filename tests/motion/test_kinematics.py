"""Forward kinematics against homogeneous matrices, and what is read off joints' places."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from footwork.motion import kinematics, quaternion
from footwork.motion.body import default_body

BODY = default_body()
seeds = st.integers(0, 2**32 - 1)


def random_pose(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    rotations = Rotation.random(2 * BODY.joint_count, rng=rng).as_quat().reshape(2, BODY.joint_count, 4)
    return rng.normal(size=(2, 3)), rotations


def chain_of_matrices(root: np.ndarray, rotations: np.ndarray) -> np.ndarray:
    frames = []
    for joint, parent in enumerate(BODY.parents):
        frame = np.eye(4)
        frame[:3, :3] = Rotation.from_quat(rotations[joint]).as_matrix()
        frame[:3, 3] = root if parent < 0 else BODY.offsets[joint]
        frames.append(frame if parent < 0 else frames[parent] @ frame)
    return np.array(frames)


@given(seeds)
def test_forward_equals_a_chain_of_matrices(seed):
    root, rotations = random_pose(seed)
    places, turns = kinematics.forward(BODY, root, rotations)
    for pose in range(2):
        frames = chain_of_matrices(root[pose], rotations[pose])
        assert np.allclose(places[pose], frames[:, :3, 3], atol=1e-12)
        assert np.allclose(Rotation.from_quat(turns[pose]).as_matrix(), frames[:, :3, :3], atol=1e-12)


@given(seeds)
def test_local_rotations_undo_forward(seed):
    root, rotations = random_pose(seed)
    _, turns = kinematics.forward(BODY, root, rotations)
    local = kinematics.local_rotations(BODY, turns)
    assert np.allclose(np.abs(np.sum(local * rotations, axis=-1)), 1.0)


def test_translations_replace_the_rest_offsets():
    root, rotations = random_pose(1)
    translations = np.broadcast_to(BODY.offsets * 2.0, (2, BODY.joint_count, 3))
    stretched, _ = kinematics.forward(BODY, root, rotations, translations)
    plain, _ = kinematics.forward(BODY, root, rotations)
    assert np.allclose(stretched - root[:, None], 2.0 * (plain - root[:, None]))


@pytest.mark.parametrize("yaw", [-3.0, -1.0, 0.0, 0.5, 3.0])
def test_facing_is_the_yaw_of_a_turned_rest_pose(yaw):
    rotations = np.tile(quaternion.IDENTITY, (BODY.joint_count, 1))
    rotations[0] = quaternion.from_yaw(yaw)
    places, _ = kinematics.forward(BODY, np.zeros(3), rotations)
    assert kinematics.facing_yaw(BODY, places) == pytest.approx(yaw)


@given(seeds)
def test_facing_is_across_times_up_of_hips_and_shoulders_alike(seed):
    places, _ = kinematics.forward(BODY, *random_pose(seed))
    place = {name: places[:, joint] for joint, name in enumerate(BODY.names)}
    across = place["left_thigh"] - place["right_thigh"] + place["left_upper_arm"] - place["right_upper_arm"]
    facing = np.cross(across, [0.0, 1.0, 0.0])
    assert np.allclose(kinematics.facing_yaw(BODY, places), np.arctan2(facing[:, 0], facing[:, 2]))


def test_central_velocity_is_exact_on_a_straight_line_and_zero_for_one_frame():
    line = np.outer(np.arange(5) / 30.0, [1.0, 2.0, 3.0])
    assert np.allclose(kinematics.central_velocity(line, 30.0), [1.0, 2.0, 3.0])
    assert np.array_equal(kinematics.central_velocity(line[:1], 30.0), np.zeros((1, 3)))
