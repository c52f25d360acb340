"""What happened to a session's fighters in a tick, for its client."""

from collections.abc import Iterator

from msgspec import UNSET

from footwork.protocol import messages as m
from footwork.runtime.arena import Arena
from footwork.runtime.duel_ticks import Happening
from footwork.runtime.session import Session
from footwork.runtime.tally import EVENTS, HIT, MISSED, ROUND

NOBODY = -1
_STRIKES = EVENTS[HIT], EVENTS[MISSED]


def fight_events(session: Session, simulation: Arena) -> Iterator[m.Event]:
    """The strikes and the ends of rounds of the tick last made, each told of the one that it happened to."""
    if not simulation.happened:
        return
    numbers = {character.slot: number for number, character in session.characters.items()}
    for happening in simulation.happened:
        if happening.other in numbers:
            yield from _event(happening, numbers, simulation.tick)


def _event(happening: Happening, numbers: dict[int, int], tick: int) -> Iterator[m.Event]:
    kind, other = happening.kind, numbers[happening.other]
    if kind in _STRIKES:
        damage = happening.worth if kind == EVENTS[HIT] else UNSET
        yield m.Event(tick=tick, kind=kind, character=other, opponent=numbers[happening.slot], damage=damage)
    elif kind == EVENTS[ROUND]:
        won = numbers.get(happening.slot, other)
        yield m.Event(tick=tick, kind=kind, character=won, opponent=NOBODY if won == other else other)
