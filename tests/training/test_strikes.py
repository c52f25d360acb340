"""Strikes: found where a limb reaches out, told by hand where a person knows better, kept in the bundle."""

from dataclasses import replace

import numpy as np
import pytest

from fighting_bundle import fighting_bundle
from footwork.errors import InputError
from footwork.motion.bundle import decode_bundle, encode_bundle
from footwork.motion.fighting_points import LIMBS, points_of
from footwork.motion.mirror import MIRRORED
from footwork.motion.strikes import Strikes
from footwork.training.strike_detection import detected_strikes
from footwork.training.strike_table import StrikeRow, read_strikes, strikes_of


@pytest.fixture(scope="module")
def bundle():
    return fighting_bundle()


@pytest.mark.parametrize(("clip", "limbs"), [("jab", ["left_hand"]), ("jab_cross", ["left_hand", "right_hand"])])
def test_the_limb_that_strikes_is_found(bundle, clip, limbs):
    assert [row["limb"] for row in bundle.strikes.rows(bundle.graph) if row["clip"] == clip] == limbs


def test_every_attack_clip_strikes_and_nothing_else_does(bundle):
    struck = {row["clip"] for row in bundle.strikes.rows(bundle.graph)}
    assert struck == {"jab", "cross", "jab_cross", "jab_step", "front_kick"}


def test_contact_is_where_the_limb_is_furthest_out(bundle):
    points = points_of(bundle.graph)
    for node, limb in zip(bundle.strikes.node, bundle.strikes.limb, strict=True):
        reach = np.hypot(points[node - 3 : node + 2, limb, 0], points[node - 3 : node + 2, limb, 2])
        assert reach[3] == reach.max()
        assert points[node, limb, 2] > 0.4
    assert (bundle.strikes.speed > 2.0).all()


def test_strikes_come_back_from_the_file(bundle):
    again = decode_bundle(encode_bundle(bundle)[0], "again")
    for name in ("node", "limb", "speed"):
        np.testing.assert_array_equal(getattr(again.strikes, name), getattr(bundle.strikes, name))


def test_a_table_takes_the_place_of_what_was_found_in_its_clips(bundle, tmp_path):
    path = tmp_path / "strikes.csv"
    path.write_text("clip,frame,limb\njab,21,right_hand\n")
    told = strikes_of(bundle.graph, bundle.annotation, read_strikes(path))
    assert told is not None
    told = told.rows(bundle.graph)
    assert [(row["frame"], row["limb"]) for row in told if row["clip"] == "jab"] == [(21, "right_hand")]
    found = bundle.strikes.rows(bundle.graph)
    assert [row for row in told if row["clip"] != "jab"] == [row for row in found if row["clip"] != "jab"]


def test_a_row_means_the_other_side_of_the_mirrored_clip():
    assert StrikeRow("jab", 3, "left_foot", "x").mirrored == StrikeRow("jab" + MIRRORED, 3, "right_foot", "x")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("clip,frame\njab,3\n", "columns clip, frame; expected clip, frame, limb"),
        ("clip,frame,limb\njab,3\n", "2 cells, but the header has 3"),
        ("clip,frame,limb\njab,3,tail\n", "limb 'tail', expected left_hand"),
        ("clip,frame,limb\njab,x,left_hand\n", "x"),
        ("clip,frame,limb\nnobody,3,left_hand\n", "no clip 'nobody', expected"),
        ("clip,frame,limb\njab,0,left_hand\n", "frame 0 of jab is in no attack"),
        ("clip,frame,limb\njab,20,left_hand\njab,20,left_hand\n", "do not rise"),
    ],
)
def test_bad_tables_are_refused_with_their_place(bundle, tmp_path, text, problem):
    path = tmp_path / "strikes.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=problem) as told:
        strikes_of(bundle.graph, bundle.annotation, read_strikes(path))
    assert str(path) in str(told.value)


def test_rows_where_nothing_attacks_are_refused(bundle):
    rows = [StrikeRow("jab", 20, "left_hand", "strikes.csv:2")]
    with pytest.raises(InputError, match="no state 'attack'"):
        strikes_of(bundle.graph, None, rows)


def test_strikes_that_are_none_are_refused(bundle):
    good = bundle.strikes
    for changed in ({"limb": good.limb + len(LIMBS)}, {"node": good.node[::-1]}, {"speed": -good.speed}):
        with pytest.raises(InputError):
            replace(good, **changed)
    far = Strikes(np.array([bundle.graph.node_count]), np.array([0]), np.array([1.0]))
    with pytest.raises(InputError, match="node"):
        far.require_fits(bundle.graph)


def test_a_limb_that_stays_near_or_low_does_not_strike(bundle):
    graph = bundle.graph
    evade = bundle.annotation.machine.names.index("evade")
    assert len(detected_strikes(graph, bundle.annotation, evade)) == 0
