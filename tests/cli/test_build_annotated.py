"""``footwork build --graph annotated`` as a user meets it, in process."""

import json
from pathlib import Path

import pytest

from footwork.cli.main import BAD_INPUT, main
from footwork.motion.bundle import read_bundle

MACHINE = Path(__file__).resolve().parents[2] / "examples" / "fighting.toml"
BUILD = ("build", "embedded:fighting", "--graph", "annotated", "--out")


def test_a_machine_makes_an_annotated_bundle(tmp_path, capsys):
    out = tmp_path / "b.footwork"
    assert main([*BUILD, str(out), "--machine", str(MACHINE), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    notes = read_bundle(out).annotation
    assert notes is not None
    assert notes.machine.names == ("locomotion", "attack", "evade")
    assert [state["segments"] for state in report["states"]] == [notes.of_state(one).size for one in range(3)]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (None, "--machine: an annotated graph needs a state machine"),
        ("[states.attack]\nto = ['guard']", "states.attack: leads to 'guard', which is no state, expected attack"),
        ("[states.duel]\nto = ['duel']", "states.duel: no frame shows it: none is labelled 'duel'"),
    ],
)
def test_a_machine_that_is_missing_or_wrong_is_answered_in_a_line(tmp_path, capsys, text, says):
    machine = tmp_path / "machine.toml"
    machine.write_text(text or "")
    given = [] if text is None else ["--machine", str(machine)]
    assert main([*BUILD, str(tmp_path / "b.footwork"), *given]) == BAD_INPUT
    shown = capsys.readouterr()
    assert shown.out == ""
    assert says in shown.err.splitlines()[-1]
    assert list(tmp_path.iterdir()) == [machine]
