import struct
import sys

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.skeleton import Skeleton
from footwork.study.camera import Camera
from footwork.study.contact_sheet import contact_sheet, contact_sheets

plt = pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed")


def standing(frames: int = 6, name: str = "stand.bvh") -> Clip:
    body = default_body()
    rotations = np.tile(quaternion.IDENTITY, (frames, body.joint_count, 1))
    return Clip(name, body, 30.0, np.tile([0.0, 0.96, 0.0], (frames, 1)), rotations, np.ones((frames, 2), dtype=bool))


def png_size(path) -> tuple[int, int]:
    return struct.unpack(">II", path.read_bytes()[16:24])


@pytest.mark.parametrize("view", ["side", "front", "three-quarter"])
def test_a_sheet_shows_both_sides_and_the_trunk(tmp_path, view):
    pixels = plt.imread(contact_sheet(tmp_path / "sheet.png", standing(), every=3, view=view))[..., :3]
    blue = (pixels[..., 2] - pixels[..., 0] > 0.2).mean()
    orange = (pixels[..., 0] - pixels[..., 2] > 0.3).mean()
    assert orange > 0.01
    assert blue > (0.0005 if view == "side" else 0.01)


def test_rows_wrap_and_columns_set_the_width(tmp_path):
    wide = png_size(contact_sheet(tmp_path / "wide.png", standing(), every=1, columns=6))
    tall = png_size(contact_sheet(tmp_path / "tall.png", standing(), every=1, columns=3))
    assert wide[0] == pytest.approx(2 * tall[0], abs=2)
    assert tall[1] > 1.7 * wide[1]


def test_one_file_a_clip_and_the_same_bytes_again(tmp_path):
    clips = [standing(3, "a.bvh[0:3]"), standing(3, "../b.amc")]
    paths = contact_sheets(tmp_path / "new" / "folder", clips)
    assert [path.name for path in paths] == ["a_bvh_0_3.png", "b_amc.png"]
    before = paths[0].read_bytes()
    assert contact_sheets(tmp_path / "again", clips)[0].read_bytes() == before


def test_any_skeleton_is_drawn_as_sticks(tmp_path):
    skeleton = Skeleton(("root", "LeftLeg"), np.array([-1, 0]), np.array([[0, 0, 0], [0, -1.0, 0]]))
    clip = Clip("sticks", skeleton, 30.0, np.array([[0, 1.0, 0]]), np.tile(quaternion.IDENTITY, (1, 2, 1)))
    pixels = plt.imread(contact_sheet(tmp_path / "sticks.png", clip))[..., :3]
    assert (pixels[..., 2] - pixels[..., 0] > 0.2).any()


@pytest.mark.parametrize("wrong", [{"view": "top"}, {"every": 0}, {"columns": 0}])
def test_wrong_options_say_what_is_valid(tmp_path, wrong):
    with pytest.raises(InputError, match="expected"):
        contact_sheet(tmp_path / "sheet.png", standing(), **wrong)


def test_a_place_that_cannot_be_written_leaves_nothing(tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        contact_sheet(tmp_path / "missing" / "sheet.png", standing(1))
    assert not list(tmp_path.iterdir())


def test_the_camera_puts_the_left_of_the_world_on_the_left_and_depth_ahead():
    # looking along +z, +x is to the left
    places, depth, scale = Camera(yaw=0.0).project([1.0, 2.0, 3.0])
    np.testing.assert_allclose(places, [-1.0, 2.0])
    assert depth == pytest.approx(3.0)
    assert scale == 1.0
    # looking along +x, +z is to the right
    np.testing.assert_allclose(Camera(yaw=np.pi / 2).project([0.0, 0.0, 1.0])[0], [1.0, 0.0], atol=1e-12)


def test_perspective_shrinks_what_is_twice_as_far_to_half():
    places, _, scale = Camera(yaw=0.0, distance=4.0).project([[0.0, 1.0, 0.0], [0.0, 1.0, 4.0]])
    np.testing.assert_allclose(scale, [1.0, 0.5])
    np.testing.assert_allclose(places[:, 1], [1.0, 0.5])


def test_without_matplotlib_it_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(InputError, match=r"pip install footwork\[plots\]"):
        contact_sheet(tmp_path / "sheet.png", standing())
