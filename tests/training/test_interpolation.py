from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.alignment import align
from footwork.motion.body import default_body, rest_height
from footwork.motion.clip import Clip
from footwork.motion.kinematics import forward
from footwork.training import room
from footwork.training.centre_of_mass import centre_of_mass
from footwork.training.chains import CONTEXT, NO_CHAIN, NO_SEGMENT
from footwork.training.dataset import load_clips
from footwork.training.interpolation import interpolated, poses_of
from footwork.training.segments import GRAVITY, segments_of
from jumps import jump_clip
from motion_samples import sample_clip, stepping
from shared_data import MOTIONS, needs_motions

BEHAVIOURS = ("stop", "walk", "run", "jump")


def moved(clip: Clip, yaw: float, x: float, z: float) -> Clip:
    turn = quaternion.from_yaw(yaw)
    rotations = clip.rotations.copy()
    rotations[:, 0] = quaternion.multiply(turn, rotations[:, 0])
    root = quaternion.rotate(turn, clip.root_position) + np.array([x, 0.0, z])
    return replace(clip, root_position=root, rotations=rotations)


def rows_of(chains, chain, context=False):
    """Places of a chain's rows."""
    start = chains.first_row[chain] + (0 if context else CONTEXT)
    return chains.places[start : start + chains.length[chain] + (2 * CONTEXT if context else 0)]


def misfit(first, second):
    """Largest distance between two stretches of motion after the best alignment on the ground."""
    a, b = first.reshape(-1, 3), second.reshape(-1, 3)
    best = align(a, b, np.ones(len(a)))
    turned = quaternion.rotate(quaternion.from_yaw(best.theta), b) + np.array([best.x0, 0.0, best.z0])
    return np.linalg.norm(a - turned, axis=1).max()


def centres(clips, chains, chain):
    root, rotations = poses_of(clips, chains, [chain])
    centre = centre_of_mass(chains.skeleton, *forward(chains.skeleton, root, rotations))
    return centre[CONTEXT:-CONTEXT]


@pytest.fixture(scope="module")
def walks():
    clips = [stepping(sample_clip(0, 60), 15), stepping(sample_clip(1, 70), 18)]
    return clips, *interpolated(clips, BEHAVIOURS, 3)


def test_clips_come_first_and_segments_after_them(walks):
    _, chains, report = walks
    assert chains.original_count == 130
    np.testing.assert_array_equal(chains.first[:2], NO_SEGMENT)
    assert (chains.first[2:] < chains.second[2:]).all()
    np.testing.assert_array_equal(chains.weight[:130], 1.0)
    assert set(chains.chain_weight[2:]) == {0.25, 0.5, 0.75}
    assert report["kept"] == chains.chain_count - 2
    assert report["nodes"] == chains.node_count
    assert chains.row_count == chains.node_count + 2 * CONTEXT * report["kept"]


def test_two_falls_keep_gravity():
    clips = [jump_clip(10, turn=0.2, name="short"), jump_clip(19, turn=0.4, speed=1.6, name="long")]
    chains, report = interpolated(clips, BEHAVIOURS, 9)
    assert report["ballistic_flights"] == 2
    flights = np.flatnonzero(~chains.contacts[chains.first_node].any(axis=1) & (chains.first != NO_SEGMENT))
    assert len(flights) == 9
    for chain in flights:
        height = centres(clips, chains, chain)[:, 1]
        np.testing.assert_allclose(900.0 * np.diff(height, 2), -GRAVITY, rtol=1e-9)
        w = chains.chain_weight[chain]
        assert chains.length[chain] == round(np.sqrt(w * 10**2 + (1 - w) * 19**2))


def test_chains_that_break_gravity_are_left_out():
    clips = [jump_clip(12, name="true"), jump_clip(12, gravity=4.0, name="floating")]
    _, report = interpolated(clips, BEHAVIOURS, 9)
    # off by (1 - w) of the difference, which is under 2 m/s^2 at w = .7, .8 and .9
    assert report["rejected_for_gravity"] == 6
    assert report["kept"] + report["rejected_for_slide"] == report["chains"] - 6


