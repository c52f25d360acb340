"""A server that runs, and a raw peer of it."""

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import zmq

from footwork.motion.bundle import Bundle
from footwork.protocol import messages as m
from footwork.protocol.client import Client
from footwork.protocol.codec import decode_from_server
from footwork.runtime.server import Server
from toy_bundle import toy_bundle

BUNDLE = toy_bundle()
TIMEOUT = 60
"""For how long a busy machine may keep one waiting, seconds."""


@contextmanager
def serving(
    until: Callable[[], bool] | None = None, bundle: Bundle | Mapping[str, Bundle] = BUNDLE, **options
) -> Iterator[Server]:
    server = Server(bundle, bind="tcp://127.0.0.1:0", **options)
    thread = threading.Thread(target=server.run, args=(until,))
    thread.start()
    try:
        yield server
    finally:
        server.stop()
        thread.join(TIMEOUT)
        assert not thread.is_alive()


@contextmanager
def stranger(server: Server) -> Iterator[zmq.Socket]:
    socket = zmq.Context.instance().socket(zmq.DEALER)
    socket.set(zmq.LINGER, 0)
    socket.connect(server.address)
    try:
        yield socket
    finally:
        socket.close()


def client_of(server: Server, **options: Any) -> Client:
    """A client of ours that waits for as long as it has to."""
    return Client(server.address, timeout=TIMEOUT, **options)


def answer(socket: zmq.Socket) -> m.FromServer:
    assert socket.poll(1000 * TIMEOUT), "no answer"
    return decode_from_server(socket.recv())


def ticks(client: Client, count: int) -> list[int]:
    """Tick numbers of the first frames of the next ``count`` ticks."""
    poses = client.poses()
    found = []
    while len(found) < count:
        pose = next(poses)
        if pose.frame == 1:
            found.append(pose.tick)
    return found


def pose_that_acknowledges(client: Client, sequence: int) -> m.Pose:
    return next(pose for pose in client.poses() if pose.acknowledged >= sequence)


def consecutive(numbers: list[int]) -> bool:
    return numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def until(condition, seconds=TIMEOUT):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    assert condition()
