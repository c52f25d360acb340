"""What happened to a session's characters in a tick, for its client."""

from collections.abc import Iterable, Iterator
from itertools import chain

from footwork.protocol import messages as m
from footwork.runtime.arena import Arena
from footwork.runtime.fight_events import fight_events
from footwork.runtime.session import Session
from footwork.runtime.simulation import Simulation

BEHAVIOUR, TRANSITION = m.EVENTS


def happenings(session: Session, simulation: Simulation) -> Iterable[m.Event]:
    """The events of the tick last made: those of fights, and of the kinds that the session's client asked for."""
    fought = fight_events(session, simulation) if isinstance(simulation, Arena) else ()
    return chain(fought, _asked_for(session, simulation)) if session.events else fought


def _asked_for(session: Session, simulation: Simulation) -> Iterator[m.Event]:
    for number, character in session.characters.items():
        behaviour = simulation.behaviour[character.slot].item()
        if TRANSITION in session.events and simulation.transition[character.slot]:
            yield m.Event(tick=simulation.tick, kind=TRANSITION, character=number, behaviour=behaviour)
        if BEHAVIOUR in session.events and behaviour != character.behaviour:
            yield m.Event(tick=simulation.tick, kind=BEHAVIOUR, character=number, behaviour=behaviour)
        character.behaviour = behaviour
