from dataclasses import replace

import numpy as np
import pytest

from footwork.training.segments import (
    GRAVITY,
    NO_SIGNATURE,
    accelerations,
    is_fall,
    segments_of,
    settled,
    support_signature,
)
from jumps import jump_clip
from motion_samples import sample_clip


def with_contacts(clip, text):
    """The clip with contacts in words: L, R, B for both and - for none, each with a count."""
    feet = {"L": (1, 0), "R": (0, 1), "B": (1, 1), "-": (0, 0)}
    rows = [feet[word[0]] for word in text.split() for _ in range(int(word[1:]))]
    return replace(clip, contacts=np.array(rows, dtype=bool))


def test_segments_are_runs_of_one_signature_and_cover_every_frame():
    clips = [with_contacts(sample_clip(0, 30), "L10 B8 R12"), with_contacts(sample_clip(1, 12), "R12")]
    segments = segments_of(clips)
    np.testing.assert_array_equal(segments.clip, [0, 0, 0, 1])
    np.testing.assert_array_equal(segments.start, [0, 10, 18, 0])
    np.testing.assert_array_equal(segments.end, [10, 18, 30, 12])
    np.testing.assert_array_equal(segments.signature, [1, 3, 2, 2])
    np.testing.assert_array_equal(segments.neighbour(1), [3, 2, NO_SIGNATURE, NO_SIGNATURE])
    np.testing.assert_array_equal(segments.neighbour(-1), [NO_SIGNATURE, 1, 3, NO_SIGNATURE])
    assert not segments.ballistic.any()


@pytest.mark.parametrize(
    ("runs", "expected"),
    [
        ([(1, 9), (3, 1), (2, 9)], [1] * 10 + [2] * 9),
        ([(1, 9), (3, 2), (2, 9)], [1] * 10 + [2] * 10),
        ([(1, 9), (3, 1), (0, 2), (2, 9)], [1] * 11 + [2] * 10),
        ([(1, 9), (3, 2), (1, 9)], [1] * 20),
        ([(3, 2), (1, 5), (0, 1)], [1] * 8),
        ([(1, 3), (0, 3), (2, 3)], [1] * 3 + [0] * 3 + [2] * 3),
        ([(1, 2), (2, 1)], [1, 1, 2]),
    ],
)
def test_short_runs_are_shared_by_their_neighbours(runs, expected):
    signature = np.concatenate([[code] * count for code, count in runs])
    np.testing.assert_array_equal(settled(signature), expected)


def test_a_low_foot_carries_the_body_where_none_is_in_contact():
    heights = np.full((100, 2, 2), 0.5)
    heights[:60, 0], heights[40:, 1] = 0.0, 0.01
    heights[10:20, 0] = 0.039  # low
    heights[50:, 0] = 0.041  # no longer
    contacts = np.zeros((100, 2), dtype=bool)
    contacts[45:48, 1] = True
    found = support_signature(contacts, heights)
    np.testing.assert_array_equal(found, [1] * 40 + [3] * 5 + [2] * 3 + [3] * 2 + [2] * 50)


def test_only_a_fall_at_g_is_ballistic():
    for gravity, expected in ((GRAVITY, True), (GRAVITY - 1.9, True), (GRAVITY - 2.1, False), (5.0, False)):
        segments = segments_of([jump_clip(flight=12, gravity=gravity)])
        np.testing.assert_array_equal(segments.signature, [3, 0, 3])
        np.testing.assert_array_equal(segments.frames, [10, 12, 10])
        np.testing.assert_array_equal(segments.ballistic, [False, expected, False])


def test_accelerations_are_those_of_the_best_parabola():
    rng = np.random.default_rng(3)
    counts = np.array([3, 7, 2, 20])
    values = rng.normal(size=counts.sum())
    ends = np.cumsum(counts)
    wanted = [
        2.0 * np.polyfit(np.arange(n) / 30.0, values[end - n : end], 2)[0] if n > 2 else np.nan
        for n, end in zip(counts, ends, strict=True)
    ]
    np.testing.assert_allclose(accelerations(values, counts), wanted, rtol=1e-9)
    assert not is_fall(np.zeros(2))


def test_turns_are_measured_from_the_first_to_the_last_frame():
    clip = with_contacts(sample_clip(0, 31, turn=0.6), "L31")
    assert segments_of([clip]).yaw_change[0] == pytest.approx(0.6, abs=0.05)
