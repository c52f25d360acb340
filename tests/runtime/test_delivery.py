"""What leaves for a peer that does not take all at once."""

from collections import deque

import pytest

from footwork.protocol.codec import decode_from_server, encode
from footwork.protocol.messages import Pose
from footwork.runtime.delivery import Delivery
from footwork.runtime.router import Sent

PEER = b"peer"
MOST = 3


class Pipe:
    """A transport with room for so many messages."""

    def __init__(self, room: int) -> None:
        self.room = room
        self.messages: deque[bytes] = deque()
        self.there = True

    def send(self, peer: bytes, data: bytes) -> Sent:
        if not self.there:
            return Sent.GONE
        if len(self.messages) >= self.room:
            return Sent.DROPPED
        self.messages.append(data)
        return Sent.QUEUED

    def read(self) -> list[bytes]:
        taken, self.messages = list(self.messages), deque()
        return taken


def pose(tick: int, character: int = 0, lost: int = 0) -> Pose:
    return Pose(
        tick=tick,
        frame=1,
        character=character,
        acknowledged=0,
        facing=0.0,
        behaviour=0,
        clip=0,
        source_frame=0,
        transition=False,
        root=bytes(12),
        rotations=bytes(16),
        lost=lost,
    )


@pytest.fixture
def pipe():
    return Pipe(room=2)


@pytest.fixture
def known():
    return {PEER}


@pytest.fixture
def delivery(pipe, known):
    return Delivery(pipe.send, known.__contains__, MOST)


def show_frame(delivery: Delivery, tick: int, *characters: int) -> None:
    show(delivery, tick, *characters or (0,))
    delivery.retry()


def show(delivery: Delivery, tick: int, *characters: int) -> None:
    lost = delivery.begin_frame()
    for character in characters:
        delivery.show(PEER, character, encode(pose(tick, character, lost.get((PEER, character), 0))))


def seen(pipe: Pipe) -> list[tuple[int, int, int]]:
    poses = [decode_from_server(data) for data in pipe.read()]
    return [(shown.tick, shown.character, shown.lost) for shown in poses if isinstance(shown, Pose)]


def test_while_there_is_room_nothing_waits(delivery, pipe):
    assert delivery.tell(PEER, b"a") is Sent.QUEUED
    show_frame(delivery, 1)
    assert not delivery.waiting
    assert pipe.read()[0] == b"a"


def test_a_slow_reader_gets_the_newest_pose_and_is_told_how_many_were_dropped(delivery, pipe):
    for tick in range(1, 8):
        show_frame(delivery, tick)
    assert seen(pipe) == [(1, 0, 0), (2, 0, 0)]
    delivery.retry()
    assert seen(pipe) == [(7, 0, 4)]
    assert not delivery.waiting
    show_frame(delivery, 8)
    assert seen(pipe) == [(8, 0, 0)]
    assert delivery.dropped == 4


def test_more_characters_than_there_is_room_for_at_once_lose_nothing(delivery, pipe):
    show(delivery, 1, *range(5))
    shown = []
    while delivery.waiting:
        shown += seen(pipe)
        delivery.retry()
    assert shown + seen(pipe) == [(1, character, 0) for character in range(5)]


def test_a_character_that_is_gone_is_shown_no_more(delivery, pipe):
    show_frame(delivery, 1, 0, 1)
    show_frame(delivery, 2, 0, 1)
    show_frame(delivery, 3, 1)
    pipe.read()
    delivery.retry()
    assert seen(pipe) == [(3, 1, 1)]


def test_messages_wait_in_order_and_go_before_poses(delivery, pipe):
    show_frame(delivery, 1, 0, 1, 2)
    for data in (b"a", b"b"):
        assert delivery.tell(PEER, data) is Sent.QUEUED
    pipe.read()
    delivery.retry()
    assert pipe.read() == [b"a", b"b"]
    delivery.retry()
    assert seen(pipe) == [(1, 2, 0)]


def test_beyond_the_bound_nothing_waits_and_a_last_word_takes_the_place_of_all(delivery, pipe, known):
    told = [delivery.tell(PEER, b"x") for _ in range(2 + MOST + 2)]
    assert told == [Sent.QUEUED] * (2 + MOST) + [Sent.DROPPED] * 2
    delivery.say_last(PEER, b"bye")
    known.clear()
    assert delivery.tell(PEER, b"more") is Sent.DROPPED
    pipe.read()
    delivery.retry()
    assert pipe.read() == [b"bye"]
    assert not delivery.waiting


def test_nothing_is_kept_for_strangers(delivery, known):
    known.clear()
    assert [delivery.tell(b"stranger", b"x") for _ in range(3)] == [Sent.QUEUED, Sent.QUEUED, Sent.DROPPED]
    assert not delivery.waiting


def test_what_nobody_fetches_is_forgotten_once_the_session_is_over(delivery, known):
    for _ in range(3):
        delivery.tell(PEER, b"x")
    delivery.forget_strangers(0, patience=10)
    known.clear()
    delivery.forget_strangers(100, patience=10)
    assert delivery.waiting
    delivery.forget_strangers(111, patience=10)
    assert not delivery.waiting


def test_peers_that_are_gone_are_named(delivery, pipe):
    for _ in range(3):
        delivery.tell(PEER, b"x")
    pipe.there = False
    assert delivery.retry() == [PEER]
    delivery.forget(PEER)
    assert delivery.retry() == []


def test_poses_of_a_bundle_that_went_are_not_sent_after_the_welcome_of_the_next(delivery, pipe):
    for tick in range(3):
        show(delivery, tick, 0)
    delivery.outdate(PEER)
    delivery.tell(PEER, b"welcome")
    pipe.read()
    delivery.retry()
    assert pipe.read() == [b"welcome"]
    show(delivery, 3, 0)
    delivery.retry()
    (sent,) = map(decode_from_server, pipe.read())
    assert sent == pose(3, lost=1)
    assert not delivery.waiting
