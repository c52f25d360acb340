"""Recorded matches: made once more to the same bytes, and refused where they cannot be."""

import msgspec
import numpy as np
import pytest

from fighting_bundle import fighting_bundle, fighting_ground
from footwork.controllers.fighting_style import STYLES
from footwork.errors import InputError
from footwork.runtime import recording as r
from footwork.runtime.fight_recording import is_fight, record_fight, replay_fight
from footwork.runtime.match import Match
from footwork.runtime.match_rules import MatchRules
from footwork.runtime.replay import take_effect
from footwork.runtime.world_errors import WorldError

PAIR = [STYLES["aggressive"], STYLES["patient"]]


def new_match(seed=5):
    return Match(fighting_ground(), PAIR, seed, rules=MatchRules(round_seconds=4.0))


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    path = tmp_path_factory.mktemp("fights") / "match.footrec"
    match = new_match()
    record_fight(match, 250, path)
    return path, match


def test_a_recorded_match_is_made_again_to_the_same_bytes(recorded):
    path, match = recorded
    shown = []
    outcome = replay_fight(r.read_recording(path), fighting_bundle(), lambda tick, poses: shown.append(poses.copy()))
    assert (outcome.ticks, outcome.states, outcome.agreed, outcome.departed) == (250, 5, 250, None)
    again = new_match()
    np.testing.assert_array_equal(np.concatenate(shown)[:, 0], again.play(250, shown=True))
    assert again.digest() == match.digest()


def test_another_seed_departs_at_the_first_state(recorded):
    read = r.read_recording(recorded[0])
    other = r.Recording(msgspec.structs.replace(read.header, seed=6), read.records, read.whole, read.where)
    assert replay_fight(other, fighting_bundle()).departed == r.STATE_TICKS


def test_what_is_no_match_or_no_style_is_refused(recorded):
    path, match = recorded
    read = r.read_recording(path)
    assert is_fight(read)
    with pytest.raises(WorldError, match="a match began, where characters were steered"):
        take_effect(read.records[0], None)  # type: ignore[arg-type]
    begun = read.records[0]
    assert isinstance(begun, r.Fought)
    odd = msgspec.structs.replace(begun, rules={"gloves": 1.0})
    far = msgspec.structs.replace(begun, styles=(begun.styles[0] | {"reach": 9.0}, begun.styles[1]))
    for records in ((odd, *read.records[1:]), (far, *read.records[1:]), (begun, begun)):
        with pytest.raises(InputError):
            replay_fight(r.Recording(read.header, records, False, "x"), fighting_bundle())
    with pytest.raises(InputError, match="exists"):
        record_fight(new_match(), 10, path)
    with pytest.raises(InputError, match="250 ticks of it are made"):
        record_fight(match, 10, path)
