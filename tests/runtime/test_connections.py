"""Connections that are too many, say nothing, or never end a message: cut, and nobody else notices."""

import os
import socket
import sys
import time
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import pytest
import zmq

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.runtime import connections
from footwork.runtime.limits import Limits
from footwork.runtime.router import Router
from served import TIMEOUT, client_of, serving

GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\x00") + bytes(32)
READY = b"\x05READY\x0bSocket-Type\x00\x00\x00\x06DEALER"
MORE_TO_COME = b"\x01\x01x"  # a frame of one byte and the promise of another


@contextmanager
def routing(most=8):
    router = Router("tcp://127.0.0.1:0", most=most)
    try:
        yield router
    finally:
        router.close()


@pytest.fixture
def router():
    with routing() as router:
        yield router


def raw(router, *sent):
    """A TCP connection that has sent these bytes and nothing else."""
    plain = socket.create_connection(("127.0.0.1", int(router.address.rpartition(":")[2])))
    plain.sendall(b"".join(sent))
    return plain


def shake_hands(plain):
    """Wait until libzmq is ready too: it closes the connection of who says more before that."""
    plain.settimeout(TIMEOUT)
    heard = b""
    while b"READY" not in heard:
        came = plain.recv(4096)
        assert came, f"closed after {heard!r}"
        heard += came


@pytest.fixture
def peer_of():
    context, held = zmq.Context(), []  # what nobody holds is closed

    def connect(router):
        dealer = context.socket(zmq.DEALER)
        held.append(dealer)
        dealer.connect(router.address)
        dealer.send(b"hello")
        return dealer

    yield connect
    context.destroy(linger=0)


def listen(router, until, seconds=TIMEOUT):
    """Take messages and look at connections until something is so; what came."""
    came = []
    end = time.monotonic() + seconds
    while not until() and time.monotonic() < end:
        if router.poll(5) and (parts := router.receive()) is not None:
            came.append(parts)
        router.look()
    assert until(), f"not so after {seconds} s, {len(came)} messages came"
    return came


def is_shut(plain):
    plain.settimeout(TIMEOUT)
    try:
        while plain.recv(4096):
            pass
    except ConnectionError:
        return True
    except TimeoutError:
        return False
    return True


def is_free(descriptor):
    try:
        os.fstat(descriptor)
    except OSError:
        return True
    return False


def memory():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel counts bytes on Linux only")
def test_a_message_that_never_ends_is_cut_before_it_fills_the_memory(router, peer_of, caplog):
    dealer = peer_of(router)
    listen(router, lambda: len(router.connections) == 1)
    before = memory()
    with raw(router, GREETING, bytes([4, len(READY)]), READY) as endless:
        shake_hands(endless)
        endless.settimeout(0.05)

        def flood_until_cut():
            with suppress(OSError):
                endless.sendall(MORE_TO_COME * 10_000)
            return router.connections.cut > 0

        listen(router, flood_until_cut)
    assert memory() - before < 16 << 20
    assert "no whole message" in caplog.text
    dealer.send(b"still here")
    assert router.poll(1000 * TIMEOUT)
    assert router.receive()[1] == b"still here"


@pytest.mark.parametrize("sent", [b"", GREETING[:20]])
def test_who_says_nothing_is_cut(router, monkeypatch, sent):
    monkeypatch.setattr(router.connections, "_silent", 0.1)
    with raw(router, sent) as silent:
        listen(router, lambda: router.connections.cut == 1)
        assert is_shut(silent)
    assert len(router.connections) == 0


def test_who_spoke_may_be_silent(router, peer_of, monkeypatch):
    monkeypatch.setattr(router.connections, "_silent", 0.1)
    peer_of(router)
    assert listen(router, lambda: len(router.connections) == 1 and router.connections._by_peer)
    end = time.monotonic() + 0.3
    listen(router, lambda: time.monotonic() > end)
    assert router.connections.cut == 0


def test_one_too_many_takes_the_place_of_one_that_said_nothing(peer_of):
    with routing(most=3) as router, ExitStack() as held:
        peer_of(router)
        listen(router, lambda: router.connections._by_peer)
        silent = [held.enter_context(raw(router)) for _ in range(3)]
        listen(router, lambda: router.connections.cut == 1)
        assert is_shut(silent[0])
        assert len(router.connections) == 3


def test_heartbeats_of_who_only_listens_may_go_on_for_ever(router, peer_of, monkeypatch):
    peer_of(router)
    listen(router, lambda: router.connections._by_peer)
    bytes_in, now = iter(range(0, 10_000_000, 500)), iter(range(0, 10_000_000_000_000, 10_000_000_000))
    monkeypatch.setattr(connections, "_received", lambda _: next(bytes_in))  # 50 bytes a second
    monkeypatch.setattr(connections, "now_ns", lambda: next(now))
    for _ in range(1000):
        router.connections.look()
    assert router.connections.cut == 0


def test_where_all_have_spoken_one_more_is_cut(peer_of):
    with routing(most=2) as router:
        dealers = [peer_of(router) for _ in range(2)]
        listen(router, lambda: len(router.connections._by_peer) == 2)
        with raw(router) as late:
            assert listen(router, lambda: router.connections.cut == 1) == []
            assert is_shut(late)
        for dealer in dealers:
            dealer.send(b"still here")
        came = []
        while len(came) < 2:
            came += [*listen(router, lambda: router.poll(50)), router.receive()]
        assert [parts[1] for parts in came] == [b"still here"] * 2


def test_nothing_is_kept_of_connections_that_are_gone(router, peer_of):
    for _ in range(30):
        dealer = peer_of(router)
        listen(router, lambda: router.connections._by_peer)
        dealer.close()
        listen(router, lambda: not router.connections._by_peer)
    assert len(router.connections) == 0
    assert router.connections.cut == 0


def test_other_transports_have_no_connections_to_watch(tmp_path, peer_of):
    router = Router(f"ipc://{tmp_path}/socket")
    peer_of(router)
    assert router.poll(1000 * TIMEOUT)
    assert (router.receive() or [])[1:] == [b"hello"]
    router.look()
    router.close()


def test_who_is_gone_is_told_once_and_only_after_another_look(router, peer_of):
    dealer = peer_of(router)
    (peer, _), *_ = listen(router, lambda: router.connections._by_peer)
    dealer.close()
    listen(router, lambda: len(router.connections) == 0)
    assert [router.gone() for _ in range(3)] == [[], [peer], []]


def test_who_takes_the_place_of_one_that_just_went_is_not_taken_for_it(router, peer_of):
    first = peer_of(router)
    listen(router, lambda: router.connections._by_peer)
    (descriptor,) = router.connections._by_descriptor
    first.close()
    while not is_free(descriptor):
        time.sleep(0.001)
    peer_of(router)  # is given the same descriptor
    while (parts := router.receive()) is None:  # without a look at who came and went before
        time.sleep(0.001)
    for _ in range(3):
        router.look()
        assert parts[0] not in router.gone()


def test_a_client_that_dies_in_lock_step_does_not_hold_the_others_up(peer_of):
    patient = Limits(idle_seconds=TIMEOUT)
    with serving(lockstep=True, limits=patient) as server, client_of(server) as client:
        dying = peer_of(server)
        for message in (m.Hello(version=m.PROTOCOL_VERSION), m.Spawn(sequence=1, character=0), m.Step()):
            dying.send(encode(message))
        while server.population()["characters"] < 1:
            time.sleep(0.01)
        dying.close(linger=0)
        client.spawn(0)
        client.step(timeout=0.8 * client.welcome.idle_seconds)