def test_a_flight_that_is_no_fall_is_held_to_nothing():
    clips = [jump_clip(12, gravity=5.0, name="one"), jump_clip(14, gravity=4.0, name="other")]
    assert interpolated(clips, BEHAVIOURS, 9)[1]["rejected_for_gravity"] == 0


def test_chains_whose_foot_cannot_stay_are_left_out():
    # bent over forwards and backwards by more than a right angle: half-way between, the trunk hangs upside down, and
    # to keep the centre of mass where it is the straight legs would have to leave the ground
    body = default_body()
    clips = []
    for angle in (-1.8, 1.8):
        rotations = np.tile(quaternion.IDENTITY, (10, body.joint_count, 1))
        rotations[:, body.index("spine")] = quaternion.from_rotation_vector([angle, 0.0, 0.0])
        root = np.tile([0.0, rest_height(body), 0.0], (10, 1))
        clips.append(Clip(f"bent{angle}", body, 30.0, root, rotations, contacts=np.ones((10, 2), bool)))
    _, report = interpolated(clips, BEHAVIOURS, 3)
    assert (report["rejected_for_slide"], report["rejected_for_gravity"], report["kept"]) == (3, 0, 0)


def test_near_a_weight_of_one_or_nothing_the_sources_come_back():
    clips = [stepping(sample_clip(0, 15), 15), stepping(sample_clip(1, 18), 18)]
    chains, _ = interpolated(clips, BEHAVIOURS, 99)
    first, last = (np.flatnonzero(chains.chain_weight == w)[-1] for w in (0.99, 0.01))
    apart = misfit(chains.places[:15], chains.places[15:30])
    assert misfit(rows_of(chains, first), chains.places[:15]) < 0.03 * apart
    assert misfit(rows_of(chains, last), chains.places[15:33]) < 0.03 * apart


def test_exchanging_the_sources_changes_the_place_alone():
    clips = [stepping(sample_clip(0, 15), 15), stepping(sample_clip(1, 19), 19)]
    one, _ = interpolated(clips, BEHAVIOURS, 4)
    other, _ = interpolated(clips[::-1], BEHAVIOURS, 4)
    for weight in (0.2, 0.4):
        a = np.flatnonzero(np.isclose(one.chain_weight, weight))[0]
        b = np.flatnonzero(np.isclose(other.chain_weight, 1.0 - weight))[0]
        assert misfit(rows_of(one, a, context=True), rows_of(other, b, context=True)) < 1e-9


def test_where_the_sources_stand_changes_nothing_but_the_place():
    clips = [stepping(sample_clip(0, 15), 15), stepping(sample_clip(1, 19), 19)]
    there = [clips[0], moved(clips[1], 2.0, 5.0, -7.0)]
    one, other = interpolated(clips, BEHAVIOURS, 2)[0], interpolated(there, BEHAVIOURS, 2)[0]
    first = one.first_row[2]
    np.testing.assert_allclose(one.places[first:], other.places[other.first_row[2] :], atol=1e-9)


def test_a_segment_and_its_copy_give_the_segment():
    clip = stepping(sample_clip(0, 16), 16)
    chains, _ = interpolated([clip, moved(clip, -1.0, 3.0, 2.0)], BEHAVIOURS, 3)
    for chain in np.flatnonzero(chains.first != NO_SEGMENT):
        np.testing.assert_allclose(rows_of(chains, chain), chains.places[:16], atol=1e-6)


