"""Our readers and kinematics against a second reading of every captured file, and against a written copy."""

from pathlib import Path

import numpy as np
import pytest

from footwork.motion.bvh import read_bvh, write_bvh
from footwork.motion.capture import read_capture
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.motion.quaternion import rotate
from plain_motion_reader import plain_places
from shared_data import MOTIONS, needs_motions

FILES = sorted([*MOTIONS.glob("*/*.bvh"), *MOTIONS.glob("*/*.amc")])


def places_by_name(clip: Clip) -> dict[str, np.ndarray]:
    places, turns = clip_places(clip)
    tips = places + rotate(turns, clip.skeleton.ends)
    named = {name: places[:, joint] for joint, name in enumerate(clip.skeleton.names)}
    with_tip = np.flatnonzero(clip.skeleton.ends.any(axis=1))
    return named | {f"{clip.skeleton.names[joint]} tip": tips[:, joint] for joint in with_tip}


@needs_motions
@pytest.mark.parametrize("path", FILES, ids=[path.name for path in FILES])
def test_joint_places_are_those_of_a_plain_second_reading(path: Path):
    ours, plain = places_by_name(read_capture(path)), plain_places(path)
    assert len([name for name in ours if name in plain]) == len(ours)
    assert max(np.abs(ours[name] - plain[name]).max() for name in ours) < 1e-6


@needs_motions
@pytest.mark.parametrize("name", ["dataset3/Male1_C03_Run.bvh", "dataset1/07_11.amc"])
def test_capture_written_as_bvh_and_read_again_is_the_same_motion(tmp_path: Path, name: str):
    clip = read_capture(MOTIONS / name)
    write_bvh(tmp_path / "copy.bvh", clip)
    again = read_bvh(tmp_path / "copy.bvh")
    before, after = places_by_name(clip), places_by_name(again)
    assert again.fps == clip.fps
    assert before.keys() == after.keys()
    assert max(np.abs(before[joint] - after[joint]).max() for joint in before) < 1e-4
