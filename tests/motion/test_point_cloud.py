import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.point_cloud import PointCloud, joint_cloud


def test_joints_without_weight_are_left_out():
    cloud = joint_cloud(np.array([2.0, 0.0, 6.0]))
    places = np.random.default_rng(0).random((4, 3, 3))
    np.testing.assert_array_equal(cloud.points(places), places[:, [0, 2]])
    np.testing.assert_array_equal(cloud.weights, [0.25, 0.75])


@pytest.mark.parametrize(
    ("shares", "weights", "says"),
    [
        (np.eye(2), [0.0, 0.0], "not all zero"),
        (np.zeros((0, 2)), [], "not all zero"),
        (np.eye(2), [1.0, -1.0], "zero or more"),
        (np.eye(2), [1.0, np.nan], "nan"),
        (np.eye(2), [1.0, 1.0, 1.0], "shape"),
    ],
)
def test_weights_that_cannot_be_scaled_are_refused(shares, weights, says):
    with pytest.raises(InputError, match=says):
        PointCloud(shares, np.array(weights))
