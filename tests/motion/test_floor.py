import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT, FEET, default_body, rest_height
from footwork.motion.floor_plane import Floor, Footing, floors_under, footing_of
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


def level_floor(places, turns):
    return floors_under([footing_of(BODY, places, turns, 30.0)])[0].level(places, turns)


def stances_on(floor, x, z, *, noise=0.0, seed=0):
    """Left and right feet in turn, standing at x and z on ``floor`` to within ``noise`` metres."""
    rng = np.random.default_rng(seed)
    heights = floor.height + floor.slope_x * x + floor.slope_z * z + noise * rng.normal(size=x.shape)
    return np.stack([x, z, heights, np.where(np.arange(x.size) % 2, 1.0, -1.0)], axis=-1)


def walk_on(floor, seed, count=14):
    rng = np.random.default_rng(seed)
    return Footing(0, stances_on(floor, *rng.uniform(-2.0, 2.0, size=(2, count)), noise=0.004, seed=seed))


def apart(one, other):
    """The greatest distance of two floors within three metres of the middle."""
    corners = np.array([[1.0, x, z] for x in (-3.0, 3.0) for z in (-3.0, 3.0)])
    first, second = (np.array([floor.height, floor.slope_x, floor.slope_z]) for floor in (one, other))
    return np.abs(corners @ (first - second)).max()


@pytest.mark.parametrize("slope", [-0.03, -0.01, 0.0, 0.02])
@pytest.mark.parametrize("yaw", [0.0, 0.7, 2.5])
def test_a_tilted_capture_is_turned_level(slope, yaw):
    places, turns, still = hopping_in_rest_pose()
    tilt = quaternion.multiply(quaternion.from_yaw(yaw), quaternion.from_rotation_vector([-np.arctan(slope), 0.0, 0.0]))
    captured = np.add(quaternion.rotate(tilt, places), [3.0, 0.4, -8.0])
    levelled, rotations = level_floor(captured, quaternion.multiply(tilt, turns))
    heights = levelled[still][:, FEET, 1] - REST[FEET, 1]
    assert np.abs(heights).max() < 0.01
    assert np.degrees(np.linalg.norm(quaternion.to_rotation_vector(rotations[:, 0])[:, [0, 2]], axis=-1)).max() < 0.2


def test_levelling_moves_the_body_as_one():
    places, turns, _ = hopping_in_rest_pose()
    places[..., 1] += 0.02 * places[..., 2]
    levelled, _ = level_floor(places, turns)
    spread = np.linalg.norm(places[:, :, None] - places[:, None], axis=-1)
    assert np.allclose(np.linalg.norm(levelled[:, :, None] - levelled[:, None], axis=-1), spread)


def test_feet_held_still_in_the_air_are_no_floor():
    places, turns, still = hopping_in_rest_pose()
    places[40:55, FEET[0], 1] += 0.5
    levelled, _ = level_floor(places, turns)
    standing = still.copy()
    standing[40:55] = False
    assert np.abs(levelled[standing][:, FEET, 1] - REST[FEET, 1]).max() < 0.01


def test_feet_that_never_pause_are_stood_on_their_lowest_frames():
    time = np.arange(60) / 30.0
    places = REST + np.stack([0.0 * time, 0.3 + 0.1 * np.cos(9.0 * time), 4.0 * time], axis=-1)[:, None]
    levelled, _ = level_floor(places, np.tile(IDENTITY, (60, BODY.joint_count, 1)))
    assert (levelled[:, FEET, 1] - REST[FEET, 1]).min() == pytest.approx(0.0, abs=0.002)


def test_runs_stand_on_the_floor_of_the_same_persons_walks():
    floor = Floor(0.012, -0.006, 0.03)
    deep = stances_on(floor, np.array([-2.0, -1.0, 2.0]), np.array([1.5, 1.0, -2.0])) - [0.0, 0.0, 0.055, 0.0]
    runs = [Footing(rank, deep) for rank in (0, 1, 2)]
    found = floors_under([*runs, *(walk_on(floor, seed) for seed in range(4))])
    assert max(apart(floor, own) for own in found) < 0.012
    assert apart(floor, *floors_under(runs[2:])) > 0.05  # by itself it is taken to stand where it pushed off


def test_one_persons_captures_share_slopes_and_differ_by_millimetres():
    floor = Floor(0.01, 0.02, -0.04)
    raised = Floor(0.01, 0.02, -0.03)
    found = floors_under([*(walk_on(floor, seed) for seed in range(5)), walk_on(raised, 9)])
    assert len({(own.slope_x, own.slope_z) for own in found}) == 1
    assert 0.004 < found[-1].height - np.mean([own.height for own in found[:-1]]) < 0.01


def test_a_capture_from_another_volume_has_a_floor_of_its_own():
    here, there = Floor(0.01, 0.0, 0.0), Floor(-0.015, 0.01, 0.6)
    alone = floors_under([walk_on(there, 7)])
    found = floors_under([*(walk_on(here, seed) for seed in range(3)), walk_on(there, 7)])
    assert found[-1:] == alone
    assert max(apart(here, own) for own in found[:3]) < 0.012


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
