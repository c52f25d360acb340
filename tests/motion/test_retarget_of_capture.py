"""Real capture on the common body: as close to the people as lengths allow, feet on the floor, nothing twisted."""

from functools import cache

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT, FEET, NAMES
from footwork.motion.capture import read_capture
from footwork.motion.grounding import heights_above_rest
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.motion.name_table import table_for
from footwork.motion.resample import resample
from footwork.motion.retarget import captured_places, common_body_of, floors_of, onto_common_body
from shared_data import MOTIONS, needs_motions

pytestmark = needs_motions

PEOPLE = {  # one person each
    "dataset1": ("07_01.amc", "07_08.amc"),
    "dataset3": ("Male1_B3_Walk.bvh", "Male1_B18_Walk2Leap2Walk.bvh", "Male1_A7_Crouch.bvh"),
    "fighting": ("135_07.amc",),
}
WALKS = [("dataset1", "07_01.amc"), ("dataset1", "07_08.amc"), ("dataset3", "Male1_B3_Walk.bvh")]
CLIPS = [(folder, name) for folder, names in PEOPLE.items() for name in names]
FOUR = [("dataset2", name) for name in ("02_01.amc", "05_01.amc", "35_12.amc", "49_01.amc")]
SIDES = ("left", "right")


@cache
def source_clip(folder, name):
    return resample(read_capture(MOTIONS / folder / name))


@cache
def body_of(folder):
    names = [name for where, name in CLIPS + FOUR if where == folder]
    return common_body_of([source_clip(folder, name) for name in names])


@cache
def mapped(folder, name):
    """The mapped clip, its places and rotations, and where the captured joints were."""
    source, body = source_clip(folder, name), body_of(folder)
    table = table_for(source.skeleton)
    clip = onto_common_body(source, body, table)
    return clip, *clip_places(clip), captured_places(source, body, table)


def planted_slide(places, contacts, fps):
    """Mean level speed in cm/s of the lower point of each foot while it stands."""
    speeds = np.linalg.norm(np.diff(places[:, FEET][..., [0, 2]], axis=0), axis=-1) * fps
    lower = places[1:, FEET, 1].argmin(axis=-1)[..., None]
    on = contacts[1:] & contacts[:-1]
    return 100.0 * np.take_along_axis(speeds, lower, axis=-1)[..., 0][on].mean()


@pytest.mark.parametrize(("folder", "name"), CLIPS)
def test_one_person_keeps_their_joints(folder, name):
    _, places, _, captured = mapped(folder, name)
    errors = np.linalg.norm(places - captured, axis=-1)
    assert errors.mean() < 0.013
    toes = FEET[:, 1]  # raised by up to 10 cm where captured toes go through the floor
    assert np.delete(errors, toes, axis=1).max() < 0.10
    wrists = errors[:, [NAMES.index("left_hand"), NAMES.index("right_hand")]]
    assert np.percentile(wrists, 95) < 0.04


@pytest.mark.parametrize(("folder", "name"), CLIPS + FOUR)
def test_planted_feet_slide_no_more_than_captured_ones(folder, name):
    clip, places, _, captured = mapped(folder, name)
    assert clip.contacts.any(axis=0).all()
    ours, theirs = (planted_slide(points, clip.contacts, clip.fps) for points in (places, captured))
    assert ours < theirs + 0.2


@pytest.mark.parametrize(("folder", "name"), CLIPS + FOUR)
def test_standing_feet_are_on_the_floor_and_no_ball_is_under_it(folder, name):
    clip, places, turns, _ = mapped(folder, name)
    heights = np.minimum(*heights_above_rest(clip.skeleton, places, turns))[clip.contacts]
    assert abs(np.median(heights)) < 0.006
    assert np.mean(np.abs(heights) < 0.02) > 0.96
    assert places[:, FEET[:, 1], 1].min() > BALL_HEIGHT - 0.02


@pytest.mark.parametrize(("folder", "name"), CLIPS + FOUR)
def test_knees_and_elbows_bend_the_right_way(folder, name):
    _, places, turns, _ = mapped(folder, name)
    for limb, way in ((("thigh", "shank", "foot"), -1.0), (("upper_arm", "forearm", "hand"), 1.0)):
        for side in SIDES:
            upper, lower, tip = (NAMES.index(f"{side}_{part}") for part in limb)
            bone = places[:, tip] - places[:, lower]
            own = (
                quaternion.rotate(quaternion.conjugate(turns[:, upper]), bone) / np.linalg.norm(bone, axis=-1)[:, None]
            )
            bent = np.linalg.norm(own[:, [0, 2] if way < 0 else [1, 2]], axis=-1) > np.sin(np.radians(25.0))
            if bent.any():
                assert np.mean(way * own[bent, 2] > 0.0) > 0.98, (side, limb)


