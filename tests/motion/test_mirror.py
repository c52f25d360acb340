from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.capture import read_capture
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.motion.mirror import mirrored
from footwork.motion.name_table import table_for
from footwork.motion.retarget import common_body_of, onto_common_body
from shared_data import MOTIONS, needs_motions
from toy_graphs import wandering_clip

RANDOM = np.random.default_rng(1)
PLAIN = wandering_clip(3)
CLIP = replace(
    PLAIN,
    contacts=RANDOM.random((PLAIN.frame_count, 2)) < 0.5,
    labels=RANDOM.choice(["walk", "jump"], PLAIN.frame_count),
)
BODY = CLIP.skeleton
OTHER = [
    name.replace("left_", "L").replace("right_", "left_").replace("L", "right_") if "_" in name else name
    for name in BODY.names
]


def same(one: Clip, other: Clip) -> bool:
    names = ("root_position", "rotations", "contacts", "labels")
    return one.name == other.name and all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)


def test_twice_mirrored_is_the_clip():
    assert same(mirrored(mirrored(CLIP)), CLIP)
    assert not same(mirrored(CLIP), CLIP)


def test_joints_are_where_a_mirror_shows_those_of_the_other_side():
    places, image = clip_places(CLIP)[0], clip_places(mirrored(CLIP))[0]
    np.testing.assert_allclose(image, places[:, BODY.indices(OTHER)] * [-1.0, 1.0, 1.0], atol=1e-12)


def test_facing_is_negated():
    before, after = (facing_yaw(BODY, clip_places(clip)[0]) for clip in (CLIP, mirrored(CLIP)))
    np.testing.assert_allclose(np.sin(after + before), 0.0, atol=1e-12)
    assert np.abs(before).max() > 0.5


def test_contacts_change_feet_and_labels_stay():
    image = mirrored(CLIP)
    np.testing.assert_array_equal(image.contacts, CLIP.contacts[:, ::-1])
    np.testing.assert_array_equal(image.labels, CLIP.labels)
    assert image.name == "wander3 (mirrored)"


def test_joints_that_move_apart_are_mirrored_too():
    shifts = BODY.offsets + RANDOM.normal(0.0, 0.02, (CLIP.frame_count, BODY.joint_count, 3))
    clip = replace(CLIP, translations=shifts)
    places, image = clip_places(clip)[0], clip_places(mirrored(clip))[0]
    np.testing.assert_allclose(image, places[:, BODY.indices(OTHER)] * [-1.0, 1.0, 1.0], atol=1e-12)


def without_right(name: str) -> str:
    return name.replace("right_hand", "third_hand")


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"offsets": BODY.offsets + np.eye(BODY.joint_count)[:, [9]] * 0.01}, "no mirror image of"),
        ({"masses": BODY.masses + np.eye(BODY.joint_count)[9]}, "no mirror image of"),
        ({"names": tuple(map(without_right, BODY.names))}, "'left_hand' has none on the other side"),
        ({"feet": BODY.feet[:1]}, "its feet are left_foot"),
    ],
)
def test_a_body_that_is_not_its_own_mirror_image_is_refused(change, problem):
    lame = replace(BODY, **change)
    contacts = CLIP.contacts[:, : len(lame.feet)]
    with pytest.raises(InputError, match=problem):
        mirrored(replace(CLIP, skeleton=lame, contacts=contacts))


@needs_motions
def test_the_common_body_of_real_people_is_its_own_mirror_image():
    captured = [read_capture(MOTIONS / "dataset1" / name) for name in ("07_01.amc", "07_08.amc")]
    body = common_body_of(captured)
    clip = onto_common_body(captured[0], body, table_for(captured[0].skeleton))
    image = mirrored(clip)
    assert image.skeleton is clip.skeleton
    others = body.indices(OTHER)
    np.testing.assert_allclose(clip_places(image)[0], clip_places(clip)[0][:, others] * [-1.0, 1.0, 1.0], atol=1e-12)
