"""A real client that reads nothing for a while: what it finds then, and what the server held for it."""

import zmq

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.runtime.limits import Limits
from served import answer, serving, stranger, until

CHARACTERS = 16
FRAMES = 4  # a tick


def number_of(pose: m.Pose) -> int:
    return (pose.tick - 1) * FRAMES + pose.frame


def spawn_all(socket: zmq.Socket) -> None:
    socket.send(encode(m.Hello(version=1)))
    for number in range(CHARACTERS):
        socket.send(encode(m.Spawn(sequence=number + 1, character=number)))


def narrow(socket: zmq.Socket, address: str) -> None:
    """Connect anew with little room at the client's end."""
    socket.disconnect(address)
    socket.set(zmq.RCVHWM, 1)
    socket.set(zmq.RCVBUF, 16384)
    socket.connect(address)


def test_it_finds_recent_poses_and_is_told_of_every_one_it_missed():
    with serving(rate=120) as server, stranger(server) as socket:
        narrow(socket, server.address)
        spawn_all(socket)
        assert isinstance(answer(socket), m.Welcome)
        until(lambda: server.summary()["dropped"] > 10 * CHARACTERS)
        begun, last, lost = server.ticks, {}, 0
        while len(last) < CHARACTERS or min(map(number_of, last.values())) < FRAMES * (begun + 3):
            pose = answer(socket)
            if isinstance(pose, m.Pose):
                if pose.character in last:
                    assert number_of(pose) - number_of(last[pose.character]) == 1 + pose.lost
                last[pose.character] = pose
                lost += pose.lost
        assert lost > 5 * CHARACTERS
        assert server.summary()["dropped"] >= lost


def test_what_may_not_be_dropped_is_bounded_and_then_the_session_ends():
    with serving(limits=Limits(waiting_messages=8, messages_per_tick=4000)) as server, stranger(server) as socket:
        narrow(socket, server.address)
        socket.send(encode(m.Hello(version=1)))
        assert isinstance(answer(socket), m.Welcome)
        for nonce in range(40000):
            socket.send(encode(m.Ping(nonce=nonce)))
            if not server._host.sessions:
                break
        seen = answer(socket)
        nonce = -1
        while isinstance(seen, m.Pong):
            assert seen.nonce == nonce + 1
            nonce, seen = seen.nonce, answer(socket)
        assert seen == m.Bye(reason="slow")
