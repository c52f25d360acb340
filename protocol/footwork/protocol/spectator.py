"""Watching without a session: what a server publishes for spectators, and a client that subscribes to it."""

import time
from collections.abc import Iterable, Iterator
from typing import Self

import zmq

from footwork.protocol import messages as m
from footwork.protocol.address import connect
from footwork.protocol.codec import SERVER_MESSAGE_BYTES, decode_from_server
from footwork.protocol.curve import CurveKeys
from footwork.protocol.errors import MALFORMED, PeerError, RefusedError

SCENE_TOPIC = b"scene"
POSES_TOPIC = b"pose/"
DEFAULT_GALLERY = "tcp://127.0.0.1:5556"
# Two frames of a crowd; beyond that a spectator that does not look misses what is new.
_QUEUE = 1024


def pose_topic(number: int) -> bytes:
    """Under which the poses of a character are published: five digits, so that none is the beginning of another."""
    return b"pose/%05d" % number


class Spectator:
    """Looks at a server's characters; also a context manager.

    Args:
        address: where the server publishes, such as ``tcp://127.0.0.1:5556``.
        characters: public numbers of those to look at, all where not given.
        timeout: how long to wait for the scene, which comes once a second.
        curve: the client's keys and the server's, for a server that lets in only those it knows.

    Attributes:
        scene: what the characters are made of, in the form of a welcome.

    Raises:
        LocalError: for an address that is none.
        RefusedError: where no scene comes in time (code ``timeout``).
    """

    def __init__(
        self,
        address: str = DEFAULT_GALLERY,
        *,
        characters: Iterable[int] | None = None,
        timeout: float = 5.0,
        curve: CurveKeys | None = None,
    ) -> None:
        self._socket = zmq.Context.instance().socket(zmq.SUB)
        self._socket.set(zmq.MAXMSGSIZE, SERVER_MESSAGE_BYTES)
        self._socket.set(zmq.RCVHWM, _QUEUE)
        if curve is not None:
            curve.put_on(self._socket)
        try:
            connect(self._socket, address, DEFAULT_GALLERY)
            self._socket.subscribe(SCENE_TOPIC)
            scene = self.receive(timeout)
            if not isinstance(scene, m.Welcome):
                raise RefusedError("timeout", f"no scene in {timeout:g} s")
        except BaseException:
            self.close()
            raise
        self.scene = scene
        for topic in [POSES_TOPIC] if characters is None else map(pose_topic, characters):
            self._socket.subscribe(topic)

    def receive(self, timeout: float) -> m.Welcome | m.Pose | None:
        """The next pose or scene, None where none comes in ``timeout`` seconds.

        Raises:
            PeerError: for a server that publishes anything else.
        """
        if not self._socket.poll(round(1000.0 * timeout)):
            return None
        frames = self._socket.recv_multipart()
        message = decode_from_server(frames[-1])
        if len(frames) != 2 or not isinstance(message, m.Welcome | m.Pose):
            raise PeerError(MALFORMED, f"{type(message).__name__.lower()} in {len(frames)} frames, expected a pose")
        return message

    def poses(self, timeout: float = 5.0) -> Iterator[m.Pose]:
        """Poses as they come, until none does for ``timeout`` seconds; ``scene`` is kept up to date meanwhile."""
        end = time.monotonic() + timeout
        while (left := end - time.monotonic()) > 0.0:
            message = self.receive(left)
            if isinstance(message, m.Welcome):
                self.scene = message
            elif message is not None:
                yield message
                end = time.monotonic() + timeout

    def close(self) -> None:
        """Look no more."""
        self._socket.close(linger=0)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()
