"""Recording never harms what is recorded: full disks, taken names and sudden ends."""

import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from footwork.controllers.command import Command
from footwork.errors import InputError
from footwork.runtime.recorder import Recorder, new_recording
from footwork.runtime.recording import STATE_TICKS, SUFFIX, Commanded, Spawned, State, read_recording
from footwork.runtime.recordings import Recordings
from footwork.runtime.replay import Replay, start_recording
from footwork.runtime.server import Server
from footwork.runtime.simulation import LONGEST_PLAY, Simulation
from toy_bundle import toy_bundle

BUNDLE = toy_bundle()
HERE = Path(__file__).parent
SOON = "from footwork.runtime import recorder; recorder.FLUSH_SECONDS = 0.2;"
ENVIRONMENT = {"PYTHONPATH": f"{HERE}:{HERE.parent}", "PATH": ""}


def played(simulation: Simulation, ticks: int) -> None:
    """One character that is told something else every few ticks."""
    slot = simulation.spawn(0.0, 0.0, 0.1, "walk")
    for tick in range(ticks):
        if tick % 7 == 0:
            simulation.give(slot, simulation.vocabulary.outright(0.1 * tick, ("walk", "stop")[tick // 7 % 2]))
        simulation.step()


def test_a_recording_never_takes_the_place_of_another(tmp_path: Path):
    first = new_recording(tmp_path)
    assert first.suffix == SUFFIX
    first.write_bytes(b"kept")
    second = new_recording(tmp_path)
    assert second != first
    with pytest.raises(InputError, match="exists"):
        start_recording(Simulation(BUNDLE, 1), first, rate=60)
    with pytest.raises(InputError, match="cannot be written"):
        start_recording(Simulation(BUNDLE, 1), tmp_path / "none" / "a.footrec", rate=60)
    assert first.read_bytes() == b"kept"


def killed_while_recording(path: Path) -> None:
    """For a process of its own: record until killed, and say up to which tick all is on the disk."""
    simulation = Simulation(BUNDLE, 1)
    recorder = start_recording(simulation, path, rate=60)
    told, slot = 0, simulation.spawn(0.0, 0.0, 0.0, "walk")
    while True:
        simulation.give(slot, simulation.vocabulary.outright(0.001 * simulation.tick, "walk"))
        simulation.step()
        time.sleep(0.001)
        if recorder.recorded > told:
            told = recorder.recorded
            print(told, flush=True)


def test_a_recording_of_a_killed_process_holds_all_that_was_told_to_be_on_the_disk(tmp_path: Path):
    path = tmp_path / "killed.footrec"
    script = f"{SOON}import pathlib, test_recorder as t; t.killed_while_recording(pathlib.Path({str(path)!r}))"
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, env=ENVIRONMENT) as process:
        assert process.stdout is not None
        told = [int(process.stdout.readline()) for _ in range(2)]
        process.send_signal(signal.SIGKILL)
    recording = read_recording(path)
    assert not recording.whole
    assert recording.last >= told[-1] > told[0] > 0
    outcome = Replay(recording, BUNDLE).run()
    assert outcome.departed is None
    assert outcome.ticks == recording.last


def test_a_recording_cut_in_the_middle_of_a_record_replays_up_to_there(tmp_path: Path):
    simulation, path = Simulation(BUNDLE, 1), tmp_path / "a.footrec"
    recorder = start_recording(simulation, path, rate=30)
    played(simulation, 200)
    simulation.end_recording()
    recorder.wait()
    os.truncate(path, path.stat().st_size - 60)
    recording = read_recording(path)
    assert not recording.whole
    assert Replay(recording, BUNDLE).run().departed is None


def full_disk(path: Path) -> None:
    """For a process of its own: go on although the recording may take no more than 4 KB."""
    simulation = Simulation(BUNDLE, 1)  # before the limit: what it compiles is cached in files
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
    recorder = start_recording(simulation, path, rate=60)
    slot = simulation.spawn(0.0, 0.0, 0.0, "walk")
    while recorder.recording:
        simulation.give(slot, simulation.vocabulary.outright(0.001 * simulation.tick, "walk"))
        simulation.step()
        time.sleep(0.0005)
    for _ in range(100):
        simulation.step()
    simulation.end_recording()
    recorder.wait()
    print(recorder.errors, recorder.recorded, simulation.tick)


def test_a_full_disk_ends_the_recording_and_nothing_else(tmp_path: Path):
    path = tmp_path / "full.footrec"
    script = f"{SOON}import pathlib, test_recorder as t; t.full_disk(pathlib.Path({str(path)!r}))"
    # -B: byte code that finds no room is left cut short by Python, in the environment of all other tests
    command = [sys.executable, "-B", "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=ENVIRONMENT)
    errors, recorded, tick = map(int, done.stdout.split())
    assert (errors, tick > recorded + 100) == (1, True)
    assert "File too large" in done.stderr
    assert len(done.stderr.splitlines()) == 1
    recording = read_recording(path)
    assert path.stat().st_size <= 4096
    assert recording.last >= recorded
    assert Replay(recording, BUNDLE).run().departed is None


def test_a_disk_that_is_too_slow_ends_the_recording(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    simulation, path = Simulation(BUNDLE, 1), tmp_path / "slow.footrec"
    monkeypatch.setattr("footwork.runtime.recorder.MOST_WAITING", 1000)
    recorder: Recorder = start_recording(simulation, path, rate=60)
    slot = simulation.spawn(0.0, 0.0, 0.0, "walk")
    for _ in range(2000):
        simulation.give(slot, simulation.vocabulary.outright(0.0, "walk"))
    assert not recorder.recording
    assert recorder.errors == 1
    simulation.end_recording()
    recorder.wait()
    assert all(isinstance(record, Commanded | State) for record in read_recording(path).records[1:])


def test_a_server_that_cannot_be_leaves_no_recording(tmp_path: Path):
    with pytest.raises(InputError, match="cannot bind"):
        Server(BUNDLE, bind="tcp://127.0.0.1:99999", record=tmp_path)
    assert not list(tmp_path.iterdir())


def test_slots_and_commands_may_be_numbers_of_numpy(tmp_path: Path):
    simulation = Simulation(BUNDLE, 2)
    recorder = start_recording(simulation, tmp_path / "a.footrec", rate=60)
    simulation.spawn(0.0, 0.0, 0.1)
    slot: Any = simulation.world.slots[0]
    stop: Any = np.int32(0)
    simulation.give(slot, Command(np.float64(0.5), stop))
    simulation.end_recording()
    recorder.wait()
    assert read_recording(recorder.path).records[2] == Commanded(1, 0, 0.5, 0, -1)


def test_what_could_not_be_read_again_ends_the_recording_and_what_was_before_stays(tmp_path: Path, caplog):
    simulation = Simulation(BUNDLE, 1)
    recorder = start_recording(simulation, tmp_path / "a.footrec", rate=60)
    slot = simulation.spawn(0.0, 0.0, 0.1)
    simulation.correct(slot, 1e10, 0.0, 0.0)
    simulation.end_recording()
    recorder.wait()
    assert recorder.errors == 1
    assert "correct" in caplog.text
    assert [type(record) for record in read_recording(recorder.path).records] == [State, Spawned]


def test_so_many_ticks_at_once_that_a_recording_could_not_be_read_are_refused(tmp_path: Path):
    simulation = Simulation(BUNDLE, 1)
    recorder = start_recording(simulation, tmp_path / "a.footrec", rate=60)
    with pytest.raises(InputError, match=f"expected at most {LONGEST_PLAY}"):
        simulation.play(LONGEST_PLAY + 1, 0)
    for ticks in (STATE_TICKS - 1, LONGEST_PLAY):
        simulation.play(ticks, 0)
    simulation.end_recording()
    recorder.wait()
    assert read_recording(recorder.path).whole


def test_the_folder_of_recordings_is_made_or_refused_in_a_line(tmp_path):
    Recordings(tmp_path / "new", 60)
    assert (tmp_path / "new").is_dir()
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(InputError, match="File exists, expected a folder that recordings can be written to"):
        Recordings(tmp_path / "file", 60)
    with pytest.raises(InputError, match="No such file or directory, expected a folder"):
        Recordings(tmp_path / "no" / "such", 60)
