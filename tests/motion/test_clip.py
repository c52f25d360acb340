"""What a clip accepts, refuses and how it is cut."""

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.quaternion import IDENTITY

BODY = default_body()


def still(frames: int, **changes) -> Clip:
    fields = {"root_position": np.zeros((frames, 3)), "rotations": np.tile(IDENTITY, (frames, BODY.joint_count, 1))}
    return Clip("still.bvh", BODY, 30.0, **(fields | changes))


def test_cut_takes_a_half_open_range_of_everything():
    labels = np.array(["idle"] * 4 + ["walk"] * 6)
    root = np.arange(30.0).reshape(10, 3)
    part = still(10, labels=labels, root_position=root).cut(3, 6)
    assert part.frame_count == 3
    assert list(part.labels) == ["idle", "walk", "walk"]
    assert np.array_equal(part.root_position, root[3:6])


@pytest.mark.parametrize(("start", "end"), [(-1, 4), (4, 4), (6, 4), (0, 11)])
def test_a_cut_outside_the_clip_is_refused(start, end):
    with pytest.raises(InputError, match=r"still.bvh: frames .* inside 0..10"):
        still(10).cut(start, end)


def test_an_empty_clip_is_refused():
    with pytest.raises(InputError, match=r"still.bvh: the clip is empty"):
        still(0)


def test_bad_numbers_and_shapes_are_refused():
    with pytest.raises(InputError, match=r"root_position\[2, 0\] is nan"):
        still(4, root_position=np.array([[0.0, 0, 0], [0, 0, 0], [np.nan, 0, 0], [0, 0, 0]]))
    with pytest.raises(InputError, match="labels has shape"):
        still(4, labels=np.array(["idle"]))
    with pytest.raises(InputError, match="frames a second"):
        Clip("still.bvh", BODY, 0.0, np.zeros((1, 3)), np.tile(IDENTITY, (1, BODY.joint_count, 1)))
