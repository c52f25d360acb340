"""footwork data: lists sets, fetches them into folders that footwork build can read, and says whom to thank."""

import hashlib
import json
from dataclasses import replace
from pathlib import Path

import pytest

from footwork.cli.data import ATTRIBUTION
from footwork.cli.main import main
from footwork.motion.frame_tables import read_labels, read_ranges
from footwork.training import capture_sets as known
from misbehaving_server import misbehaving
from shared_data import MOTIONS, needs_motions


def test_every_set_has_its_files_terms_and_attribution(capsys: pytest.CaptureFixture):
    assert main(["data", "list", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["sets"]
    assert [each["name"] for each in told] == list(known.capture_sets())
    for each in known.capture_sets().values():
        assert each.files
        assert each.attribution
        assert len({file.name for file in each.files}) == len(each.files)
        for file in each.files:
            assert len(bytes.fromhex(file.sha256)) == 32
            assert 0 < file.size < 64 << 20
            assert Path(file.name).name == file.name


def test_the_tables_that_come_along_are_read_and_name_files_of_the_sets():
    for name, read in zip(known.TABLES, (read_labels, read_ranges), strict=True):
        for row in read(known.FOLDER / name):
            assert row.file in {file.name for file in known.capture_set(row.set_name).files}


@needs_motions
def test_digests_are_those_of_the_capture():
    for each in known.capture_sets().values():
        for file in each.files:
            data = (MOTIONS / each.name / file.name).read_bytes()
            assert (len(data), hashlib.sha256(data).hexdigest()) == (file.size, file.sha256)


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> bytes:
    """One set of two files of the same few bytes."""
    body = b"HIERARCHY " * 500
    digest = hashlib.sha256(body).hexdigest()
    files = tuple(known.CaptureFile(f"{name}.bvh", f"good/{name}", len(body), digest) for name in "ab")
    sets = {"dataset1": replace(known.capture_set("dataset1"), files=files)}
    monkeypatch.setattr(known, "capture_sets", lambda: sets)
    return body


def test_a_set_is_fetched_once_with_what_a_build_needs(small: bytes, tmp_path: Path, capsys):
    with misbehaving(small) as server:
        options = ["--origin", server.address, "--insecure", "--json"]
        command = ["data", "dataset1", "--to", str(tmp_path / "new"), *options]
        assert main(command) == 0
        told = capsys.readouterr()
        assert json.loads(told.out)["sets"][0]["fetched"] == 2
        assert "whoever gets this must be told: The data used in this project was obtained from" in told.err
        (tmp_path / "new" / "labels.csv").write_text("mine")
        assert main(command) == 0
        assert json.loads(capsys.readouterr().out)["sets"][0]["fetched"] == 0
    assert len(server.asked) == 2
    folder = tmp_path / "new"
    assert sorted(path.name for path in folder.rglob("*")) == sorted(
        ["dataset1", "a.bvh", "b.bvh", ATTRIBUTION, *known.TABLES]
    )
    assert (folder / "labels.csv").read_text() == "mine"
    assert "mocap.cs.cmu.edu" in (folder / "dataset1" / ATTRIBUTION).read_text()


def test_what_cannot_be_fetched_is_one_line(small: bytes, tmp_path: Path, capsys):
    with misbehaving(small) as server:
        new = ["--to", str(tmp_path / "new")]
        for arguments, said in (
            (["nothing"], "no set 'nothing', expected one of dataset1"),
            (["dataset1", *new, "--origin", server.address], "is not https, expected it unless told to be insecure"),
            (["dataset1", *new, "--insecure", "--origin", f"{server.address}/missing"], "the server answers 404"),
            (["dataset1", "--to", __file__], "expected a folder that can be written to"),
        ):
            assert main(["data", *arguments]) == 2
            assert said in capsys.readouterr().err
