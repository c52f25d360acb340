from itertools import permutations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from footwork.motion.euler import from_euler, to_euler

ORDERS = ["".join(order) for order in permutations("XYZ")]


@pytest.mark.parametrize("axes", [*ORDERS, "X", "Y", "Z", "XZ", "YX"])
def test_angles_become_scipys_intrinsic_rotations(axes: str):
    angles = np.random.default_rng(1).uniform(-10, 10, (5, 7, len(axes)))
    wanted = Rotation.from_euler(axes, angles.reshape(-1, len(axes)))
    ours = Rotation.from_quat(from_euler(axes, angles).reshape(-1, 4))
    assert (wanted.inv() * ours).magnitude().max() < 1e-14


def test_no_axes_give_the_identity():
    np.testing.assert_array_equal(from_euler("", np.empty((3, 0))), [[0, 0, 0, 1]] * 3)


@pytest.mark.parametrize("axes", ORDERS)
@pytest.mark.parametrize("middle", [0.3, np.pi / 2, -np.pi / 2, np.pi / 2 - 1e-9])
def test_angles_read_off_give_the_same_rotation_even_in_gimbal_lock(axes: str, middle: float):
    angles = np.random.default_rng(2).uniform(-3, 3, (20, 3))
    angles[:, 1] = middle
    rotations = from_euler(axes, angles)
    again = from_euler(axes, to_euler(axes, rotations))
    assert (Rotation.from_quat(rotations).inv() * Rotation.from_quat(again)).magnitude().max() < 1e-7
