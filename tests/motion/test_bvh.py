from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from footwork.errors import InputError
from footwork.motion.bvh import read_bvh, write_bvh
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.motion.quaternion import normalise
from footwork.motion.skeleton import Skeleton

SMALL = """HIERARCHY
ROOT Hips
{
  OFFSET 5 90 7
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Left Leg
  {
    OFFSET 10 0 0
    CHANNELS 3 Yrotation Zrotation Xrotation
    End Site
    {
      OFFSET 0 -40 0
    }
  }
  JOINT Sword
  {
    OFFSET 1 2 3
    CHANNELS 4 Xposition Zposition Yposition Xrotation
    End Site
    {
      OFFSET 0 0 100
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.0333333
100 95 0 0 0 0  0 0 0  4 6 5 0
100 95 10 90 0 0  30 20 10  7 9 8 45
"""


def read_text(folder: Path, text: str) -> Clip:
    path = folder / "small.bvh"
    path.write_bytes(text.encode())
    return read_bvh(path)


def test_centimetres_become_metres_and_the_frame_time_a_whole_rate(tmp_path: Path):
    clip = read_text(tmp_path, SMALL)
    assert clip.fps == 30.0
    assert clip.skeleton.names == ("Hips", "Left Leg", "Sword")
    np.testing.assert_allclose(clip.skeleton.ends, [[0, 0, 0], [0, -0.4, 0], [0, 0, 1.0]])


def test_root_position_channels_replace_the_offset(tmp_path: Path):
    np.testing.assert_allclose(read_text(tmp_path, SMALL).root_position, [[1.0, 0.95, 0.0], [1.0, 0.95, 0.1]])


def test_root_without_position_channels_stays_at_its_offset(tmp_path: Path):
    text = SMALL.replace("CHANNELS 6 Xposition Yposition Zposition", "CHANNELS 3").replace("100 95 0 ", "")
    text = text.replace("100 95 10 ", "")
    np.testing.assert_allclose(read_text(tmp_path, text).root_position, [[0.05, 0.9, 0.07]] * 2)


def test_position_channels_of_other_joints_replace_their_offsets(tmp_path: Path):
    clip = read_text(tmp_path, SMALL)
    assert clip.translations is not None
    np.testing.assert_allclose(clip.translations[:, 2], [[0.04, 0.05, 0.06], [0.07, 0.08, 0.09]])
    np.testing.assert_allclose(clip.translations[:, 1], [[0.1, 0, 0]] * 2)


def test_rotation_channels_multiply_in_the_order_declared(tmp_path: Path):
    clip = read_text(tmp_path, SMALL)
    y, z, x = (Rotation.from_euler(axis, angle, degrees=True) for axis, angle in zip("yzx", (30, 20, 10), strict=True))
    assert (Rotation.from_quat(clip.rotations[1, 1]).inv() * (y * z * x)).magnitude() < 1e-12


@pytest.mark.parametrize(
    ("printed", "fps"),
    [("0.0333333", 30), ("0.033", 30), ("0.00833333", 120), ("8.33333e-03", 120), ("0.0166667", 60), ("0.4", 2.5)],
)
def test_frame_time_is_a_whole_rate_where_its_digits_allow(tmp_path: Path, printed: str, fps: float):
    assert read_text(tmp_path, SMALL.replace("0.0333333", printed)).fps == pytest.approx(fps, abs=1e-12)


def test_broadcast_rate_is_kept(tmp_path: Path):
    assert read_text(tmp_path, SMALL.replace("0.0333333", "0.0333667")).fps == pytest.approx(29.97, abs=1e-4)


def test_windows_line_ends_tabs_and_a_byte_order_mark_are_read(tmp_path: Path):
    text = "\ufeff" + SMALL.replace("\n", "\r\n").replace("Frames: ", "Frames:\t")
    np.testing.assert_array_equal(read_text(tmp_path, text).rotations, read_text(tmp_path, SMALL).rotations)


BAD = {
    "unknown channel": (("Zrotation", "Wrotation"), "small.bvh:5"),
    "channel twice": (("Zrotation Xrotation Yrotation", "Zrotation Xrotation Zrotation"), "small.bvh:5"),
    "channel count too large": (("CHANNELS 3", "CHANNELS 999999999999"), "small.bvh:9"),
    "channel count too small": (("CHANNELS 3", "CHANNELS 2"), "small.bvh:9"),
    "two roots": (("MOTION", "ROOT Other\n{\n}\nMOTION"), "second ROOT"),
    "brace missing": (("}\nMOTION", "MOTION"), "out of balance"),
    "brace too many": (("}\nMOTION", "}\n}\nMOTION"), "small.bvh:25"),
    "same name twice": (("Sword", "Hips"), "small.bvh:16: joint name 'Hips' is used twice"),
    "endless name": (("Sword", "S" * 999), "small.bvh:16: a name of 999"),
    "joint without channels": (("CHANNELS 3 Yrotation Zrotation Xrotation", ""), "without CHANNELS"),
    "offset not a number": (("OFFSET 10 0 0", "OFFSET 10 x 0"), "small.bvh:8"),
    "offset NaN": (("OFFSET 10 0 0", "OFFSET nan 0 0"), "small.bvh:8"),
    "value NaN": (("100 95 10", "100 NaN 10"), "small.bvh:29"),
    "value infinite": (("100 95 10", "100 1e999 10"), "small.bvh:29"),
    "value not a number": (("100 95 10", "100 9,5 10"), "small.bvh:29"),
    "too few numbers": (("7 9 8 45", "7 9 8"), "small.bvh:29"),
    "too many numbers": (("7 9 8 45", "7 9 8 45 1"), "small.bvh:29"),
    "more frames promised": (("Frames: 2", "Frames: 3"), "says 3"),
    "fewer frames promised": (("Frames: 2", "Frames: 1"), "says 1"),
    "absurd frame count": (("Frames: 2", "Frames: 99999999999999999999"), "small.bvh:26"),
    "negative frame count": (("Frames: 2", "Frames: -2"), "small.bvh:26"),
    "no frames": (("Frames: 2", "Frames: 0"), "small.bvh:26"),
    "frame time zero": (("0.0333333", "0"), "small.bvh:27"),
    "frame time negative": (("0.0333333", "-0.03"), "small.bvh:27"),
    "frame time NaN": (("0.0333333", "nan"), "small.bvh:27"),
    "no motion": (("MOTION", ""), "no MOTION"),
    "no hierarchy": (("HIERARCHY", "FOO"), "small.bvh:1"),
}


