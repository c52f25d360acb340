"""State machines: the states that a character's motion is in, and which of them may follow which.

Read from a TOML file with a table for each state, the one that characters begin and rest in first::

    [states.locomotion]
    labels = ["walk", "turn"]
    to = ["locomotion", "attack"]
    at_once = ["attack"]

    [states.attack]
    to = ["locomotion"]

A state shows the frames with its ``labels``, or those labelled with its own name where it gives none. Its frames follow
one another as they were captured; those of the states in ``to`` may follow by transitions too, and so may its own if it
names itself. States named ``at_once`` are to be reached as soon as possible from wherever in it a character is. One
state may say ``shadowing = true``: in it a character keeps its distance from an opponent and faces it. A state without
transitions of its own is done once when it is asked for, from its beginning to its end; others last, and are asked for
with a heading that counts where they say ``headed = true``.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from footwork.errors import InputError
from footwork.motion.toml_file import only_keys, read_toml, shown

NO_STATE = -1
MOST_STATES = 64
_KEYS = ("labels", "to", "at_once", "shadowing", "headed")


@dataclass(frozen=True)
class State:
    """A state.

    Args:
        name: what it is called.
        labels: the labels of frames that show it.
        to: names of the states that may follow; its own for transitions within it.
        at_once: those of them that every frame of it needs a quick way to.
        shadowing: whether characters in it keep their distance from an opponent and face it.
        headed: whether whoever asks for it means a heading, too.
    """

    name: str
    labels: tuple[str, ...]
    to: tuple[str, ...]
    at_once: tuple[str, ...] = ()
    shadowing: bool = False
    headed: bool = False


@dataclass(frozen=True)
class StateMachine:
    """States, the first of which a character begins and rests in.

    Args:
        states: in the order of the file.
        where: the file it came from.

    Raises:
        InputError: for no states or more than MOST_STATES; names used twice; a state without labels, or with one that
            another state has; more than one that is shadowing; a state that nothing may follow, that leads to one that
            is not there, that cannot be reached from the first or does not lead back to it; a state to be reached at
            once that does not follow; and no self transition of the first state, of a shadowing one or of one from
            which others are to be reached at once.
    """

    states: tuple[State, ...]
    where: str = "machine"

    def __post_init__(self) -> None:
        object.__setattr__(self, "states", tuple(self.states))
        if not 1 <= len(self.states) <= MOST_STATES:
            problem = f"{len(self.states)} states, expected 1 to {MOST_STATES}: a table [states.NAME] for each"
            raise InputError(problem, self.where)
        self._check_names()
        for state in self.states:
            self._check_state(state)
        if shadowing := [number for number, state in enumerate(self.states) if state.shadowing][1:]:
            raise InputError("a second shadowing state, expected one at most", self.place(shadowing[0]))
        self._check_connected()

    @property
    def names(self) -> tuple[str, ...]:
        """Of the states."""
        return tuple(state.name for state in self.states)

    @cached_property
    def allowed(self) -> frozenset[tuple[int, int]]:
        """Pairs of states by their numbers of which the second may follow the first."""
        return frozenset(self._pairs(state.to for state in self.states))

    @cached_property
    def at_once(self) -> tuple[tuple[int, int], ...]:
        """Pairs of states of which the second is to be reached quickly from everywhere in the first, in order."""
        return tuple(sorted(self._pairs(state.at_once for state in self.states)))

    @property
    def headed(self) -> tuple[str, ...]:
        """Of the states that are asked for with a heading."""
        return tuple(state.name for state in self.states if state.headed)

    @property
    def one_shot(self) -> tuple[str, ...]:
        """Of the states that are done once when they are asked for: those without transitions within them."""
        return tuple(state.name for state in self.states if state.name not in state.to)

    @property
    def shadowing(self) -> int:
        """The number of the state that is shadowing, NO_STATE for none."""
        return next((number for number, state in enumerate(self.states) if state.shadowing), NO_STATE)

    def states_of(self, labels: Sequence[str]) -> list[int]:
        """The number of the state that each label shows, NO_STATE for those that show none."""
        shows = {label: number for number, state in enumerate(self.states) for label in state.labels}
        return [shows.get(label, NO_STATE) for label in labels]

    def place(self, number: int) -> str:
        """Where a state stands, for messages."""
        return f"{self.where}: states.{self.names[number]}"

    def require_shown(self, labels: Iterable[str]) -> None:
        """Raise InputError for a state that no frame shows or a label that none has, given those of all frames."""
        there = sorted(set(labels))
        words = ", ".join(repr(label) for label in there) or "none"
        for number, state in enumerate(self.states):
            missing = [label for label in state.labels if label not in there]
            if len(missing) == len(state.labels):
                meant = " or ".join(repr(label) for label in missing)
                problem = f"no frame shows it: none is labelled {meant}; label some so, or give it other labels"
                raise InputError(f"{problem} (there are {words})", self.place(number))
            if missing:
                problem = f"no frame is labelled {missing[0]!r}, expected labels among {words}"
                raise InputError(problem, self.place(number))

    def _pairs(self, named: Iterable[tuple[str, ...]]) -> set[tuple[int, int]]:
        return {(number, self.names.index(name)) for number, names in enumerate(named) for name in names}

    def _check_names(self) -> None:
        shows: dict[str, str] = {}
        for number, state in enumerate(self.states):
            if not state.name or self.names.index(state.name) != number:
                raise InputError(f"a state called {state.name!r}, expected names of their own", self.where)
            for label in state.labels:
                if shows.setdefault(label, state.name) != state.name:
                    problem = f"its label {label!r} is one of {shows[label]!r} too, expected it in one state"
                    raise InputError(problem, self.place(number))

    def _check_state(self, state: State) -> None:
        place = self.place(self.names.index(state.name))
        if not state.labels:
            raise InputError("no labels, expected at least one", place)
        if not state.to:
            raise InputError(f"nothing may follow it, expected some of {', '.join(self.names)} in its 'to'", place)
        for name in state.to:
            if name not in self.names:
                raise InputError(f"leads to {name!r}, which is no state, expected {', '.join(self.names)}", place)
        for name in state.at_once:
            if name not in state.to:
                raise InputError(f"{name!r} is to be reached at once, expected it in its 'to' as well", place)
        self._check_stays(state, place)

    def _check_stays(self, state: State, place: str) -> None:
        """A character must be able to go on within a state for as long as it takes."""
        if state.name in state.to or not (state.at_once or state.shadowing or state is self.states[0]):
            return
        why = "characters rest in it" if state is self.states[0] else "it is shadowing"
        why = f"{state.at_once[0]!r} is to be reached at once from it" if state.at_once else why
        raise InputError(f"no transitions within it, but {why}: add {state.name!r} to its 'to'", place)

    def _check_connected(self) -> None:
        home = self.names[0]
        onward, back = self._reached(self.allowed), self._reached({(there, here) for here, there in self.allowed})
        for number, name in enumerate(self.names):
            if number not in onward:
                problem = f"cannot be reached from {home!r}: add {name!r} to the 'to' of a state that can"
                raise InputError(problem, self.place(number))
            if number not in back:
                problem = f"does not lead back to {home!r}: add a state that does to its 'to'"
                raise InputError(problem, self.place(number))

    def _reached(self, pairs: Iterable[tuple[int, int]]) -> set[int]:
        """The states that pairs lead to from the first."""
        reached = {0}
        while more := {there for here, there in pairs if here in reached} - reached:
            reached |= more
        return reached


def read_state_machine(path: str | Path) -> StateMachine:
    """Read a state machine from a TOML file.

    Raises:
        InputError: for a file that cannot be read or is not TOML, unknown or malformed keys, and as StateMachine.
    """
    values, where = read_toml(Path(path), "a state machine"), str(path)
    only_keys(values, ("states",), where)
    states = values.get("states", {})
    if not isinstance(states, dict):
        raise InputError(f"states is {shown(states)}, expected a table [states.NAME] for each state", where)
    return StateMachine(tuple(_state(name, state, f"{where}: states.{name}") for name, state in states.items()), where)


def _state(name: str, values: Any, where: str) -> State:
    if not isinstance(values, dict):
        raise InputError(f"is {shown(values)}, expected a table with {', '.join(_KEYS)}", where)
    only_keys(values, _KEYS, where)
    labels = _words(values, "labels", where) if "labels" in values else (name,)
    at_once = _words(values, "at_once", where) if "at_once" in values else ()
    shadowing, headed = (_truth(values, key, where) for key in ("shadowing", "headed"))
    return State(name, labels, _words(values, "to", where), at_once, shadowing, headed)


def _truth(values: dict[str, Any], key: str, where: str) -> bool:
    value = values.get(key, False)
    if not isinstance(value, bool):
        raise InputError(f"{key} is {shown(value)}, expected true or false", where)
    return value


def _words(values: dict[str, Any], key: str, where: str) -> tuple[str, ...]:
    words = values.get(key)
    if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
        raise InputError(f"{key} is {shown(words)}, expected a list of texts", where)
    return tuple(words)