def test_standing_feet_move_no_more_than_in_the_sources(walks):
    clips, chains, _ = walks
    balls = chains.skeleton.feet[:, 1]
    segments = segments_of(clips)

    def path(places, foot):
        return np.linalg.norm(np.diff(places[:, balls[foot]][:, [0, 2]], axis=0), axis=1).sum()

    for chain in np.flatnonzero(chains.first != NO_SEGMENT):
        foot = int(chains.contacts[chains.first_node[chain], 1])
        ways = []
        for number in (chains.first[chain], chains.second[chain]):
            start = chains.first_row[segments.clip[number]]
            low, high = start + segments.start[number], start + segments.end[number]
            # the rows reach up to half a frame past the segment's ends
            ways.append(path(chains.places[max(low - 1, start) : high + 1], foot))
        assert path(rows_of(chains, chain), foot) < max(ways) + 0.001


def test_context_goes_on_from_the_chain():
    # the same swings on two ways, so that the sources are always alike
    near = stepping(sample_clip(0, 64), 16)
    clips = [near, moved(replace(near, root_position=near.root_position * [1.2, 1.0, 1.2]), 1.0, 2.0, 3.0)]
    chains, _ = interpolated(clips, BEHAVIOURS, 3)
    captured = np.abs(np.diff(chains.places[:64], axis=0)).max()
    for chain in np.flatnonzero(chains.first != NO_SEGMENT):
        steps = np.abs(np.diff(rows_of(chains, chain, context=True), axis=0)).max(axis=(1, 2))
        assert steps.max() < 1.5 * captured


def test_context_past_a_clips_end_is_its_end():
    clips = [stepping(sample_clip(0, 15), 15), stepping(sample_clip(1, 15), 15)]
    chains, _ = interpolated(clips, BEHAVIOURS, 1)
    rows = rows_of(chains, 2, context=True)
    np.testing.assert_array_equal(rows[:CONTEXT], np.repeat(rows[[CONTEXT]], CONTEXT, axis=0))
    np.testing.assert_array_equal(rows[-CONTEXT:], np.repeat(rows[[-CONTEXT - 1]], CONTEXT, axis=0))


def test_poses_are_those_whose_places_were_kept(walks):
    clips, chains, _ = walks
    root, rotations = poses_of(clips, chains, np.arange(chains.chain_count))
    places, _ = forward(chains.skeleton, root, rotations)
    np.testing.assert_allclose(places, chains.places, atol=1e-12)


def test_poses_do_not_depend_on_what_else_is_asked_for(walks):
    clips, chains, _ = walks
    everything = poses_of(clips, chains, np.arange(chains.chain_count))
    rows = chains.length + 2 * chains.context
    for which in ([chains.chain_count - 1, 0, 5], [7], [1]):
        some = poses_of(clips, chains, which)
        own = np.concatenate([np.arange(chains.first_row[c], chains.first_row[c] + rows[c]) for c in which])
        for part, whole in zip(some, everything, strict=True):
            np.testing.assert_array_equal(part, whole[own])


def test_the_same_clips_give_the_same_chains(walks):
    clips, chains, _ = walks
    again, _ = interpolated(clips, BEHAVIOURS, 3)
    for name in ("places", "frame", "other_frame", "length", "chain_weight", "contacts", "label"):
        np.testing.assert_array_equal(getattr(chains, name), getattr(again, name))


def test_nodes_know_their_sources(walks):
    clips, chains, _ = walks
    segments = segments_of(clips)
    for chain in np.flatnonzero(chains.first != NO_SEGMENT)[::5]:
        own = slice(chains.first_node[chain], chains.last_node[chain] + 1)
        for number, clip, frame in (
            (chains.first[chain], chains.clip, chains.frame),
            (chains.second[chain], chains.other_clip, chains.other_frame),
        ):
            assert (clip[own] == segments.clip[number]).all()
            np.testing.assert_allclose(frame[own][[0, -1]], [segments.start[number], segments.end[number] - 1], atol=1)
            assert (np.diff(frame[own]) >= 0).all()


