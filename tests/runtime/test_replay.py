"""A replay makes the same bytes, in another process too, and notices where it does not."""

import hashlib
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest

from footwork.errors import InputError
from footwork.runtime import recording as r
from footwork.runtime.replay import Replay, start_recording
from footwork.runtime.simulation import Simulation
from toy_bundle import lively_bundle

BUNDLE = lively_bundle()
TICKS, FRAMES = 200, 2


def play(path: Path) -> str:
    """Record all that can happen to characters; the digest of the poses shown."""
    simulation, random, digest = Simulation(BUNDLE, 4), np.random.default_rng(1), hashlib.blake2b(digest_size=16)
    recorder = start_recording(simulation, path, rate=30 * FRAMES)
    kept = b""
    for tick in range(TICKS):
        if tick % 50 == 3:
            x, z, yaw = random.uniform(-3, 3, 3)
            simulation.spawn(x, z, yaw, ("walk", "stop", "", "jump")[tick // 50])
        if tick == 120:
            simulation.remove(1)
        for slot in simulation.world.slots.tolist():
            if random.random() < 0.2:
                held = int(random.integers(-1, 2)), int(random.integers(-1, 2))
                jump = "jump" if random.random() < 0.3 else ""
                simulation.give(slot, simulation.vocabulary.of_keys(random.uniform(-3, 3), *held, False, jump))
        if tick == 70:
            simulation.correct(0, 1.0, 2.0, 3.0)
        if tick == 90:
            simulation.teleport(0, np.float64(-1.0), 2.0, 3)
            kept = simulation.snapshot([0])
        if tick == 100:
            simulation.restore(kept, [0])
            simulation.resimulate([0], 10, [(4, 0, simulation.vocabulary.outright(1.0, "walk"))])
        simulation.step()
        slots = simulation.world.slots
        for frame in range(FRAMES):
            shown = simulation.show((frame + 1) / FRAMES)
            rotations = shown.rotations[slots].reshape(len(slots), shown.rotations[0].size)
            digest.update(np.hstack([shown.root[slots], rotations]).tobytes())
    simulation.end_recording()
    recorder.wait()
    assert (recorder.errors, recorder.recorded) == (0, TICKS)
    return digest.hexdigest()


def test_a_replay_shows_the_same_bytes_here_and_in_another_process(tmp_path: Path):
    path = tmp_path / "a.footrec"
    poses = play(path)
    outcome = Replay(r.read_recording(path), BUNDLE).run()
    assert outcome.poses == poses
    assert (outcome.ticks, outcome.characters, outcome.departed) == (TICKS, 4, None)
    assert outcome.states == TICKS // r.STATE_TICKS + 2
    script = (
        "import test_replay as t; from footwork.runtime.recording import read_recording;"
        f"print(t.Replay(read_recording({str(path)!r}), t.BUNDLE).run().poses)"
    )
    here = Path(__file__).parent
    environment = {"PYTHONPATH": f"{here}:{here.parent}", "PATH": ""}
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, env=environment)
    assert done.stdout.strip() == poses


def test_the_first_state_that_is_not_the_recorded_one_is_told(tmp_path: Path):
    path = tmp_path / "a.footrec"
    play(path)
    recording = r.read_recording(path)
    records = tuple(
        msgspec.structs.replace(record, x=record.x + 1e-9)
        if isinstance(record, r.Spawned) and 60 < record.tick < 120
        else record
        for record in recording.records
    )
    outcome = Replay(replace(recording, records=records), BUNDLE).run()
    assert (outcome.agreed, outcome.departed) == (60, 120)


def test_what_cannot_be_replayed_is_refused_in_one_line(tmp_path: Path):
    path = tmp_path / "a.footrec"
    play(path)
    recording = r.read_recording(path)
    with pytest.raises(InputError, match="this is abc"):
        Replay(recording, replace(BUNDLE, digest="abc"))
    with pytest.raises(InputError, match=r"footwork 0\.0\.0"):
        Replay(replace(recording, header=msgspec.structs.replace(recording.header, footwork="0.0.0")), BUNDLE)
    walk = BUNDLE.graph.behaviours.index("walk")
    for wrong in (
        r.Commanded(1, 3, 0.0, walk, -1),
        r.Commanded(1, 100_000, 0.0, walk, -1),
        r.Commanded(1, 0, 0.0, 99, -1),
        r.Removed(1, 3),
        r.Spawned(1, 2, 0.0, 0.0, 0.0, "walk", -1),
        r.Spawned(1, 1, 0.0, 0.0, 0.0, "fly", -1),
        r.Spawned(1, 1, 0.0, 0.0, 0.0, "", 10**6),
        r.Restored(1, (0,), b"no"),
        r.Resimulated(1, (3,), 8, ()),
        r.Resimulated(1, (0,), 8, ((0, 0, 0.0, 99, 99, None),)),
    ):
        records = (r.Spawned(1, 0, 0.0, 0.0, 0.0, "walk", -1), wrong)
        with pytest.raises(InputError, match=r"a\.footrec: record 2") as caught:
            Replay(replace(recording, records=records), BUNDLE).run()
        assert "\n" not in str(caught.value)
