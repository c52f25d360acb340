import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from footwork.errors import InputError
from footwork.motion.asf_amc import read_amc, read_asf
from footwork.motion.capture import read_capture
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places

ASF = """# a comment
:version 1.10
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
  begin anything end
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name hip
    direction 1 0 0
    length 2
    axis 0 0 0 XYZ
  end
  begin
    id 2
    name thigh
    direction 0 -1 0
    length 8
    axis 10 20 30 XYZ
    dof rx rz
    limits (-160.0 20.0)
           (-70.0 70.0)
  end
  begin
    id 3
    name toe
    direction 0 0 1
    length 1
    axis -90 0 20 XYZ
    dof rx
  end
:hierarchy
  begin
    root hip
    hip thigh
    thigh toe
  end
"""
AMC = """#!OML:ASF somewhere
:FULLY-SPECIFIED
:DEGREES
1
root 1 16 2 0 0 0
thigh 0 0
toe 0
2
root 1 16 3 10 20 30
thigh 40 50
toe -60
"""
UNIT = 0.0254 / 0.45


def read_texts(folder: Path, asf: str = ASF, amc: str = AMC) -> Clip:
    (folder / "01.asf").write_bytes(asf.encode())
    (folder / "01_02.amc").write_bytes(amc.encode())
    return read_capture(folder / "01_02.amc")


def test_rest_pose_hangs_bones_end_to_start(tmp_path: Path):
    clip = read_texts(tmp_path)
    assert clip.skeleton.names == ("root", "hip", "thigh", "toe")
    assert clip.fps == 120.0
    wanted = np.array([[1, 16, 2], [1, 16, 2], [3, 16, 2], [3, 8, 2]]) * UNIT
    np.testing.assert_allclose(clip_places(clip)[0][0], wanted, atol=1e-12)
    np.testing.assert_allclose(clip.skeleton.ends, np.array([[0, 0, 0]] * 3 + [[0, 0, 1]]) * UNIT)


@pytest.mark.parametrize("order", ["XYZ", "ZYX", "YZX"])
def test_an_axis_is_turned_by_its_angles_in_the_order_it_names(tmp_path: Path, order: str):
    path = tmp_path / "01.asf"
    path.write_text(ASF.replace("axis 10 20 30 XYZ", f"axis 10 20 30 {order}"))
    asf = read_asf(path)
    axis = Rotation.from_quat(asf.axes[asf.skeleton.index("thigh")])
    # lower case: about fixed axes, the first named first
    expected = Rotation.from_euler(order.lower(), [10, 20, 30], degrees=True)
    assert (axis * expected.inv()).magnitude() < 1e-12


def test_bone_turns_by_its_degrees_of_freedom_about_its_axis(tmp_path: Path):
    def turn(x: float, y: float, z: float) -> Rotation:
        return Rotation.from_matrix(
            Rotation.from_euler("z", z, degrees=True).as_matrix()
            @ Rotation.from_euler("y", y, degrees=True).as_matrix()
            @ Rotation.from_euler("x", x, degrees=True).as_matrix()
        )

    world = Rotation.from_quat(clip_places(read_texts(tmp_path))[1][1])
    axis = turn(10, 20, 30)
    thigh = turn(10, 20, 30) * axis * turn(40, 0, 50) * axis.inv()
    assert (world[0].inv() * turn(10, 20, 30)).magnitude() < 1e-12
    assert (world[1].inv() * world[0]).magnitude() < 1e-12
    assert (world[2].inv() * thigh).magnitude() < 1e-12
    assert (world[3].inv() * thigh * turn(-90, 0, 20) * turn(-60, 0, 0) * turn(-90, 0, 20).inv()).magnitude() < 1e-12


