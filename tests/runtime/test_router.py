"""The ROUTER socket: addresses, dead and slow peers."""

import socket
import threading
import time

import pytest
import zmq

from footwork.errors import InputError
from footwork.runtime.router import Router, Sent, is_local


def has_ipv6() -> bool:
    try:
        with socket.socket(socket.AF_INET6) as probe:
            probe.bind(("::1", 0))
    except OSError:
        return False
    return True


@pytest.fixture
def router():
    router = Router("tcp://127.0.0.1:0")
    yield router
    router.close()


@pytest.fixture
def dealer(router):
    peer = zmq.Context.instance().socket(zmq.DEALER)
    peer.set(zmq.RCVHWM, 10)
    peer.connect(router.address)
    yield peer
    peer.close(linger=0)


def test_the_port_that_was_taken_is_told(router, dealer):
    dealer.send(b"hello")
    assert router.poll(20000)
    peer, data = router.receive()
    assert data == b"hello"
    assert router.send(peer, b"answer") is Sent.QUEUED
    assert dealer.recv() == b"answer"
    assert router.receive() is None


def test_the_next_message_is_waited_for_as_long_as_told(router, dealer):
    assert router.next(20) is None
    later = threading.Timer(0.2, dealer.send, [b"hello"])
    later.start()
    assert router.next(20000)[1:] == [b"hello"]
    later.join()
    assert router.next(20) is None
    assert router.receive() is None


@pytest.mark.skipif(not has_ipv6(), reason="this machine has no IPv6")
def test_an_ipv6_address_is_bound_and_local():
    router = Router("tcp://[::1]:0")
    try:
        assert router.address.startswith("tcp://[::1]:")
        assert is_local(router.address)
    finally:
        router.close()


def test_a_message_of_very_many_frames_is_read_in_pieces(router, dealer):
    dealer.send_multipart([b"part"] * 5000)
    dealer.send(b"hello")
    assert router.poll(20000)
    peer, *parts = router.receive()
    assert parts == [b"part", b"part"]
    pieces = 0
    while (message := router.receive()) is None and pieces < 1000:
        pieces += router.poll(20000) > 0
    assert message == [peer, b"hello"]
    assert 4998 // 256 <= pieces <= 5000 // 256 + 1


def test_the_rest_of_a_message_is_not_taken_for_another(router, dealer):
    dealer.send_multipart([b"part"] * 600)
    assert len(router.next(20000)) == 3
    for _ in range(5):
        router.poll(1)
        assert router.receive() is None
        assert router.next(1) is None


def test_a_peer_that_does_not_read_loses_messages_and_takes_no_time(router, dealer):
    dealer.send(b"hello")
    router.poll(20000)
    peer, _ = router.receive()
    outcomes = {router.send(peer, bytes(60000)) for _ in range(3000)}
    assert outcomes == {Sent.QUEUED, Sent.DROPPED}


def test_no_connection_lingers_by_itself(router):
    # a socket's connections keep what it has when it is made: one that its peer ends while it is being closed held the
    # whole context up for ever, once in some two hundred times
    with router.socket(zmq.XPUB) as another:
        assert another.get(zmq.LINGER) == 0
    assert router._socket.get(zmq.LINGER) == 0


def test_a_peer_that_left_is_told_of(router, dealer):
    dealer.send(b"hello")
    router.poll(20000)
    peer, _ = router.receive()
    dealer.close(linger=0)
    end = time.monotonic() + 60.0
    while (sent := router.send(peer, b"anyone?")) is Sent.QUEUED and time.monotonic() < end:
        router.poll(5)
    assert sent is Sent.GONE


@pytest.mark.parametrize(
    "bind", ["tcp://127.0.0.1:notaport", "nonsense", "tcp://300.1.1.1:5", "ftp://127.0.0.1:1", "tcp://127.0.0.1:65536"]
)
def test_an_address_that_cannot_be_bound_is_the_callers_error(bind):
    with pytest.raises(InputError, match="cannot bind"):
        Router(bind)


def test_a_port_in_use_is_the_callers_error(router):
    with pytest.raises(InputError, match="in use"):
        Router(router.address)


def test_what_other_machines_can_reach_gets_a_warning(caplog):
    Router("tcp://0.0.0.0:0").close()
    assert "can be reached from other machines" in caplog.text


@pytest.mark.parametrize(
    ("address", "local"),
    [
        ("tcp://127.0.0.1:5555", True),
        ("tcp://127.8.0.1:5555", True),
        ("tcp://[::1]:5555", True),
        ("tcp://localhost:5555", True),
        ("ipc:///run/footwork", True),
        ("tcp://0.0.0.0:5555", False),
        ("tcp://192.168.1.4:5555", False),
        ("tcp://[::]:5555", False),
        ("tcp://example.org:5555", False),
    ],
)
def test_which_addresses_are_local(address, local):
    assert is_local(address) is local
