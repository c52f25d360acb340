from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT, FEET, NAMES, default_body, rest_height
from footwork.motion.clip import Clip
from footwork.motion.ik import leg, place_limb
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.name_table import read_name_table, table_for
from footwork.motion.retarget import common_body_of, onto_common_body
from footwork.motion.skeleton import Skeleton

SIDES = ("left", "right")


def swaying_clip(frames=60, seed=3):
    """The default body standing on planted feet, hips, trunk and arms swaying smoothly with bent knees."""
    body, rng = default_body(), np.random.default_rng(seed)
    time = np.arange(frames) / 30.0
    phases = rng.uniform(0.0, 6.0, size=(body.joint_count, 3))
    vectors = 0.25 * rng.normal(size=(body.joint_count, 3)) * np.sin(4.0 * time[:, None, None] + phases)
    legs = [body.index(f"{side}_{part}") for side in SIDES for part in ("thigh", "shank", "foot", "toes")]
    vectors[:, legs] = 0.0
    vectors[:, 0] *= 0.5
    rotations = quaternion.from_rotation_vector(vectors)
    height = rest_height(body)
    root = np.stack([0.05 * np.sin(2.0 * time), height - 0.1 - 0.04 * np.cos(time), 0.06 * np.sin(time)], axis=-1)
    rest, _ = forward(body, [0.0, height, 0.0], np.tile(quaternion.IDENTITY, (body.joint_count, 1)))
    for side in SIDES:
        limb = leg(body, side)
        rotations = place_limb(body, root, rotations, limb, rest[limb.tip])
        _, turns = forward(body, root, rotations)
        rotations[:, limb.tip] = quaternion.conjugate(turns[:, limb.lower])  # the sole level, toes ahead
    return Clip("sway", body, 30.0, root, rotations, labels=np.full(frames, "idle"))


def disguised(clip, scale, seed=7, own_axes=True):
    """``clip`` on a renamed, rescaled skeleton whose world is z up and whose joints have axes of their own.

    Returns the clip, the body's up and forward at rest in each joint's own frame, and both in the file's world.
    """
    rng = np.random.default_rng(seed)
    body = clip.skeleton
    to_world = np.array([0.5, 0.5, 0.5, 0.5])  # x -> y, y -> z, z -> x
    own = np.tile(to_world, (body.joint_count, 1))  # body rest axes -> joint's own axes
    if own_axes:
        own = quaternion.normalise(rng.normal(size=own.shape))
    back = quaternion.conjugate(own)
    parents = body.parents
    places, turns = clip_places(clip)
    world = quaternion.multiply(quaternion.multiply(to_world, turns), back)
    local = world.copy()
    local[:, 1:] = quaternion.multiply(quaternion.conjugate(world[:, parents[1:]]), world[:, 1:])
    offsets = scale * quaternion.rotate(own[parents], body.offsets)
    offsets[0] = 0.0
    skeleton = Skeleton(tuple(f"bone_{name}" for name in NAMES), parents, offsets, where="disguise")
    root = scale * quaternion.rotate(to_world, places[:, 0])
    copy = Clip("disguise", skeleton, clip.fps, root, local, labels=clip.labels)
    axes = {axis: quaternion.rotate(own, vector) for axis, vector in (("up", [0, 1, 0]), ("forward", [0, 0, 1]))}
    world_axes = {
        axis: quaternion.rotate(to_world, vector) for axis, vector in (("up", [0, 1, 0]), ("forward", [0, 0, 1]))
    }
    return copy, axes, world_axes


def written_table(path, axes, world_axes):
    lines = ['name = "disguise"', 'attribution = "nobody"', 'recognise = ["bone_hips", "bone_left_toes"]']
    lines += [f"{axis} = {vector.tolist()}" for axis, vector in world_axes.items()]
    lines += ["[joints]"]
    for joint, name in enumerate(NAMES):
        if axes is None:
            lines.append(f'{name} = "bone_{name}"')
            continue
        up, forward = (axes[axis][joint].tolist() for axis in ("up", "forward"))
        lines.append(f'{name} = {{ turn = "bone_{name}", up = {up}, forward = {forward} }}')
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("scale", [1.0, 0.3, 39.37])
def test_a_disguised_copy_comes_back_as_the_same_motion(tmp_path, scale):
    clip = swaying_clip()
    copy, axes, world_axes = disguised(clip, scale)
    assert_comes_back(clip, copy, read_name_table(written_table(tmp_path / "mine.toml", axes, world_axes)))