@pytest.mark.parametrize(("folder", "name"), WALKS + FOUR)
def test_walkers_face_the_way_they_go_head_up_toes_ahead_palms_in(folder, name):
    clip, places, turns, _ = mapped(folder, name)
    end = min(70, clip.frame_count)  # before any of them turns
    way = places[end - 1, 0] - places[0, 0]
    yaw = np.arctan2(way[0], way[2])
    ahead = np.array([np.sin(yaw), 0.0, np.cos(yaw)])
    left = np.array([np.cos(yaw), 0.0, -np.sin(yaw)])
    turned = np.angle(np.exp(1j * (facing_yaw(clip.skeleton, places[:end]) - yaw)))
    assert abs(np.degrees(np.mean(turned))) < 10.0
    for joint in ("hips", "spine", "chest", "head", "left_foot", "right_foot", "left_thigh", "right_shank"):
        forward = quaternion.rotate(turns[:end, NAMES.index(joint)], [0.0, 0.0, 1.0]).mean(axis=0)
        assert forward @ ahead > 0.6, joint
    for joint, least in (("hips", 0.9), ("spine", 0.9), ("chest", 0.9), ("neck", 0.85), ("head", 0.7)):
        assert quaternion.rotate(turns[:end, NAMES.index(joint)], [0.0, 1.0, 0.0])[:, 1].mean() > least, joint
    for side, inward in (("left", -left), ("right", left)):
        palm = quaternion.rotate(turns[:end, NAMES.index(f"{side}_hand")], [0.0, -1.0, 0.0]).mean(axis=0)
        assert palm @ inward > 0.3, side


@pytest.mark.parametrize(("folder", "name"), FOUR)
def test_gait_speed_scales_with_the_legs(folder, name):
    clip, places, _, _ = mapped(folder, name)
    source = source_clip(folder, name)
    bones = ("ltibia", "lfoot", "rtibia", "rfoot")
    theirs = sum(np.linalg.norm(source.skeleton.offsets[source.skeleton.index(bone)]) for bone in bones)
    ours = np.linalg.norm(
        clip.skeleton.offsets[clip.skeleton.indices([f"{s}_{p}" for s in SIDES for p in ("shank", "foot")])], axis=-1
    ).sum()
    ways = [np.linalg.norm(np.diff(root[[0, -1]][:, [0, 2]], axis=0)) for root in (places[:, 0], source.root_position)]
    assert ways[0] / ways[1] == pytest.approx(ours / theirs, rel=0.01)


def test_both_sources_share_a_body_of_human_size():
    clips = [source_clip("dataset1", "07_01.amc"), source_clip("dataset3", "Male1_B3_Walk.bvh")]
    body = common_body_of(clips)
    assert np.allclose(body.offsets[NAMES.index("left_shank")] * [-1, 1, 1], body.offsets[NAMES.index("right_shank")])
    legs = body.offsets[[NAMES.index("left_shank"), NAMES.index("left_foot")]]
    assert 0.75 < np.linalg.norm(legs, axis=-1).sum() < 0.95
    for clip in clips:
        moved = onto_common_body(clip, body, table_for(clip.skeleton))
        assert 0.75 < np.median(moved.root_position[:, 1]) < 1.15


def test_a_runner_runs_on_the_floor_the_walker_walks_on():
    runs = ("Male1_C01_StandToRun.bvh", "Male1_C03_Run.bvh", "Male1_C11_RunTurnLeft90.bvh")
    walks = ("Male1_B3_Walk.bvh", "Male1_B1_StandToWalk.bvh", "Male1_B9_WalkToTurnLeft90.bvh")
    clips = [source_clip("dataset3", name) for name in runs + walks]
    body, table = common_body_of(clips), table_for(clips[0].skeleton)
    together = [
        onto_common_body(clip, body, table, floor) for clip, floor in zip(clips, floors_of(clips, body), strict=True)
    ]
    for clip in together:
        ankles, balls = heights_above_rest(body, *clip_places(clip))
        assert abs(np.percentile(ankles, 2)) < 0.008, clip.name
        assert abs(np.percentile(balls, 2)) < 0.008, clip.name
    standing = [np.median(together[number].root_position[:25, 1]) for number in (0, 4, 5)]
    assert np.ptp(standing) < 0.012
    alone = onto_common_body(clips[0], body, table)
    assert alone.root_position[60:, 1].mean() - together[0].root_position[60:, 1].mean() > 0.03
