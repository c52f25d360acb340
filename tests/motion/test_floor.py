import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT, FEET, default_body, rest_height
from footwork.motion.floor_plane import level_floor
from footwork.motion.grounding import ball_places, heights_above_rest, lay_feet
from footwork.motion.kinematics import forward
from footwork.motion.quaternion import IDENTITY

BODY = default_body()
REST, _ = forward(BODY, [0.0, rest_height(BODY), 0.0], np.tile(IDENTITY, (BODY.joint_count, 1)))


def hopping_in_rest_pose(steps=6, length=0.6):
    """The body in its T pose, gliding from stance to stance: half a second still, a quarter on the way."""
    stance, way = 15, 8
    z = np.concatenate(
        [np.r_[np.full(stance, k * length), k * length + length * np.arange(way) / way] for k in range(steps)]
    )
    lift = np.concatenate([np.r_[np.zeros(stance), 0.1 * np.sin(np.pi * np.arange(way) / way)] for _ in range(steps)])
    places = REST + np.stack([0.0 * z, lift, z], axis=-1)[:, None]
    turns = np.tile(IDENTITY, (*places.shape[:2], 1))
    still = np.concatenate([np.r_[np.ones(stance, bool), np.zeros(way, bool)] for _ in range(steps)])
    return places, turns, still


@pytest.mark.parametrize("slope", [-0.03, -0.01, 0.0, 0.02])
@pytest.mark.parametrize("yaw", [0.0, 0.7, 2.5])
def test_a_tilted_capture_is_turned_level(slope, yaw):
    places, turns, still = hopping_in_rest_pose()
    tilt = quaternion.multiply(quaternion.from_yaw(yaw), quaternion.from_rotation_vector([-np.arctan(slope), 0.0, 0.0]))
    captured = np.add(quaternion.rotate(tilt, places), [3.0, 0.4, -8.0])
    levelled, rotations = level_floor(BODY, captured, quaternion.multiply(tilt, turns), 30.0)
    heights = levelled[still][:, FEET, 1] - REST[FEET, 1]
    assert np.abs(heights).max() < 0.01
    assert np.degrees(np.linalg.norm(quaternion.to_rotation_vector(rotations[:, 0])[:, [0, 2]], axis=-1)).max() < 0.2


def test_levelling_moves_the_body_as_one():
    places, turns, _ = hopping_in_rest_pose()
    places[..., 1] += 0.02 * places[..., 2]
    levelled, _ = level_floor(BODY, places, turns, 30.0)
    spread = np.linalg.norm(places[:, :, None] - places[:, None], axis=-1)
    assert np.allclose(np.linalg.norm(levelled[:, :, None] - levelled[:, None], axis=-1), spread)


def test_feet_held_still_in_the_air_are_no_floor():
    places, turns, still = hopping_in_rest_pose()
    places[40:55, FEET[0], 1] += 0.5
    levelled, _ = level_floor(BODY, places, turns, 30.0)
    standing = still.copy()
    standing[40:55] = False
    assert np.abs(levelled[standing][:, FEET, 1] - REST[FEET, 1]).max() < 0.01


def test_a_standing_foot_is_left_alone_and_a_flying_one_too():
    for lift in (0.0, 0.3):
        places = np.tile(np.add(REST, [0.0, lift, 0.0]), (4, 1, 1))
        turns = np.tile(IDENTITY, (4, BODY.joint_count, 1))
        ankles, laid = lay_feet(BODY, places, turns)
        assert np.allclose(ankles, places[:, FEET[:, 0]], atol=1.5e-3)
        assert np.abs(np.abs(laid[..., 3]) - 1.0).max() < 1e-3


@pytest.mark.parametrize("pitch", [0.1, 0.3, 0.6, 1.0])
@pytest.mark.parametrize("ankle", [-0.03, 0.0, 0.02, 0.05, 0.1])
def test_no_part_of_a_foot_stays_under_the_floor_and_balls_keep_their_spot(pitch, ankle):
    places = np.tile(REST, (2, 1, 1))
    turns = np.tile(IDENTITY, (2, BODY.joint_count, 1))
    places[:, FEET[:, 0], 1] += ankle
    feet = quaternion.from_rotation_vector([pitch, 0.0, 0.0])
    turns[:, FEET] = feet
    places[:, FEET[:, 1]] = ball_places(BODY, places, turns)
    ankles, laid = lay_feet(BODY, places, turns)
    moved = places.copy()
    moved[:, FEET[:, 0]] = ankles
    balls = ball_places(BODY, moved, laid)
    ankle_heights, ball_heights = heights_above_rest(BODY, moved, laid)
    assert ball_heights.min() > -0.0035
    assert ankle_heights.min() > -0.0101
    assert (balls[..., 1] + quaternion.rotate(laid[:, FEET[:, 1]], BODY.ends[FEET[:, 1]])[..., 1]).min() > 0.005
    assert np.allclose(balls[..., [0, 2]], places[:, FEET[:, 1]][..., [0, 2]], atol=1e-9)


def test_longer_captured_feet_keep_flat_ankles_and_planted_balls():
    turns = np.tile(IDENTITY, (40, BODY.joint_count, 1))
    pitch = np.linspace(0.0, 0.9, 40)
    turns[:, FEET[:, 0]] = quaternion.from_rotation_vector(pitch[:, None] * [1.0, 0.0, 0.0])[:, None]
    longer = BODY.offsets[FEET[:, 1]] + [0.0, 0.0, 0.02]
    places = np.tile(REST, (40, 1, 1))
    balls = places[0, FEET[:, 0]] + longer
    places[:, FEET[:, 1]] = balls
    places[:, FEET[:, 0]] = balls - quaternion.rotate(turns[:, FEET[:, 0]], longer)
    ankles, laid = lay_feet(BODY, places, turns)
    moved = places.copy()
    moved[:, FEET[:, 0]] = ankles
    found = ball_places(BODY, moved, laid)
    assert np.allclose(ankles[0], REST[FEET[:, 0]], atol=2e-3)
    assert np.ptp(found[..., [0, 2]], axis=0).max() < 2e-3
    assert np.allclose(found[0, :, 1], BALL_HEIGHT, atol=2e-3)
