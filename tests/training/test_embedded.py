from functools import cache

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.training.embedded import embedded_clips

LABELS = {"idle", "walk", "turn", "run", "jump", "duck", "pick"}


@cache
def clips() -> dict[str, Clip]:
    return {clip.name: clip for clip in embedded_clips()}


NAMES = sorted(clips())


def test_every_behaviour_is_there_and_every_frame_has_one():
    found = set()
    for clip in clips().values():
        assert clip.fps == 30
        found |= set(clip.labels.tolist())
    assert found == LABELS


def test_the_same_clips_come_out_every_time():
    again = {clip.name: clip for clip in embedded_clips()}
    assert list(again) == list(clips())
    for name, clip in clips().items():
        assert again[name].rotations.tobytes() == clip.rotations.tobytes()
        assert again[name].root_position.tobytes() == clip.root_position.tobytes()


@pytest.mark.parametrize("name", NAMES)
def test_knees_bend_one_way_only(name):
    clip = clips()[name]
    for side in ("left", "right"):
        bend = np.degrees(quaternion.to_rotation_vector(clip.rotations[:, clip.skeleton.index(f"{side}_shank")]))
        assert bend[:, 0].min() > -1.0
        assert bend[:, 0].max() < 150.0
        assert np.abs(bend[:, 1:]).max() < 1.0


@pytest.mark.parametrize("name", NAMES)
def test_feet_never_sink_into_the_floor(name):
    clip = clips()[name]
    places, turns = clip_places(clip)
    balls = clip.skeleton.feet[:, 1]
    tips = places[:, balls] + quaternion.rotate(turns[:, balls], clip.skeleton.ends[balls])
    assert tips[..., 1].min() > -0.01
    assert places[:, clip.skeleton.feet, 1].min() > -0.01
