"""The known truth of the embedded motions: what a person's motion must obey, measured on the finished clips."""

import itertools
from functools import cache

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.contacts import detect_contacts
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.motion.metric import PointCloudMetric
from footwork.training.connectivity import largest_component
from footwork.training.embedded import embedded_clips, fighting_clips
from footwork.training.embedded.balance import centre_of_mass
from footwork.training.embedded.feet import SOLE
from footwork.training.standard_graph import edges_of
from footwork.training.transitions import local_minima

BODY = default_body()
LOCOMOTION_LABELS = {"idle", "walk", "turn", "run", "jump", "duck", "pick"}
FIGHTING_LABELS = {"locomotion", "attack", "evade"}
# degrees about x, y, z of a joint's frame: textbook ranges of motion, widened by some degrees
RANGES = {
    "spine": ((-15, 35), (-25, 25), (-20, 20)),
    "chest": ((-15, 35), (-25, 25), (-20, 20)),
    "neck": ((-35, 35), (-40, 40), (-25, 25)),
    "head": ((-35, 35), (-40, 40), (-25, 25)),
    "left_forearm": ((-1, 1), (-145, 0), (-1, 1)),
    "right_forearm": ((-1, 1), (0, 145), (-1, 1)),
    "left_thigh": ((-130, 40), (-45, 45), (-30, 45)),
    "right_thigh": ((-130, 40), (-45, 45), (-45, 30)),
    "left_shank": ((-1, 150), (-1, 1), (-1, 1)),
    "right_shank": ((-1, 150), (-1, 1), (-1, 1)),
    "left_foot": ((-45, 55), (-25, 25), (-30, 30)),
    "right_foot": ((-45, 55), (-25, 25), (-30, 30)),
    "left_toes": ((-75, 5), (-1, 1), (-1, 1)),
    "right_toes": ((-75, 5), (-1, 1), (-1, 1)),
}


@cache
def clips() -> dict[str, Clip]:
    named = {f"steer/{clip.name}": clip for clip in embedded_clips()}
    return named | {f"fight/{clip.name}": clip for clip in fighting_clips()}


every_clip = pytest.mark.parametrize("name", sorted(clips()))


def spans(flags: np.ndarray) -> list[tuple[int, int]]:
    """The runs of True, first frame and the one after the last."""
    edges = np.flatnonzero(np.diff(flags.astype(np.int8), prepend=0, append=0))
    return [(int(start), int(end)) for start, end in edges.reshape(-1, 2)]