def test_radians_and_another_unit_of_length(tmp_path: Path):
    plain = read_texts(tmp_path)
    asf = ASF.replace("angle deg", "angle rad").replace("length 0.45", "length 0.9")
    asf = asf.replace("axis 10 20 30", " ".join(["axis", *(str(math.radians(a)) for a in (10, 20, 30))]))
    asf = asf.replace("axis -90 0 20", " ".join(["axis", *(str(math.radians(a)) for a in (-90, 0, 20))]))
    amc = AMC.replace("10 20 30", " ".join(str(math.radians(a)) for a in (10, 20, 30)))
    amc = amc.replace("40 50", " ".join(str(math.radians(a)) for a in (40, 50))).replace("-60", str(math.radians(-60)))
    clip = read_texts(tmp_path, asf, amc.replace(":DEGREES", ":RADIANS"))
    np.testing.assert_allclose(clip_places(clip)[0], 0.5 * clip_places(plain)[0], atol=1e-12)


def test_windows_line_ends_and_blank_lines_are_read(tmp_path: Path):
    amc = AMC.replace("\n", "\r\n") + "\r\n"
    np.testing.assert_array_equal(
        read_texts(tmp_path, ASF.replace("\n", "\r\n"), amc).rotations, read_texts(tmp_path).rotations
    )


BAD_ASF = {
    "cycle": (
        "root hip\n    hip thigh\n    thigh toe",
        "root hip\n    thigh toe\n    toe thigh",
        "01.asf:22: bone 'thigh'",
    ),
    "loose bone": ("    thigh toe\n", "", "01.asf:32: bone 'toe' is not reached"),
    "second parent": ("    thigh toe", "    thigh toe\n    hip toe", "01.asf:45: bone 'toe' has a second parent"),
    "unknown child": ("hip thigh", "hip thing", "01.asf:43: 'hip' to 'thing'"),
    "own parent": ("    thigh toe", "    toe toe", "01.asf:32: bone 'toe' is not reached"),
    "unknown channel": ("dof rx rz", "dof rx rw", "01.asf:28: unknown degree of freedom 'rw'"),
    "channel twice": ("dof rx rz", "dof rx rx", "01.asf:28"),
    "root channels": ("TX TY TZ RX RY RZ", "TX TY TZ RX RY", "01.asf:9: the root needs"),
    "bone twice": ("name toe", "name thigh", "01.asf:39: bone name 'thigh'"),
    "NaN": ("length 8", "length nan", "01.asf:26"),
    "infinite": ("direction 0 -1 0", "direction 0 -1e999 0", "01.asf:25"),
    "too few numbers": ("direction 0 -1 0", "direction 0 -1", "01.asf:25: direction has 2"),
    "axis order": ("axis 10 20 30 XYZ", "axis 10 20 30 XYX", "01.asf:27"),
    "unit zero": ("length 0.45", "length 0", "01.asf: unit of length"),
    "unit of angle": ("angle deg", "angle turns", "01.asf:6: angle 'turns'"),
    "moved root": ("position 0 0 0", "position 0 1 0", "01.asf:12"),
    "no hierarchy": (":hierarchy", "", "no :hierarchy section"),
    "no end": ("    thigh toe\n  end", "    thigh toe", "no end: truncated"),
    "bone without end": ("dof rx\n  end", "dof rx", "01.asf:32: the bone that begins here has no end"),
}


@pytest.mark.parametrize(("old", "new", "said"), BAD_ASF.values(), ids=BAD_ASF.keys())
def test_bad_skeleton_is_refused_with_its_place(tmp_path: Path, old: str, new: str, said: str):
    assert old in ASF
    with pytest.raises(InputError, match=said):
        read_texts(tmp_path, asf=ASF.replace(old, new, 1))


