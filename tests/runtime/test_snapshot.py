"""Snapshots bring characters back to the same bytes, and take nothing wrong from anybody."""

import subprocess
import sys
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.runtime.simulation import Simulation
from footwork.runtime.world_errors import NoSuchCharacter
from toy_bundle import lively_bundle

BUNDLE = lively_bundle()


class Asked(SteeringController):
    """Steers as usual, but is asked at every tick."""


def act(simulation: Simulation, slot: int, random: np.random.Generator) -> None:
    """Now and then another command, or a push."""
    if random.random() < 0.3:
        jump = "jump" if random.random() < 0.4 else ""
        held = int(random.integers(-1, 2)), int(random.integers(-1, 2))
        simulation.give(slot, simulation.vocabulary.of_keys(random.uniform(-3, 3), *held, False, jump))
    if random.random() < 0.05:
        simulation.correct(slot, *random.uniform(-2, 2, 3))


def shown(simulation: Simulation, slots: list[int]) -> bytes:
    frames = [simulation.show(fraction) for fraction in (0.5, 1.0)]
    return b"".join(
        array[slots].tobytes()
        for each in frames
        for array in (each.root, each.rotations, each.facing, each.behaviour, each.clip, each.transition)
    )


def go_on(simulation: Simulation, slots: list[int], seed: int, ticks: int) -> list[bytes]:
    random, seen = np.random.default_rng(seed), []
    for _ in range(ticks):
        for slot in slots:
            act(simulation, slot, random)
        simulation.step()
        seen.append(shown(simulation, slots))
    return seen


@given(st.integers(0, 2**31), st.integers(0, 60), st.booleans())
@settings(max_examples=12, deadline=None)
def test_what_is_restored_goes_on_to_the_same_bytes(seed, ticks, asked_each_tick):
    controller = (Asked if asked_each_tick else SteeringController)(BUNDLE.graph, BUNDLE.table("steering"))
    simulation = Simulation(BUNDLE, 5, controller=controller)
    slots = [simulation.spawn(number, 0.0, number, "walk") for number in range(4)][1:3]
    go_on(simulation, slots, seed, ticks)
    blob, before = simulation.snapshot(slots), shown(simulation, slots)
    expected = go_on(simulation, slots, seed + 1, 25)
    simulation.remove(0)
    simulation.spawn(9.0, 9.0, 1.0)
    simulation.spawn(8.0, 9.0, 1.0)
    assert simulation.restore(blob, slots) == ticks
    assert shown(simulation, slots) == before
    assert go_on(simulation, slots, seed + 1, 25) == expected
    for slot in slots:
        simulation.remove(slot)
    elsewhere = sorted(simulation.spawn(0.0, 0.0, 0.0, "stop") for _ in slots)
    shown(simulation, elsewhere)  # what is shown before is not what is told after
    simulation.restore(blob, elsewhere)
    assert shown(simulation, elsewhere) == before
    assert go_on(simulation, elsewhere, seed + 1, 25) == expected


def test_resimulated_ticks_are_those_that_were_made():
    simulation = Simulation(BUNDLE, 3)
    slots = [simulation.spawn(0.0, 0.0, 0.5, "walk"), simulation.spawn(1.0, 0.0, -0.5)]
    go_on(simulation, slots, 3, 20)
    blob, random = simulation.snapshot(slots), np.random.default_rng(5)
    commands = [
        (tick, slot, simulation.vocabulary.outright(random.uniform(-3, 3), "walk"))
        for tick in range(8)
        for slot in slots
    ]
    for tick in range(8):
        for _, slot, command in (each for each in commands if each[0] == tick):
            simulation.give(slot, command)
        simulation.step()
    expected, tick = shown(simulation, slots), simulation.tick
    simulation.restore(blob, slots)
    shown(simulation, slots)
    simulation.resimulate(slots, 8, commands)
    assert (shown(simulation, slots), simulation.tick) == (expected, tick)


def test_commands_beyond_the_resimulated_ticks_are_refused_and_nothing_changes():
    simulation = Simulation(BUNDLE, 1)
    slot, before = simulation.spawn(0.0, 0.0, 0.5, "walk"), simulation.digest()
    walk = simulation.vocabulary.outright(1.0, "walk")
    for ticks, commands, problem in (
        (-1, [], "-1 ticks, expected 0 to 3600"),
        (3601, [], "3601 ticks"),
        (8, [(-1, slot, walk)], "before tick -1, expected 0 to 7"),
        (8, [(8, slot, walk)], "before tick 8, expected 0 to 7"),
        (8, [(0, slot, replace(walk, speed=float("nan")))], "speed is nan"),
    ):
        with pytest.raises(InputError, match=problem):
            simulation.resimulate([slot], ticks, commands)
    assert simulation.digest() == before


