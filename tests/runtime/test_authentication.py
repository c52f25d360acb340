"""Who gets in where keys are asked for, over real sockets."""

import time
from contextlib import ExitStack, contextmanager

import pytest
import zmq

from footwork.errors import InputError
from footwork.protocol.curve import CurveKeys, KeyPair
from footwork.runtime import authentication
from footwork.runtime.authentication import Authenticator
from footwork.runtime.key_folder import KeyFolder
from footwork.runtime.router import Router, Sent
from served import TIMEOUT

WAIT = 0.25


@pytest.fixture(autouse=True)
def _look_each_time(monkeypatch):
    monkeypatch.setattr(authentication, "_LOOK_EVERY", 0)


@pytest.fixture
def folder(tmp_path):
    return KeyFolder.create(tmp_path / "keys")


@pytest.fixture
def alice(folder):
    pair = KeyPair.new()
    folder.allow("alice", pair.public)
    return pair


@pytest.fixture
def router(folder, alice):
    router = Router("tcp://127.0.0.1:0", keys=folder)
    yield router
    router.close()


@contextmanager
def client(router, keys=None):
    socket = zmq.Context.instance().socket(zmq.DEALER)
    socket.set(zmq.LINGER, 0)
    if keys is not None:
        keys.put_on(socket)
    socket.connect(router.address)
    socket.send(b"hello")
    try:
        yield socket
    finally:
        socket.close()


def heard(router, seconds=WAIT):
    """The first message that comes, None where none does."""
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        if router.poll(int(1000 * left) + 1):
            return router.receive()
    return None


def nobody_is_heard(router, until):
    """For a while, and for as long as it takes until something is so."""
    end = time.monotonic() + TIMEOUT
    assert heard(router) is None
    while not until():
        assert heard(router) is None
        assert time.monotonic() < end


def test_who_has_an_allowed_key_gets_in_and_gets_answers(router, folder, alice):
    with client(router, CurveKeys(alice, folder.pair.public)) as socket:
        peer, data = heard(router, TIMEOUT) or (b"", b"")
        assert data == b"hello"
        assert router.send(peer, b"welcome") is Sent.QUEUED
        assert socket.poll(1000 * TIMEOUT)
        assert socket.recv() == b"welcome"


def test_who_waits_for_the_next_message_lets_in_who_has_a_key(router, folder, alice):
    with client(router, CurveKeys(alice, folder.pair.public)):
        assert (router.next(1000 * TIMEOUT) or [])[1:] == [b"hello"]
        assert router.next(10) is None


def test_who_has_not_is_never_heard_and_hears_nothing(router, folder, alice):
    eve, other = KeyPair.new(), KeyPair.new()
    strangers = [
        None,
        CurveKeys(eve, folder.pair.public),
        CurveKeys(alice, other.public),
        CurveKeys(KeyPair(alice.public, eve.secret), folder.pair.public),
    ]
    with ExitStack() as held:
        sockets = [held.enter_context(client(router, keys)) for keys in strangers]
        nobody_is_heard(router, lambda: router.denied >= 1)
        assert not any(socket.poll(0) for socket in sockets)
    assert len(router.connections) <= len(strangers)


def test_revoking_counts_for_new_connections(router, folder, alice):
    keys = CurveKeys(alice, folder.pair.public)
    with client(router, keys):
        assert heard(router, TIMEOUT)
        folder.revoke("alice")
        with client(router, keys):
            assert heard(router) is None
    folder.allow("alice", alice.public)
    with client(router, keys):
        assert heard(router, TIMEOUT)


def test_nobody_new_gets_in_while_the_folder_cannot_be_read(router, folder, alice, tmp_path, caplog):
    (tmp_path / "keys" / "allowed" / "broken.key").write_text("nothing")
    with client(router, CurveKeys(alice, folder.pair.public)):
        nobody_is_heard(router, lambda: "nobody new is let in" in caplog.text)


def test_a_folder_that_cannot_be_read_is_told_at_once(folder, tmp_path):
    (tmp_path / "keys" / "allowed" / "broken.key").write_text("nothing")
    with pytest.raises(InputError, match="holds no public key"):
        Router("tcp://127.0.0.1:0", keys=folder)


def test_a_question_of_another_kind_is_answered_with_no(folder, alice):
    context = zmq.Context()
    try:
        authenticator = Authenticator(context, folder)
        asking = context.socket(zmq.REQ)
        asking.connect("inproc://zeromq.zap.01")
        asking.send_multipart([b"1.0", b"7", b"footwork", b"127.0.0.1", b"", b"NULL"])
        authenticator.answer()
        assert asking.recv_multipart()[:3] == [b"1.0", b"7", b"400"]
    finally:
        context.destroy(linger=0)


def test_with_keys_other_machines_may_reach_it_without_a_warning(folder, caplog):
    Router("tcp://0.0.0.0:0", keys=folder).close()
    assert "can be reached" not in caplog.text
    Router("tcp://0.0.0.0:0").close()
    assert "--curve" in caplog.text
