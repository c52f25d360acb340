"""The film of a fight is that of the match with the same seed."""

import msgpack
import numpy as np
import pytest

from fighting_bundle import fighting_bundle
from footwork.cli.fight_film import fight_film
from footwork.cli.recorded_film import recorded_film
from footwork.controllers.activity import ACTIVITIES
from footwork.controllers.fighting_style import STYLES
from footwork.errors import InputError
from footwork.motion.bundle import read_bundle, write_bundle
from footwork.runtime import recording as r
from footwork.runtime.fight_recording import record_fight
from footwork.runtime.match import Match, fight_ground, table_of

TICKS = 300
STYLES_TAKEN = ("aggressive", "evasive")


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("film") / "fighters.footwork"
    write_bundle(path, fighting_bundle())
    return path


def test_it_holds_the_poses_and_what_they_do(path):
    film = msgpack.unpackb(fight_film(path, STYLES_TAKEN, 3, TICKS / 30.0))
    bundle = fighting_bundle()
    match = Match(fight_ground(bundle), [STYLES[name] for name in STYLES_TAKEN], 3, shadowing=table_of(bundle))
    poses = match.play(TICKS, shown=True)
    assert (film["frames"], film["first_tick"]) == (TICKS, 1)
    assert film["welcome"]["behaviours"] == list(ACTIVITIES)
    clip, frame = bundle.graph.nearest_source
    for who, fighter in enumerate(film["roles"]):
        assert fighter["title"] == STYLES_TAKEN[who]
        np.testing.assert_array_equal(np.frombuffer(fighter["poses"], "<f4").reshape(TICKS, -1), poses[:, who])
        np.testing.assert_array_equal(np.frombuffer(fighter["behaviour"], "<i2"), match.track.activity[:, who])
        np.testing.assert_array_equal(np.frombuffer(fighter["transition"], np.uint8), ~match.track.natural[:, who])
        np.testing.assert_array_equal(np.frombuffer(fighter["clip"], "<i4"), clip[match.track.node[:, who]])
        np.testing.assert_array_equal(np.frombuffer(fighter["frame"], "<i4"), frame[match.track.node[:, who]])
        assert np.frombuffer(fighter["health"], "<f4")[-1] == pytest.approx(match.health[who])


def test_a_recorded_match_is_the_same_film(path, tmp_path):
    ground = fight_ground(read_bundle(path))
    chosen = [STYLES[name] for name in STYLES_TAKEN]
    record_fight(Match(ground, chosen, 3, shadowing=table_of(ground.bundle)), TICKS, tmp_path / "match.footrec")
    assert recorded_film(tmp_path / "match.footrec", path, 0.0, None) == fight_film(path, STYLES_TAKEN, 3, TICKS / 30.0)
    late, whole = (
        msgpack.unpackb(recorded_film(tmp_path / "match.footrec", path, start, seconds))
        for start, seconds in ((2.0, 1.5), (0.0, 3.5))
    )
    assert (late["first_tick"], late["frames"]) == (61, 45)
    assert whole["roles"][1]["poses"].endswith(late["roles"][1]["poses"])
    read = r.read_recording(tmp_path / "match.footrec")
    (tmp_path / "begun.footrec").write_bytes(r.MAGIC + r.framed(read.header) + r.framed(read.records[0]))
    with pytest.raises(InputError, match="holds no tick"):
        recorded_film(tmp_path / "begun.footrec", path, 0.0, None)


@pytest.mark.parametrize(
    ("styles", "seconds", "said"),
    [(("balanced",), 1.0, "expected two"), (STYLES_TAKEN, 1e4, "up to 600"), (("tired", "balanced"), 1.0, "tired")],
)
def test_what_cannot_be_filmed_is_said(path, styles, seconds, said):
    with pytest.raises(InputError, match=said):
        fight_film(path, styles, 0, seconds)
