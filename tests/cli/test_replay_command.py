"""footwork serve --record and footwork replay, with a real server and a real client."""

import json
from pathlib import Path
from threading import Thread

import msgspec
import pytest

from footwork.cli.main import main
from footwork.motion.bundle import write_bundle
from footwork.runtime import recording as r
from footwork.runtime.server import Server
from served import client_of
from toy_bundle import toy_bundle

BUNDLE = toy_bundle()


def served(folder: Path) -> Path:
    """The recording of a server with one client that spawns, walks and leaves."""
    server = Server(BUNDLE, bind="tcp://127.0.0.1:0", record=folder)
    thread = Thread(target=server.run)
    thread.start()
    with client_of(server) as client:
        client.spawn(0, x=1.0)
        for tick in range(10):
            sent = client.command(0, heading=0.3 * tick, behaviour="walk")
            next(pose for pose in client.poses() if pose.acknowledged >= sent)
    server.stop()
    thread.join()
    (name,) = server.summary()["recordings"]
    return Path(name)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("recorded")
    write_bundle(folder / "toy.footwork", BUNDLE)
    return served(folder), folder / "toy.footwork"


def test_a_server_that_cannot_tell_its_metrics_ends_the_recording_that_it_began(recorded, tmp_path: Path, capsys):
    options = ("--bind", "tcp://127.0.0.1:0", "--record", tmp_path, "--metrics", "nonsense")
    assert main(["serve", *map(str, (recorded[1], *options))]) == 2
    assert "expected an address such as 127.0.0.1:9095" in capsys.readouterr().err
    (begun,) = tmp_path.iterdir()
    assert r.read_recording(begun).whole


def test_what_a_server_recorded_is_replayed_and_agrees(recorded, capsys: pytest.CaptureFixture):
    path, bundle = recorded
    seen = []
    for speed in ("max", "20"):
        assert main(["replay", str(path), "--bundle", str(bundle), "--verify", "--json", "--speed", speed]) == 0
        seen.append(json.loads(capsys.readouterr().out))
    assert seen[0]["poses"] == seen[1]["poses"]
    assert (seen[0]["characters"], seen[0]["departed_at"], seen[0]["whole"]) == (1, None, True)
    assert seen[0]["commands"] >= 10


def test_a_replay_that_departs_has_exit_status_1_and_names_the_tick(recorded, tmp_path: Path, capsys):
    path, bundle = recorded
    read = r.read_recording(path)
    moved = (
        msgspec.structs.replace(record, x=record.x + 0.5) if isinstance(record, r.Spawned) else record
        for record in read.records
        if not isinstance(record, r.Removed)
    )
    other = tmp_path / "other.footrec"
    other.write_bytes(r.MAGIC + r.framed(read.header) + b"".join(map(r.framed, moved)))
    assert main(["replay", str(other), "--bundle", str(bundle), "--verify", "--json"]) == 1
    out = capsys.readouterr()
    assert json.loads(out.out)["departed_at"] > 0
    assert "departs after tick 0, by tick" in out.err


def test_wrong_files_and_options_are_one_line(recorded, tmp_path: Path, capsys):
    path, bundle = recorded
    empty = tmp_path / "empty.footrec"
    empty.touch()
    for arguments in (
        [str(empty), "--bundle", str(bundle)],
        [str(bundle), "--bundle", str(bundle)],
        [str(path), "--bundle", str(path)],
        [str(tmp_path / "none"), "--bundle", str(bundle)],
        [str(path), "--bundle", str(bundle), "--speed", "-1"],
    ):
        assert main(["replay", *arguments]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1
    assert main(["serve", str(bundle), "--record", str(empty)]) == 2