BAD_AMC = {
    "unknown bone": ("thigh 40 50", "tail 40 50", "01_02.amc:10: 'tail'"),
    "bone missing": ("thigh 40 50\n", "", "01_02.amc:8: frame 2 has 0 lines for bone 'thigh'"),
    "bone twice": ("toe -60", "thigh 1 2\ntoe -60", "01_02.amc:8: frame 2 has 2 lines for bone 'thigh'"),
    "too few numbers": ("thigh 40 50", "thigh 40", "01_02.amc:10: 1 numbers, expected 2"),
    "too many numbers": ("toe -60", "toe -60 1", "01_02.amc:11: 2 numbers, expected 1"),
    "numbers for a rigid bone": ("toe -60", "hip 1\ntoe -60", "for bone 'hip'"),
    "NaN": ("thigh 40 50", "thigh nan 50", "01_02.amc:10"),
    "infinite": ("thigh 40 50", "thigh 40 1e999", "01_02.amc:10"),
    "not a number": ("thigh 40 50", "thigh 40 x", "01_02.amc:10: 'x' is not a number"),
    "frame left out": ("\n2\n", "\n3\n", "01_02.amc:8: frame number 3, expected 2"),
    "frame again": ("\n2\n", "\n1\n", "01_02.amc:8: frame number 1, expected 2"),
    "absurd frame": ("\n2\n", "\n" + "9" * 400 + "\n", "01_02.amc:8"),
    "bone before the first frame": ("\n1\n", "\n", "01_02.amc:4: 'root'"),
    "unknown flag": (":DEGREES", ":TURNS", "01_02.amc:3"),
    "flag against the skeleton": (":DEGREES", ":RADIANS", "01_02.amc:3"),
    "no frames": (AMC[AMC.index("1\n") :], "", "no frames"),
}


@pytest.mark.parametrize(("old", "new", "said"), BAD_AMC.values(), ids=BAD_AMC.keys())
def test_bad_motion_is_refused_with_its_place(tmp_path: Path, old: str, new: str, said: str):
    assert old in AMC
    with pytest.raises(InputError, match=said):
        read_texts(tmp_path, amc=AMC.replace(old, new, 1))


def test_missing_skeleton_and_unknown_extension_are_refused(tmp_path: Path):
    (tmp_path / "02_01.amc").write_text(AMC)
    with pytest.raises(InputError, match=r"02_01.amc: has no skeleton beside it, expected 02.asf or 02_01.asf"):
        read_capture(tmp_path / "02_01.amc")
    with pytest.raises(InputError, match=r"extension '.c3d', expected one of .bvh, .amc"):
        read_capture(tmp_path / "walk.c3d")


def test_another_frame_rate_can_be_given(tmp_path: Path):
    read_texts(tmp_path)
    assert read_amc(tmp_path / "01_02.amc", read_asf(tmp_path / "01.asf"), fps=60.0).fps == 60.0


@given(st.sampled_from([0, 1]), st.integers(0, len(ASF)), st.integers(0, 8), st.binary(max_size=8))
@settings(max_examples=250, deadline=None)
def test_mutated_files_give_a_clip_or_an_input_error(
    tmp_path_factory: pytest.TempPathFactory, which: int, place: int, removed: int, added: bytes
):
    texts = [ASF.encode(), AMC.encode()]
    place %= len(texts[which]) + 1
    texts[which] = texts[which][:place] + added + texts[which][place + removed :]
    folder = tmp_path_factory.getbasetemp()
    (folder / "01.asf").write_bytes(texts[0])
    (folder / "01_02.amc").write_bytes(texts[1])
    try:
        clip = read_capture(folder / "01_02.amc")
    except InputError:
        return
    assert np.isfinite(clip_places(clip)[0]).all()


@given(st.integers(0, len(AMC)))
@settings(max_examples=40, deadline=None)
def test_truncated_motion_is_refused_or_ends_with_a_whole_frame(tmp_path_factory: pytest.TempPathFactory, length: int):
    folder = tmp_path_factory.getbasetemp()
    try:
        clip = read_texts(folder, amc=AMC[:length])
    except InputError:
        return
    assert clip.frame_count in (1, 2)
