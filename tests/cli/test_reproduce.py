"""``footwork reproduce`` as a user meets it: files, JSON alone on stdout, exit statuses, one line for bad input."""

import json
import subprocess
import sys

import pytest

from footwork.cli.main import BAD_INPUT, main
from reproduction_motions import write_motion_sets

pytestmark = pytest.mark.timeout(250)


def footwork(*arguments: object, status: int = 0) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "footwork.cli.main", "reproduce", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=200)
    assert done.returncode == status, done.stderr
    assert "Traceback" not in done.stderr
    return done


@pytest.fixture
def reproduced(capsys):
    """What is printed, in this process, and on stderr."""

    def printed(*arguments: object, status: int = 0) -> tuple[str, str]:
        assert main(["reproduce", *map(str, arguments)]) == status
        return tuple(capsys.readouterr())

    return printed


@pytest.fixture(scope="module")
def motions(tmp_path_factory):
    return write_motion_sets(tmp_path_factory.mktemp("motions"))


def test_it_prints_what_it_writes(motions, tmp_path):
    done = footwork("--motions", motions, "--out", tmp_path / "new", "--only", "Z-T1", "z-r1", "--quick", "--json")
    report = json.loads(done.stdout)
    assert [row["name"] for row in report["rows"]] == ["Z-T1", "Z-R1"]
    assert report == json.loads((tmp_path / "new" / "reproduction.json").read_text())
    assert (tmp_path / "new" / "index.html").is_file()
    assert done.stderr == ""


def test_without_json_it_prints_a_verdict_for_each_row(reproduced, motions, tmp_path):
    printed, _ = reproduced("--motions", motions, "--out", tmp_path, "--only", "Z-T1")
    assert "Z-T1" in printed
    assert "holds" in printed or "does not hold" in printed


def test_a_row_that_fails_is_told_and_gives_exit_status_1(motions, tmp_path):
    broken = tmp_path / "broken"
    broken.mkdir()
    for name in ("dataset1", "dataset2", "labels.csv", "core_ranges.csv"):
        (broken / name).symlink_to(motions / name)
    (broken / "dataset3").mkdir()
    done = footwork("--motions", broken, "--out", tmp_path / "out", "--only", "Z-T1", "--json", status=1)
    report = json.loads(done.stdout)
    assert report["failed"] == ["Z-T1"]
    assert "Z-T1 failed:" in done.stderr
    assert "dataset3: has no motion files" in done.stderr
    assert "This row could not be made." in (tmp_path / "out" / "index.html").read_text()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--only", "Z-T99"), "--only: no row 'Z-T99', there are"),
        (("--traces", "nowhere"), "--traces: no folder nowhere"),
        (
            ("--motions", "nowhere"),
            "nowhere: has no dataset1, dataset2, dataset3, labels.csv, core_ranges.csv",
        ),
    ],
)
def test_bad_input_is_one_line_and_exit_status_2(reproduced, motions, tmp_path, arguments, message):
    options = {"--motions": motions, "--out": tmp_path / "out"} | dict([arguments])
    printed, said = reproduced(*(word for option in options.items() for word in option), status=BAD_INPUT)
    assert printed == ""
    assert said.startswith("footwork: " + message)
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_a_file_in_place_of_the_folder_to_write_is_refused(reproduced, motions, tmp_path):
    (tmp_path / "file").write_text("mine")
    _, said = reproduced("--motions", motions, "--out", tmp_path / "file", status=BAD_INPUT)
    assert "expected a folder to write into" in said
    assert (tmp_path / "file").read_text() == "mine"
