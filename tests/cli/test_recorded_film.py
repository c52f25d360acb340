"""The film of a recording holds what its characters were shown doing, frame by frame."""

from pathlib import Path

import msgpack
import numpy as np
import pytest

from footwork.cli.main import main
from footwork.cli.recorded_film import MOST_ROLES, recorded_film
from footwork.motion.bundle import write_bundle
from footwork.runtime import recording as r
from footwork.runtime.replay import start_recording
from footwork.runtime.simulation import Simulation
from toy_bundle import lively_bundle, toy_bundle

BUNDLE = lively_bundle()
TICKS = 40  # of each part of the game
EMPTY = 10  # before anybody comes
ROOM = 12


def plays(simulation: Simulation) -> list[np.ndarray]:
    """Nobody, then one, then two, then the second alone, then a third in the slot of the first; poses part by part."""
    simulation.play(EMPTY, 2)
    first = simulation.spawn(0.0, 0.0, 0.0)
    simulation.give(first, simulation.vocabulary.outright(heading=1.0, behaviour="walk"))
    shown = [simulation.play(TICKS, 2)]
    simulation.spawn(2.0, 0.0, 1.0)
    shown.append(simulation.play(TICKS, 2))
    simulation.remove(first)
    shown.append(simulation.play(TICKS, 2))
    assert simulation.spawn(5.0, 0.0, 0.0) == first
    return [*shown, simulation.play(TICKS, 2)]


def recorded(path: Path, play, bundle=BUNDLE) -> list[np.ndarray]:
    simulation = Simulation(bundle, ROOM)
    recorder = start_recording(simulation, path, rate=60)
    shown = play(simulation)
    simulation.end_recording()
    recorder.wait()
    return shown


@pytest.fixture(scope="module")
def game(tmp_path_factory) -> tuple[Path, Path, list[np.ndarray]]:
    folder = tmp_path_factory.mktemp("game")
    write_bundle(folder / "toy.footwork", BUNDLE)
    return folder / "game.footrec", folder / "toy.footwork", recorded(folder / "game.footrec", plays)


def film_of(*arguments) -> dict:
    return msgpack.unpackb(recorded_film(*arguments))


def poses_of(role: dict) -> np.ndarray:
    return np.frombuffer(role["poses"], "<f4").reshape(len(role["transition"]), -1)


def test_it_begins_with_the_first_character_and_holds_all_as_they_were_shown(game):
    path, bundle, shown = game
    film = film_of(path, bundle, 0.0, None)
    flat = [part.reshape(2 * TICKS, part.shape[2], -1) for part in shown]
    first, second, third = film["roles"]
    assert (film["welcome"]["frame_rate"], film["first_tick"], film["frames"]) == (60, EMPTY + 1, 8 * TICKS)
    assert [role["first"] for role in film["roles"]] == [0, 2 * TICKS, 6 * TICKS]
    np.testing.assert_array_equal(poses_of(first), np.concatenate([flat[0][:, 0], flat[1][:, 0]]))
    np.testing.assert_array_equal(poses_of(second), np.concatenate([flat[1][:, 1], flat[2][:, 0], flat[3][:, 1]]))
    np.testing.assert_array_equal(poses_of(third), flat[3][:, 0])


def test_it_tells_what_they_do_tick_by_tick(game):
    path, bundle, _ = game
    (role, *_), graph = film_of(path, bundle, 0.0, TICKS / 30.0 + EMPTY / 30.0)["roles"], BUNDLE.graph
    again = Simulation(BUNDLE, ROOM)
    again.play(EMPTY, 0)
    slot = again.spawn(0.0, 0.0, 0.0)
    again.give(slot, again.vocabulary.outright(heading=1.0, behaviour="walk"))
    expected = []
    for _ in range(TICKS):
        again.step()
        node = again.world.node[slot]
        doing = again.behaviour[slot], again.transition[slot], *(source[node] for source in graph.nearest_source)
        expected += [doing, doing]
    kinds = (("behaviour", "<i2"), ("transition", "u1"), ("clip", "<i4"), ("frame", "<i4"))
    columns = [np.frombuffer(role[name], kind) for name, kind in kinds]
    np.testing.assert_array_equal(np.column_stack(columns), np.array(expected))
    assert role["health"] is None


def test_a_part_of_a_recording_is_that_part_of_the_film(game):
    path, bundle, _ = game
    whole, part = film_of(path, bundle, 0.0, None), film_of(path, bundle, 2.0, 1.0)
    assert (part["first_tick"], part["frames"]) == (61, 60)
    begin = 2 * (60 - EMPTY)
    np.testing.assert_array_equal(poses_of(part["roles"][0]), poses_of(whole["roles"][0])[begin:][:60])


def test_a_recording_that_was_cut_off_is_shown_up_to_its_last_whole_record(game, tmp_path, capsys):
    path, bundle, _ = game
    torn, read = tmp_path / "torn.footrec", r.read_recording(path)
    whole = [record for record in read.records if r.made_by(record) <= EMPTY + 3 * TICKS]
    torn.write_bytes(r.MAGIC + b"".join(map(r.framed, [read.header, *whole])) + r.framed(read.records[-1])[:-1])
    film = film_of(torn, bundle, 0.0, None)
    assert (len(film["roles"]), film["frames"]) == (2, 6 * TICKS)
    assert "was cut off" in capsys.readouterr().err


def test_who_comes_after_the_first_few_is_left_out(game, tmp_path, capsys):
    def crowd(simulation: Simulation) -> list[np.ndarray]:
        for number in range(MOST_ROLES + 2):
            simulation.spawn(float(number), 0.0, 0.0)
        return [simulation.play(5, 1)]

    recorded(tmp_path / "crowd.footrec", crowd)
    assert len(film_of(tmp_path / "crowd.footrec", game[1], 0.0, None)["roles"]) == MOST_ROLES
    assert "2 characters that come after the first 8 are left out" in capsys.readouterr().err


def test_what_cannot_be_filmed_is_said_in_a_line(game, tmp_path, capsys):
    path, bundle, _ = game
    other, empty, damaged = tmp_path / "other.footwork", tmp_path / "empty.footrec", tmp_path / "damaged.footrec"
    write_bundle(other, toy_bundle())
    recorded(empty, lambda simulation: [simulation.play(5, 1)])
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    damaged.write_bytes(data)
    for arguments, said in (
        ([path], "expected the bundle"),
        ([path, "--bundle", other], "was made with bundle"),
        ([path, "--bundle", path], "not a bundle"),
        ([path, "--bundle", bundle, "--text"], "in a browser"),
        ([path, "--bundle", bundle, "--start", "1000"], "--start: 1000 seconds, the recording has 5.7"),
        ([path, "--bundle", bundle, "--start", "-1"], "--start"),
        ([path, "--bundle", bundle, "--seconds", "6000"], "up to 600"),
        ([empty, "--bundle", bundle], "shows no character"),
        ([damaged, "--bundle", bundle], "damaged"),
        ([bundle, "--bundle", bundle], "is for recordings"),
        ([tmp_path / "none.footrec"], "no such file"),
    ):
        assert main(["play", *map(str, arguments)]) == 2
        line = capsys.readouterr().err
        assert said in line
        assert len(line.splitlines()) == 1