@pytest.mark.parametrize(("change", "said"), BAD.values(), ids=BAD.keys())
def test_bad_file_is_refused_with_its_place(tmp_path: Path, change: tuple[str, str], said: str):
    with pytest.raises(InputError, match=said) as caught:
        read_text(tmp_path, SMALL.replace(*change))
    assert "small.bvh" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_deep_nesting_and_too_many_joints_are_refused(tmp_path: Path):
    joint = "JOINT j{} {{ OFFSET 0 0 0 CHANNELS 0\n"
    text = SMALL.replace("  JOINT Sword", "".join(joint.format(i) for i in range(5000)) + "  JOINT Sword")
    with pytest.raises(InputError, match="more than 1000 joints"):
        read_text(tmp_path, text)


def test_missing_empty_and_unreadable_files_are_refused(tmp_path: Path):
    for path, said in ((tmp_path / "none.bvh", "cannot be read"), (tmp_path, "cannot be read")):
        with pytest.raises(InputError, match=said):
            read_bvh(path)
    with pytest.raises(InputError, match="is empty"):
        read_text(tmp_path, "\n\n")


@given(st.integers(0, len(SMALL)))
@settings(max_examples=40, deadline=None)
def test_truncated_file_is_refused_or_still_whole(tmp_path_factory: pytest.TempPathFactory, length: int):
    folder = tmp_path_factory.getbasetemp()
    try:
        clip = read_text(folder, SMALL[:length])
    except InputError:
        return
    assert clip.frame_count == 2


@given(st.integers(0, len(SMALL) - 1), st.integers(0, 6), st.binary(max_size=6))
@settings(max_examples=200, deadline=None)
def test_mutated_file_gives_a_clip_or_an_input_error(
    tmp_path_factory: pytest.TempPathFactory, place: int, removed: int, added: bytes
):
    path = tmp_path_factory.getbasetemp() / "mutated.bvh"
    path.write_bytes(SMALL.encode()[:place] + added + SMALL.encode()[place + removed :])
    try:
        clip = read_bvh(path)
    except InputError:
        return
    assert np.isfinite(clip_places(clip)[0]).all()


def random_clip(seed: int, translations: bool) -> Clip:
    """Ten joints in an order that is not depth first, turned any way, gimbal lock included."""
    rng = np.random.default_rng(seed)
    parents = [-1, 0, 0, 1, 1, 2, 3, 5, 2, 0]
    skeleton = Skeleton(
        names=tuple(f"joint {index}" for index in range(10)),
        parents=np.array(parents),
        offsets=np.vstack([np.zeros(3), rng.normal(size=(9, 3))]),
        ends=rng.normal(size=(10, 3)) * (rng.random((10, 1)) < 0.6),
    )
    rotations = normalise(rng.normal(size=(5, 10, 4)))
    rotations[0, 0] = Rotation.from_euler("ZXY", [40, 90, 0], degrees=True).as_quat()
    moving = skeleton.offsets + (np.arange(10) > 6)[:, None] * rng.normal(size=(5, 10, 3))
    return Clip(
        "random", skeleton, 120.0, rng.normal(size=(5, 3)), rotations, translations=moving if translations else None
    )


@pytest.mark.parametrize("translations", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_written_and_read_again_it_is_the_same_motion(tmp_path: Path, seed: int, translations: bool):
    clip = random_clip(seed, translations)
    write_bvh(tmp_path / "copy.bvh", clip)
    again = read_bvh(tmp_path / "copy.bvh")
    order = again.skeleton.indices(clip.skeleton.names)
    assert again.fps == clip.fps
    assert (again.translations is not None) == translations
    np.testing.assert_allclose(clip_places(again)[0][:, order], clip_places(clip)[0], atol=1e-6)
    np.testing.assert_allclose(again.skeleton.ends[order], clip.skeleton.ends, atol=1e-7)
    turn = Rotation.from_quat(again.rotations[:, order].reshape(-1, 4)).inv() * Rotation.from_quat(
        clip.rotations.reshape(-1, 4)
    )
    assert turn.magnitude().max() < 1e-6


def test_unwritable_name_and_place_are_refused_and_leave_nothing(tmp_path: Path):
    clip = random_clip(0, translations=False)
    braces = Skeleton(names=("a{",), parents=np.array([-1]), offsets=np.zeros((1, 3)))
    with pytest.raises(InputError, match="braces"):
        write_bvh(tmp_path / "x.bvh", Clip("x", braces, 30.0, np.zeros((1, 3)), np.array([[[0, 0, 0, 1.0]]])))
    with pytest.raises(InputError, match="cannot be written"):
        write_bvh(tmp_path / "nowhere" / "x.bvh", clip)
    (tmp_path / "folder.bvh").mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        write_bvh(tmp_path / "folder.bvh", clip)
    assert [path.name for path in tmp_path.iterdir()] == ["folder.bvh"]
