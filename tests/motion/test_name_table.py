from pathlib import Path

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import NAMES
from footwork.motion.name_table import built_in_tables, frame_of, read_name_table, table_for
from footwork.motion.skeleton import Skeleton

HEAD = 'name = "mine"\nattribution = "me"\nrecognise = ["hips"]\n'


def table_text(head=HEAD, **changed):
    rules = {name: f'"{name}"' for name in NAMES} | changed
    return head + "[joints]\n" + "\n".join(f"{name} = {rule}" for name, rule in rules.items() if rule)


def written(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(text)
    return path


def skeleton_of(names):
    return Skeleton(names, np.arange(-1, len(names) - 1, dtype=np.int32), np.zeros((len(names), 3)), where="walk.bvh")


def test_rules_are_read(tmp_path):
    text = table_text(
        spine='{ turn = "spine", place = ["hips", "chest:end"] }',
        left_hand='{ turn = "left_hand", left = [1, 0, 0], forward = [0, 0.5, 2] }',
    )
    table = read_name_table(written(tmp_path, text))
    assert (table.name, table.attribution, table.recognise) == ("mine", "me", ("hips",))
    assert table.joints["spine"].place == ("hips", "chest:end")
    assert table.joints["left_hand"].axes == {"left": (1.0, 0.0, 0.0), "forward": (0.0, 0.5, 2.0)}
    assert table.joints["head"].place == ("head",)
    assert np.allclose(table.world, quaternion.IDENTITY)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name = ", "is not TOML"),
        ("a = " + "[" * 5000, "is not TOML"),
        (table_text(HEAD + "colour = 1\n"), "unknown key 'colour', expected name"),
        (table_text('recognise = ["hips"]\n'), "name is missing, expected a text"),
        (table_text('name = "mine"\nrecognise = [3]\n'), "recognise is .* expected a list of joint names"),
        (table_text('name = "mine"\nrecognise = []\n'), "expected a list of joint names"),
        (table_text(HEAD + "up = [0, 1]\n"), "up is .* expected a direction"),
        (table_text(HEAD + "up = [0, nan, 1]\n"), "expected a direction"),
        (table_text(HEAD + "up = [0, 1e999, 1]\n"), "expected a direction"),
        (table_text(HEAD + "up = [true, 0, 0]\n"), "expected a direction"),
        (table_text(HEAD + "up = [0, 0, 0]\n"), "expected a direction"),
        (table_text(HEAD + "up = [0, 0, -2]\n"), "up and forward are parallel"),
        (HEAD, "joints is missing"),
        (HEAD + "joints = 3", "joints is 3"),
        (table_text(chest=""), "joints lacks chest"),
        (table_text(tail='"tail"'), "joints: unknown key 'tail'"),
        (table_text(chest="7"), "joints.chest: 7, expected a joint name"),
        (table_text(chest="{ place = ['a'] }"), "joints.chest: turn is missing"),
        (table_text(chest="{ turn = 'a', place = 'a' }"), "joints.chest: place is 'a'"),
        (table_text(chest="{ turn = 'a', colour = 'a' }"), "joints.chest: unknown key 'colour'"),
        (table_text(chest="{ turn = 'a', up = [0, 1, 0] }"), "joints.chest: gives one of"),
        (table_text(chest="{ turn = 'a', up = [0, 1, 0], left = [0, 2, 0] }"), "joints.chest: .* parallel"),
        (
            table_text(chest="{ turn = 'a', up = [0, 1, 0], left = [1, 0, 0], forward = [0, 0, 1] }"),
            "joints.chest: gives left, up and forward",
        ),
    ],
)
def test_a_bad_table_names_file_and_key(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(InputError, match=message) as caught:
        read_name_table(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_files_that_are_no_text_are_refused(tmp_path):
    path = tmp_path / "mine.toml"
    for data in (b"\xff\xfe\x00", b"#" * (1 << 21)):
        path.write_bytes(data)
        with pytest.raises(InputError, match=r"mine\.toml"):
            read_name_table(path)
    for missing in (tmp_path / "none.toml", tmp_path, "a\0b"):
        with pytest.raises(InputError, match="cannot be read"):
            read_name_table(missing)


def test_the_common_body_and_the_first_fitting_table_are_found(tmp_path):
    own = read_name_table(written(tmp_path, table_text()))
    assert table_for(skeleton_of(NAMES)).name == "common body"
    assert table_for(skeleton_of(NAMES), [own]) is own


def test_a_skeleton_that_no_table_fits_learns_what_is_missing():
    names = tuple(name for name in NAMES if name != "left_toes")
    with pytest.raises(InputError, match=r"walk\.bvh: no name table fits.*nearest is common body.*left_toes"):
        table_for(skeleton_of(names))


def test_the_tables_that_come_along_carry_what_their_licences_ask():
    texts = {table.name: table.attribution for table in built_in_tables()}
    assert "mocap.cs.cmu.edu" in texts["CMU"]
    assert "CC BY 3.0" in texts["ACCAD"]


@pytest.mark.parametrize("pair", [("left", "up"), ("up", "forward"), ("forward", "left"), ("forward", "up")])
def test_a_frame_meets_its_first_axis_and_leans_to_its_second(pair):
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=(2, 3))
    frame = frame_of(dict(zip(pair, (a, b), strict=True)))
    unit = dict(zip(("left", "up", "forward"), np.eye(3), strict=True))
    first, second = (quaternion.rotate(frame, unit[axis]) for axis in pair)
    assert np.allclose(first, a / np.linalg.norm(a))
    assert np.dot(second, b) > 0.0
    assert np.allclose(np.dot(second, np.cross(a, b)), 0.0)


def test_the_example_of_the_documentation_is_a_table(tmp_path):
    page = Path(__file__).resolve().parents[2] / "docs" / "bring-your-own-skeleton.md"
    example = page.read_text().split("```toml\n")[1].split("```")[0]
    table = read_name_table(written(tmp_path, example))
    assert table.name == "studio"
    assert np.allclose(quaternion.rotate(table.world, [0.0, 0.0, 1.0]), [0.0, 1.0, 0.0])
    assert np.allclose(quaternion.rotate(table.world, [0.0, -1.0, 0.0]), [0.0, 0.0, 1.0])
    names = tuple(name for name in table.missing(skeleton_of(("hips",))))
    assert table_for(skeleton_of(names), [table]) is table
