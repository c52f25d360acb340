"""What a skeleton accepts and refuses."""

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.body import default_body
from footwork.motion.skeleton import Skeleton

OFFSETS = np.zeros((3, 3))


def test_the_default_body_is_symmetric_and_stands_on_its_feet():
    body = default_body()
    left = [joint for joint, name in enumerate(body.names) if name.startswith("left_")]
    right = body.indices([body.names[joint].replace("left", "right") for joint in left])
    assert np.array_equal(body.offsets[left] * [-1, 1, 1], body.offsets[right])
    assert [body.names[joint] for joint in body.feet[0]] == ["left_foot", "left_toes"]


@pytest.mark.parametrize(
    ("parents", "message"),
    [
        ([-1, -1, 0], "2 roots"),
        ([1, 2, 0], "0 roots"),
        ([-1, 2, 1], "cycle"),
        ([1, -1, 0], "cycle"),
        ([-1, 0, 7], "cycle"),
    ],
)
def test_a_tree_with_two_roots_or_a_cycle_is_refused(parents, message):
    with pytest.raises(InputError, match=message):
        Skeleton(("a", "b", "c"), np.array(parents), OFFSETS)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_offsets_that_are_not_finite_are_refused_with_their_place(bad):
    offsets = OFFSETS.copy()
    offsets[1, 2] = bad
    with pytest.raises(InputError, match=r"walk.bvh: offsets\[1, 2\]"):
        Skeleton(("a", "b", "c"), np.array([-1, 0, 1]), offsets, where="walk.bvh")


def test_repeated_names_wrong_shapes_and_negative_masses_are_refused():
    parents = np.array([-1, 0, 1])
    with pytest.raises(InputError, match="'a' is used twice"):
        Skeleton(("a", "b", "a"), parents, OFFSETS)
    with pytest.raises(InputError, match=r"offsets has shape \(2, 3\), expected \(3, 3\)"):
        Skeleton(("a", "b", "c"), parents, OFFSETS[:2])
    with pytest.raises(InputError, match="masses"):
        Skeleton(("a", "b", "c"), parents, OFFSETS, masses=np.array([1.0, -1.0, 0.0]))
    with pytest.raises(InputError, match="at least one joint"):
        Skeleton((), np.zeros(0, dtype=np.int32), np.zeros((0, 3)))


def test_an_unknown_joint_is_answered_with_those_there_are():
    skeleton = Skeleton(("a", "b", "c"), np.array([-1, 0, 1]), OFFSETS)
    with pytest.raises(InputError, match="no joint 'knee', it has a, b, c"):
        skeleton.index("knee")


def test_arrays_are_read_only_copies():
    offsets = OFFSETS.copy()
    skeleton = Skeleton(("a", "b", "c"), np.array([-1, 0, 1]), offsets)
    offsets[0, 0] = 9.0
    assert skeleton.offsets[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        skeleton.offsets[0, 0] = 1.0
