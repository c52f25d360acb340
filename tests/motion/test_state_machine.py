from pathlib import Path

import pytest

from footwork.errors import InputError
from footwork.motion.state_machine import MOST_STATES, NO_STATE, State, StateMachine, read_state_machine

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_the_fighting_example_is_the_published_machine():
    machine = read_state_machine(EXAMPLES / "fighting.toml")
    assert machine.names == ("locomotion", "attack", "evade")
    assert machine.allowed == {(0, 0), (0, 1), (0, 2), (1, 0), (2, 0)}
    assert machine.at_once == ((0, 1), (0, 2))
    assert machine.shadowing == 0
    assert (machine.headed, machine.one_shot) == (("locomotion",), ("attack", "evade"))
    assert machine.states_of(["attack", "", "locomotion", "evade"]) == [1, NO_STATE, 0, 2]


def test_a_state_may_show_several_labels():
    machine = read_state_machine(EXAMPLES / "locomotion.toml")
    assert machine.states_of(["idle", "turn", "walk", "duck"]) == [0, 1, 1, NO_STATE]
    machine.require_shown(["idle", "turn", "walk", "run", "jump", "duck"])


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", r"machine.toml: 0 states, expected 1 to 64: a table \[states.NAME\] for each"),
        ("state = 1", "machine.toml: unknown key 'state', expected states"),
        ("states = 3", "states is 3, expected a table"),
        ("[states]\na = 3", "states.a: is 3, expected a table with labels, to, at_once"),
        ("[states.a]\nto = ['a']\ntwo = 2", "states.a: unknown key 'two', expected labels, to, at_once"),
        ("[states.a]\nto = 'a'", "states.a: to is 'a', expected a list of texts"),
        ("[states.a]\nto = [1]", "expected a list of texts"),
        ("[states.a]", "states.a: to is missing, expected a list of texts"),
        ("[states.a]\nto = []", "states.a: nothing may follow it, expected some of a in its 'to'"),
        ("[states.a]\nto = ['a']\nlabels = []", "states.a: no labels, expected at least one"),
        ("[states.a]\nto = ['a', 'b']", "states.a: leads to 'b', which is no state, expected a"),
        ("[states.'']\nto = ['']", "a state called ''"),
        (
            "[states.a]\nto = ['a', 'b']\n[states.b]\nto = ['a']\nlabels = ['a']",
            "states.b: its label 'a' is one of 'a' too",
        ),
        ("[states.a]\nto = ['a']\n[states.b]\nto = ['a']", "states.b: cannot be reached from 'a': add 'b' to the 'to'"),
        ("[states.a]\nto = ['a', 'b']\n[states.b]\nto = ['b']", "states.b: does not lead back to 'a'"),
        ("[states.a]\nto = ['b']\n[states.b]\nto = ['a']", "states.a: no transitions within it, but characters rest"),
        (
            "[states.a]\nto = ['a', 'b']\n[states.b]\nto = ['a']\nat_once = ['a']",
            "states.b: no transitions within it, but 'a' is to be reached at once from it: add 'b' to its 'to'",
        ),
        (
            "[states.a]\nto = ['a', 'b']\nat_once = ['c']\n[states.b]\nto = ['a']",
            "states.a: 'c' is to be reached at once, expected it in its 'to' as well",
        ),
        ("[states.a]\nto = ['a']\nshadowing = 1", "states.a: shadowing is 1, expected true or false"),
        ("[states.a]\nto = ['a']\nheaded = 'no'", "states.a: headed is 'no', expected true or false"),
        (
            "[states.a]\nto = ['a', 'b']\n[states.b]\nto = ['a']\nshadowing = true",
            "states.b: no transitions within it, but it is shadowing: add 'b' to its 'to'",
        ),
        (
            "[states.a]\nto = ['a', 'b']\nshadowing = true\n[states.b]\nto = ['a', 'b']\nshadowing = true",
            "states.b: a second shadowing state, expected one at most",
        ),
        ("[states.a", "is not TOML"),
        ("# " + "x" * (1 << 20), "is longer than"),
    ],
)
def test_a_machine_that_does_not_work_is_refused(tmp_path, text, says):
    path = tmp_path / "machine.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=says):
        read_state_machine(path)


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none.toml: cannot be read .* expected a state machine in TOML"):
        read_state_machine(tmp_path / "none.toml")


def test_there_is_an_end_to_states():
    names = [f"s{number}" for number in range(MOST_STATES + 1)]
    with pytest.raises(InputError, match="65 states, expected 1 to 64"):
        StateMachine(tuple(State(name, (name,), tuple(names)) for name in names))
    with pytest.raises(InputError, match="a state called 'a', expected names of their own"):
        StateMachine((State("a", ("a",), ("a",)), State("a", ("b",), ("a",))))


def test_states_and_labels_that_no_frame_has_are_named():
    machine = read_state_machine(EXAMPLES / "fighting.toml")
    with pytest.raises(
        InputError,
        match=r"states.attack: no frame shows it: none is labelled 'attack'.*there are 'evade', 'locomotion'",
    ):
        machine.require_shown(["locomotion", "evade"])
    walking = read_state_machine(EXAMPLES / "locomotion.toml")
    with pytest.raises(InputError, match=r"states.walk: no frame is labelled 'turn', expected labels among"):
        walking.require_shown(["idle", "walk", "run", "jump"])
