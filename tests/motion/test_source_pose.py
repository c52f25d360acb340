import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.body import NAMES
from footwork.motion.clip import Clip
from footwork.motion.name_table import table_for
from footwork.motion.skeleton import Skeleton
from footwork.motion.source_pose import source_pose
from motion_samples import sample_clip


@pytest.mark.parametrize(("joint", "bone"), [("left_shank", "left_thigh"), ("right_foot", "right_shank")])
def test_a_bone_of_a_leg_without_length_is_refused_by_name(joint: str, bone: str):
    clip = sample_clip(0, 20)
    offsets = np.array(clip.skeleton.offsets)
    offsets[NAMES.index(joint)] = 0.0
    short = Clip("short.bvh", Skeleton(NAMES, clip.skeleton.parents, offsets), 30.0, clip.root_position, clip.rotations)
    with pytest.raises(InputError, match=rf"short.bvh: the legs have no length \({bone} in frame 0\)"):
        source_pose(short, table_for(short.skeleton))


def test_a_bone_that_vanishes_in_one_frame_is_refused_with_the_frame():
    clip = sample_clip(0, 20)
    translations = np.tile(clip.skeleton.offsets, (20, 1, 1))
    translations[7, NAMES.index("left_foot")] = 0.0
    gone = Clip("gone.bvh", clip.skeleton, 30.0, clip.root_position, clip.rotations, translations=translations)
    with pytest.raises(InputError, match=r"gone.bvh: the legs have no length \(left_shank in frame 7\)"):
        source_pose(gone, table_for(gone.skeleton))