def test_a_blob_goes_on_alike_in_another_process():
    simulation = Simulation(BUNDLE, 2)
    slot = simulation.spawn(1.0, 2.0, 0.5, "walk")
    go_on(simulation, [slot], 1, 13)
    blob = simulation.snapshot([slot])
    script = (
        "import sys, test_snapshot as t; s = t.Simulation(t.BUNDLE, 4); s.spawn(0, 0, 0); slot = s.spawn(0, 0, 0);"
        "s.restore(sys.stdin.buffer.read(), [slot]); sys.stdout.buffer.write(b''.join(t.go_on(s, [slot], 9, 20)))"
    )
    here = Path(__file__).parent
    path = {"PYTHONPATH": f"{here}:{here.parent}", "PATH": ""}
    done = subprocess.run([sys.executable, "-c", script], input=blob, capture_output=True, check=True, env=path)
    assert done.stdout == b"".join(go_on(simulation, [slot], 9, 20))


def test_a_damaged_or_foreign_blob_is_refused_and_changes_nothing():
    simulation, random = Simulation(BUNDLE, 2), np.random.default_rng(1)
    slots = [simulation.spawn(0.0, 0.0, 0.0, "walk"), simulation.spawn(0.0, 0.0, 0.0)]
    go_on(simulation, slots, 1, 9)
    blob = simulation.snapshot(slots)
    other = Simulation(replace(BUNDLE, digest="another"), 2)
    with pytest.raises(InputError, match="another bundle"):
        other.restore(blob, [other.spawn(0.0, 0.0, 0.0), other.spawn(0.0, 0.0, 0.0)])
    with pytest.raises(InputError, match="2 characters, expected 1"):
        simulation.restore(blob, slots[:1])
    with pytest.raises(NoSuchCharacter):
        other.restore(blob, [0, 7])
    newer = blob[:4] + b"\2" + blob[5:]
    for bad, problem in ((b"", "cut short"), (b"x" * 900, "not a snap"), (blob[:-1], "bytes"), (newer, "version 2")):
        with pytest.raises(InputError, match=problem):
            simulation.restore(bad, slots)
    for _ in range(50):
        place = int(random.integers(len(blob)))
        with pytest.raises(InputError):
            simulation.restore(
                blob[:place] + bytes([blob[place] ^ (1 << random.integers(8))]) + blob[place + 1 :], slots
            )
    assert simulation.snapshot(slots) == blob


def test_a_blob_whose_checksum_fits_still_cannot_hold_what_cannot_be():
    simulation, random = Simulation(BUNDLE, 1), np.random.default_rng(2)
    slots = [simulation.spawn(0.0, 0.0, 0.0, "walk")]
    go_on(simulation, slots, 1, 9)
    blob, snapshots, refused = simulation.snapshot(slots), simulation._snapshots, 0
    for _ in range(200):
        rows = bytearray(snapshots.rows(np.array(slots)))
        place = int(random.integers(len(rows) - 8))
        rows[place : place + 8] = random.bytes(8)
        forged = forge(simulation, bytes(rows))
        try:
            simulation.restore(forged, slots)
        except InputError:
            refused += 1
            assert simulation.world.node[0] < BUNDLE.graph.node_count
        for _ in range(3):
            simulation.step()
        simulation.show(0.5)
        simulation.restore(blob, slots)
    assert refused > 30


@pytest.mark.parametrize("ticks", [-1, 1 << 30])
def test_a_decision_that_would_hold_for_ever_is_no_memory_of_a_controllers(ticks):
    simulation = Simulation(BUNDLE, 1)
    slots = [simulation.spawn(0.0, 0.0, 0.0)]
    (held,), before = simulation._controller.memory(1), simulation.digest()
    held[0] = ticks
    blob = simulation.snapshot(slots)
    held[0] = 0
    with pytest.raises(InputError, match="no character has"):
        simulation.restore(blob, slots)
    assert simulation.digest() == before


def forge(simulation: Simulation, rows: bytes) -> bytes:
    """A blob of the one character with other rows and the right checksum."""
    blob = simulation.snapshot([0])
    head, tail = blob[:8], blob[12 : len(blob) - len(rows)] + rows
    return head + zlib.crc32(tail).to_bytes(4, "little") + tail


def test_a_snapshot_is_small():
    simulation = Simulation(BUNDLE, 1)
    joints = BUNDLE.graph.skeleton.joint_count
    assert len(simulation.snapshot([simulation.spawn(0.0, 0.0, 0.0)])) < 400 + 24 * (joints + 8)