def test_a_skeleton_with_a_t_pose_at_rest_needs_no_axes_whatever_its_world(tmp_path):
    clip = swaying_clip()
    copy, _, world_axes = disguised(clip, 1.0, own_axes=False)
    assert_comes_back(clip, copy, read_name_table(written_table(tmp_path / "mine.toml", None, world_axes)))


def assert_comes_back(clip, copy, table):
    assert table_for(copy.skeleton, [table]) is table
    back = onto_common_body(copy, default_body(), table)
    wanted, _ = clip_places(clip)
    found, _ = clip_places(back)
    assert np.allclose(found, wanted, atol=2e-3)
    turned = 2.0 * np.arccos(np.clip(np.abs(np.sum(back.rotations * clip.rotations, axis=-1)), 0.0, 1.0))
    assert np.degrees(turned).max() < 1.0
    assert back.contacts.all()
    assert back.labels.tolist() == clip.labels.tolist()


def test_the_common_body_is_found_again_from_a_copy(tmp_path):
    clip = swaying_clip()
    copy, axes, world_axes = disguised(clip, 1.0)
    table = read_name_table(written_table(tmp_path / "mine.toml", axes, world_axes))
    body = common_body_of([copy], [table])
    assert np.allclose(body.offsets, default_body().offsets, atol=1e-9)
    assert np.allclose(body.ends, default_body().ends, atol=1e-9)


def test_two_people_make_their_mean_however_many_clips_each():
    small, tall = default_body(), default_body()
    tall = Skeleton(NAMES, tall.parents, 1.2 * tall.offsets, feet=FEET)
    clip = swaying_clip(10)
    clips = [Clip("a", small, 30.0, clip.root_position, clip.rotations)] * 3
    clips += [Clip("b", tall, 30.0, clip.root_position, clip.rotations)]
    assert np.allclose(common_body_of(clips).offsets, 1.1 * small.offsets)


def test_travel_scales_with_the_legs():
    clip, mapped = swaying_clip(), []
    for size in (0.8, 1.25):
        other = Skeleton(NAMES, clip.skeleton.parents, size * clip.skeleton.offsets, feet=FEET)
        source = Clip("other", other, 30.0, size * clip.root_position, clip.rotations)
        mapped.append(onto_common_body(source, default_body(), table_for(other)))
    assert np.allclose(clip_places(mapped[0])[0], clip_places(mapped[1])[0], atol=1e-9)


def test_motion_of_the_body_itself_comes_back_as_it_was_and_is_put_on_the_floor_where_it_floats():
    other = Skeleton(NAMES, default_body().parents, 1.25 * default_body().offsets, feet=FEET)
    clip = swaying_clip()
    source = Clip("other", other, 30.0, 1.25 * clip.root_position, clip.rotations)
    once = onto_common_body(source, default_body(), table_for(other))
    again = onto_common_body(once, default_body(), table_for(once.skeleton))
    assert np.array_equal(again.root_position, once.root_position)
    assert np.allclose(clip_places(again)[0], clip_places(once)[0], atol=1e-12)
    assert np.array_equal(again.contacts, once.contacts)
    floating = replace(once, root_position=once.root_position + np.array([0.0, 0.5, 0.0]))
    landed = onto_common_body(floating, default_body(), table_for(once.skeleton))
    assert np.abs(landed.root_position - once.root_position).max() < 0.02


def test_a_standing_body_stands_at_its_rest_height_wherever_the_floor_was():
    body = default_body()
    rotations = np.tile(quaternion.IDENTITY, (30, body.joint_count, 1))
    clip = Clip("stand", body, 30.0, np.tile([1.0, 7.0, 2.0], (30, 1)), rotations)
    places, _ = clip_places(onto_common_body(clip, body, table_for(body)))
    assert np.allclose(places[:, FEET[:, 1], 1], BALL_HEIGHT, atol=1e-3)
    assert np.allclose(places[:, 0], [1.0, rest_height(body), 2.0], atol=2e-3)


def test_no_clips_and_legs_without_length_are_refused():
    with pytest.raises(InputError, match="no clips"):
        common_body_of([])
    clip = swaying_clip(5)
    offsets = np.array(clip.skeleton.offsets)
    for part, message in (("shank", None), ("foot", "legs have no length"), ("toes", "expected a foot that points")):
        offsets[clip.skeleton.indices([f"left_{part}", f"right_{part}"])] = 0.0
        short = Skeleton(NAMES, clip.skeleton.parents, offsets)
        if message:
            source = Clip("short", short, 30.0, clip.root_position, clip.rotations)
            with pytest.raises(InputError, match=message):
                onto_common_body(source, default_body(), table_for(short))
