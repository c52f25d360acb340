import numpy as np
import pytest

from footwork.errors import InputError
from footwork.training.pairing import pairs_of
from footwork.training.segments import Segments


def segments(signature, frames, clip=None, yaw=None):
    """Segments laid end to end in their clips, all in one where not told."""
    signature, frames = np.array(signature), np.array(frames)
    clip = np.zeros(len(frames), dtype=np.intp) if clip is None else np.array(clip)
    start = np.concatenate([[0], np.cumsum(frames)[:-1]])
    yaw = np.zeros(len(frames)) if yaw is None else np.radians(yaw)
    return Segments(clip, start, start + frames, signature, np.zeros(len(frames), dtype=bool), yaw)


def as_list(pairs):
    return [tuple(pair) for pair in pairs.tolist()]


def test_plain_pairs_all_of_equal_signature_once():
    found = pairs_of(segments([1, 2, 1, 2, 1], [5, 5, 50, 9, 5]), "plain")
    assert as_list(found) == [(0, 2), (0, 4), (1, 3), (2, 4)]


def test_ratio_drops_those_over_twice_as_long():
    found = pairs_of(segments([1, 1, 1, 1], [5, 10, 11, 21]), "ratio")
    assert as_list(found) == [(0, 1), (1, 2), (2, 3)]


def test_neighbours_must_agree_before_and_after():
    made = segments([1, 2, 1, 3, 1, 2, 1, 2], [5] * 8, clip=[0, 0, 0, 0, 1, 1, 1, 1])
    # 0 and 4 begin a clip and go on to 2; 1 and 5 lie between 1 and 1; 2 goes on to 3, 6 to 2
    assert as_list(pairs_of(made, "neighbours")) == [(0, 4), (1, 5)]
    assert (2, 6) in as_list(pairs_of(made, "ratio"))


@pytest.mark.parametrize("rule", ["plain", "ratio", "neighbours"])
def test_flights_that_turn_differently_are_no_pair(rule):
    flights = segments([0, 0, 0], [5] * 3, clip=[0, 1, 2], yaw=[0.0, 29.0, 61.0])
    assert as_list(pairs_of(flights, rule)) == [(0, 1)]
    stances = segments([1, 1, 1], [5] * 3, clip=[0, 1, 2], yaw=[0.0, 29.0, 61.0])
    assert as_list(pairs_of(stances, rule)) == [(0, 1), (0, 2), (1, 2)]


def test_turns_are_compared_the_shorter_way_round():
    flights = segments([0, 0], [5, 5], clip=[0, 1], yaw=[170.0, -170.0])
    assert as_list(pairs_of(flights)) == [(0, 1)]


def test_segments_that_nothing_equals_give_no_pairs():
    assert pairs_of(segments([0, 1, 2, 3], [5] * 4)).shape == (0, 2)


def test_an_unknown_rule_is_refused():
    with pytest.raises(InputError, match="no pairing rule 'all', expected one of plain, ratio, neighbours"):
        pairs_of(segments([1], [5]), "all")


def test_more_pairs_than_memory_has_room_for_are_refused_before_they_are_made():
    many = 1_000_000
    with pytest.raises(
        InputError, match=r"motions: 499999500000 pairs of 1000000 stretches of motion need about 49,999.9 GB of memory"
    ):
        pairs_of(segments(np.ones(many, dtype=int), np.full(many, 5)), "plain")