def landings(clip: Clip) -> list[tuple[int, int, np.ndarray]]:
    """Frame, foot and place of the flat foot of every landing, in order."""
    balls = clip_places(clip)[0][:, BODY.feet[:, 1]]
    found = []
    for foot in (0, 1):
        found += [
            (start, foot, balls[(start + end) // 2, foot])
            for start, end in spans(clip.contacts[:, foot])
            if start > 0 and end < clip.frame_count
        ]
    return sorted(found, key=lambda landing: landing[:2])


def steady(name: str, label: str) -> list[tuple[float, float]]:
    """Seconds and metres of the steps between the first two and the last two landings under a label."""
    clip = clips()[name]
    steps = [landing for landing in landings(clip) if clip.labels[landing[0]] == label][2:-2]
    return [
        ((after[0] - before[0]) / clip.fps, float(np.hypot(*(after[2] - before[2])[[0, 2]])))
        for before, after in itertools.pairwise(steps)
    ]


def test_every_behaviour_is_there_and_every_frame_has_one():
    for kind, labels in (("steer", LOCOMOTION_LABELS), ("fight", FIGHTING_LABELS)):
        found = [clip.labels for name, clip in clips().items() if name.startswith(kind)]
        assert set(np.concatenate(found).tolist()) == labels
    assert all(clip.fps == 30 for clip in clips().values())


def test_the_same_clips_come_out_every_time():
    again = {f"steer/{clip.name}": clip for clip in embedded_clips()}
    for name, clip in again.items():
        assert clips()[name].rotations.tobytes() == clip.rotations.tobytes()
        assert clips()[name].root_position.tobytes() == clip.root_position.tobytes()


@every_clip
def test_planted_feet_do_not_slide(name):
    """While a foot stands with its toes up it turns about its heel, else about its ball."""
    clip = clips()[name]
    places, turns = clip_places(clip)
    for foot, (ankle, ball) in enumerate(BODY.feet):
        heel = places[:, ankle] + quaternion.rotate(turns[:, ankle], [0.0, BODY.offsets[ball, 1] - SOLE, -0.05])
        toes_up = quaternion.rotate(turns[:, ankle], [0.0, 0.0, 1.0])[:, 1] > 1e-6
        for planted, when in ((heel, toes_up), (places[:, ball], np.invert(toes_up))):
            for start, end in spans(clip.contacts[:, foot] & when):
                assert np.ptp(planted[start:end], axis=0).max() < 0.01


@every_clip
def test_joints_stay_within_human_ranges(name):
    clip = clips()[name]
    for joint, ranges in RANGES.items():
        turned = np.degrees(quaternion.to_rotation_vector(clip.rotations[:, BODY.index(joint)]))
        for axis, (low, high) in enumerate(ranges):
            assert low <= turned[:, axis].min(), joint
            assert turned[:, axis].max() <= high, joint


@every_clip
def test_no_joint_jerks(name):
    clip = clips()[name]
    steps = quaternion.multiply(clip.rotations[1:], quaternion.conjugate(clip.rotations[:-1]))
    spin = quaternion.to_rotation_vector(steps) * clip.fps
    # knees of runners and kickers reach some 600 rad/s^2; a popping knee gives thousands
    assert np.linalg.norm(np.diff(spin, axis=0) * clip.fps, axis=-1).max() < 700.0


@every_clip
def test_feet_never_sink_into_the_floor(name):
    clip = clips()[name]
    places, turns = clip_places(clip)
    balls = BODY.feet[:, 1]
    tips = places[:, balls] + quaternion.rotate(turns[:, balls], BODY.ends[balls])
    assert tips[..., 1].min() > -0.01
    assert places[:, BODY.feet, 1].min() > -0.01


@every_clip
def test_the_planned_contacts_are_those_that_a_detector_finds(name):
    clip = clips()[name]
    assert np.mean(detect_contacts(clip) == clip.contacts) >= 0.9


@every_clip
def test_the_centre_of_mass_flies_a_parabola(name):
    clip = clips()[name]
    flying = clip.contacts.sum(axis=-1) == 0
    inside = np.flatnonzero(flying[:-2] & flying[1:-1] & flying[2:])
    centre = centre_of_mass(BODY, clip.root_position, clip.rotations)
    pull = np.diff(centre, n=2, axis=0)[inside] * clip.fps**2
    np.testing.assert_allclose(pull, np.tile([0.0, -9.81, 0.0], (len(inside), 1)), atol=0.05 * 9.81)


def test_jumps_and_runs_do_fly():
    assert {name for name, clip in clips().items() if not clip.contacts.any(axis=-1).all()} == {
        name for name, clip in clips().items() if {"run", "jump"} & set(clip.labels.tolist())
    }


@pytest.mark.parametrize("name", ["steer/walk_slow", "steer/walk_normal", "steer/walk_paces"])
def test_walks_have_the_pace_of_walking_people(name):
    """Comfortable to brisk walking of adults: 1.1-1.6 m/s, steps of 0.55-0.85 m, 95-130 steps a minute."""
    seconds, metres = np.array(steady(name, "walk")).T
    assert 1.05 < metres.sum() / seconds.sum() < 1.65
    assert metres.min() > 0.55
    assert metres.max() < 0.85
    assert 95 < 60.0 / seconds.mean() < 130


def test_steps_come_in_several_lengths():
    lengths = [np.mean([metres for _, metres in steady(f"steer/walk_{pace}", "walk")]) for pace in ("slow", "normal")]
    assert lengths[1] - lengths[0] > 0.05


def test_runs_have_the_pace_of_running_people():
    """Easy running: 2.4-3.5 m/s, 150-190 steps a minute, each foot down for less than half of the time."""
    seconds, metres = np.array(steady("steer/run", "run")).T
    assert 2.4 < metres.sum() / seconds.sum() < 3.5
    assert 150 < 60.0 / seconds.mean() < 190
    clip = clips()["steer/run"]
    running = np.flatnonzero(clip.labels == "run")[10:-25]
    assert clip.contacts[running].mean() < 0.45


def test_a_walk_has_both_feet_down_now_and_then_and_never_none():
    clip = clips()["steer/walk_normal"]
    walking = clip.contacts[clip.labels == "walk"]
    assert walking.any(axis=-1).all()
    assert 0.1 < walking.all(axis=-1).mean() < 0.4


@pytest.mark.parametrize("kind", ["curve_wide", "turn_90", "spot_180", "run_turn_90"])
def test_clips_to_the_right_mirror_those_to_the_left(kind):
    left, right = clips()[f"steer/{kind}_left"], clips()[f"steer/{kind}_right"]
    places, mirrored = clip_places(left)[0], clip_places(right)[0] * np.array([-1.0, 1.0, 1.0])
    swapped = [BODY.index(_other_side(joint)) for joint in BODY.names]
    np.testing.assert_allclose(places, mirrored[:, swapped], atol=1e-9)


def _other_side(joint: str) -> str:
    side, _, part = joint.partition("_")
    return {"left": f"right_{part}", "right": f"left_{part}"}.get(side, joint)


@pytest.mark.parametrize(("kind", "degrees"), [("turn_90", 90), ("turn_180", 180), ("spot_90", 90), ("spot_180", 180)])
def test_turns_turn_as_far_as_they_say(kind, degrees):
    clip = clips()[f"steer/{kind}_left"]
    facing = np.degrees(np.unwrap(facing_yaw(BODY, clip_places(clip)[0])))
    assert facing[-1] - facing[0] == pytest.approx(degrees, abs=12)


@pytest.mark.parametrize(
    ("strike", "tip"), [("jab", "left_hand"), ("cross", "right_hand"), ("front_kick", "right_foot")]
)
def test_strikes_reach_out_ahead(strike, tip):
    clip = clips()[f"fight/{strike}"]
    places = clip_places(clip)[0]
    ahead = places[:, BODY.index(tip), 2] - places[:, 0, 2]
    assert ahead.max() > 0.55
    assert clip.labels[ahead.argmax()] == "attack"


@pytest.mark.parametrize("kind", ["steer", "fight"])
def test_a_motion_graph_over_the_clips_holds_together(kind):
    chosen = [clip for name, clip in clips().items() if name.startswith(kind)]
    lengths = [clip.frame_count for clip in chosen]
    ends = np.repeat(np.cumsum(lengths) - 1, lengths)
    edges = edges_of(ends, local_minima(PointCloudMetric.of_clips(chosen).all_pairs(), lengths, 1.0))
    assert len(largest_component(len(ends), edges.source, edges.target)) > 0.9 * len(ends)