def test_an_interpolated_node_is_called_as_its_heavier_source():
    clips = [
        replace(stepping(sample_clip(seed, 15), 15), labels=np.full(15, label))
        for seed, label in ((0, "run"), (1, "walk"))
    ]
    chains, _ = interpolated(clips, BEHAVIOURS, 3)
    names = [chains.labels[chains.label[node]] for node in chains.first_node[2:]]
    assert dict(zip(chains.chain_weight[2:], names, strict=True)) == {0.25: "walk", 0.5: "run", 0.75: "run"}
    assert [chains.behaviours[chains.behaviour[node]] for node in chains.first_node[2:]] == names


def test_a_foot_stands_where_both_sources_stand():
    clips = [stepping(sample_clip(0, 15), 15), stepping(sample_clip(1, 15), 15)]
    contacts = clips[1].contacts.copy()
    contacts[5:] = False
    height = clips[1].root_position.copy()
    clips[1] = replace(clips[1], contacts=contacts, root_position=height)
    chains, _ = interpolated(clips, BEHAVIOURS, 1)
    pairs = [(chains.frame[n], chains.other_frame[n]) for n in range(30, chains.node_count)]
    wanted = [clips[0].contacts[a] & clips[1].contacts[b] for a, b in pairs]
    np.testing.assert_array_equal(chains.contacts[30:], np.reshape(wanted, (-1, 2)))


def test_more_rows_than_memory_has_room_for_are_refused_before_any_is_made(monkeypatch):
    clips = [stepping(sample_clip(0, 60), 15), stepping(sample_clip(1, 70), 18)]
    rows = interpolated(clips, BEHAVIOURS, 4)[0].row_count - 130
    monkeypatch.setattr(room, "available_bytes", lambda: 1500 * rows)
    assert interpolated(clips, BEHAVIOURS, 4)[0].row_count == rows + 130
    monkeypatch.setattr(room, "available_bytes", lambda: 1500 * rows - 1)
    with pytest.raises(InputError, match=f"{rows} rows of interpolated motion need"):
        interpolated(clips, BEHAVIOURS, 4)


def test_with_a_threshold_pairs_have_as_many_weights_as_hops_need():
    clips = [stepping(sample_clip(0, 60), 15), stepping(sample_clip(1, 70), 18)]
    chains, report = interpolated(clips, BEHAVIOURS, 9, threshold=20.0)
    fixed, _ = interpolated(clips, BEHAVIOURS, 9)
    assert 0.0 < report["weights_a_pair"] < 9.0
    assert chains.node_count < fixed.node_count
    assert interpolated(clips, BEHAVIOURS, 9, threshold=1e-6)[0].node_count == fixed.node_count
    assert interpolated(clips, BEHAVIOURS, 9, threshold=1e6)[0].chain_count == len(clips)


def test_one_clip_is_paired_within_itself():
    clip = stepping(sample_clip(0, 60), 15)
    chains, report = interpolated([clip], BEHAVIOURS, 2, "plain")
    assert report["pairs"] == 2
    assert chains.chain_count == 5
    assert (chains.followers[1:3] != NO_CHAIN).all()


def test_clips_without_contacts_are_one_flight_or_carried_by_low_feet():
    clips = [sample_clip(seed, 40) for seed in (0, 1)]
    chains, report = interpolated(clips, BEHAVIOURS, 2)
    assert report["kept"] + report["rejected_for_gravity"] + report["rejected_for_slide"] == report["chains"]
    assert chains.original_count == 80


def test_progress_is_told_up_to_the_end():
    shares = []
    interpolated([stepping(sample_clip(0, 60), 15)], BEHAVIOURS, 2, progress=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


@needs_motions
def test_walks_of_real_capture_mix_with_planted_feet():
    clips = load_clips(MOTIONS / "dataset1", ranges=MOTIONS / "core_ranges.csv").clips
    chains, report = interpolated(clips, BEHAVIOURS, 3)
    assert report["kept"] == report["chains"] > 50
    root, rotations = poses_of(clips, chains, np.arange(chains.chain_count))
    places, _ = forward(chains.skeleton, root, rotations)
    np.testing.assert_allclose(places, chains.places, atol=1e-12)
