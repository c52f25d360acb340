"""Peers that say odd things: they are refused, and nobody else notices."""

import random
from collections import defaultdict

from footwork.protocol.codec import decode_from_server, encode
from odd_messages import odd_message
from talk import Talk, codes, spawn, walk

PEERS = [b"odd", b"odder"]
HONEST = b"honest"


def heard(talk: Talk) -> dict[bytes, list]:
    told = defaultdict(list)
    for peer, data in talk.host.outgoing():
        told[peer].append(decode_from_server(data))
    return told


def test_odd_messages_are_refused_and_an_honest_client_goes_on():
    talk, rng, refused = Talk(), random.Random(2), set()
    talk.open(HONEST)
    talk.say(HONEST, spawn(1, 0))
    for number in range(2, 200):
        for _ in range(10):
            talk.host.receive(rng.choice(PEERS), odd_message(rng, number), talk.now)
        talk.host.receive(HONEST, encode(walk(number)), talk.now)
        talk.host.tick()
        told = heard(talk)
        assert set(told) <= {HONEST, *PEERS}
        assert not codes(told[HONEST])
        (pose,) = talk.poses(HONEST)
        assert pose.acknowledged == number
        refused |= {code for peer in PEERS for code in codes(told[peer])}
    assert {"malformed", "no_session", "too_large"} <= refused
