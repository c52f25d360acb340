"""What clients are told of their characters, if they ask for it."""

import pytest

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server
from footwork.runtime.simulation import Simulation
from footwork.runtime.succession import Succession
from talk import BUNDLE, LIMITS, Talk, spawn, walk


@pytest.fixture
def talk():
    return Talk()


def events(messages: list[m.FromServer], kind: str) -> list[m.Event]:
    return [message for message in messages if isinstance(message, m.Event) and message.kind == kind]


def test_changes_of_behaviour_and_transitions_are_told_to_those_who_ask(talk):
    for peer, kinds in ((b"a", m.EVENTS), (b"b", ("hit", "weather"))):
        talk.open(peer, events=kinds)
        talk.say(peer, spawn(1, 0, behaviour="stop"), walk(2))
    shown, told = [], []
    for _ in range(40):
        talk.host.tick()
        out = [(peer, decode_from_server(data)) for peer, data in talk.host.outgoing()]
        told += [message for peer, message in out if peer == b"a"]
        assert len(events([message for peer, message in out if peer == b"b"], "spawned")) == (len(shown) == 0)
        assert sum(peer == b"b" for peer, _ in out) == (len(shown) == 0)
        shown += talk.poses(b"a")
    changes = [pose for n, pose in enumerate(shown) if n == 0 or pose.behaviour != shown[n - 1].behaviour]
    assert [(event.tick, event.behaviour) for event in events(told, "behaviour")] == [
        (pose.tick, pose.behaviour) for pose in changes
    ]
    assert len(changes) >= 2
    taken = [(pose.tick, pose.behaviour) for pose in shown if pose.transition]
    assert taken
    assert [(event.tick, event.behaviour) for event in events(told, "transition")] == taken


def test_what_a_character_does_is_told_anew_in_another_bundle(talk):
    talk.open(b"a", events=("behaviour",))
    talk.say(b"a", spawn(1, 0, behaviour="stop"))
    talk.tick(b"a")
    latter = Simulation(BUNDLE, LIMITS.characters)
    talk.host.succeed(Succession(talk.host.simulation, latter), talk.host.scenes.welcome_for("bundle", latter))
    assert [event.character for event in events(talk.tick(b"a"), "behaviour")] == [0]
