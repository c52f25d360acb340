"""Watching without a session: what a server publishes for spectators, and a client that subscribes to it."""

import time
from collections.abc import Iterable, Iterator
from typing import Self

import zmq

from footwork.protocol import messages as m
from footwork.protocol.address import connect
from footwork.protocol.codec import SERVER_MESSAGE_BYTES, decode_from_server
from footwork.protocol.curve import CurveKeys
from footwork.protocol.errors import BUNDLE, MALFORMED, PeerError, RefusedError

DEFAULT_GALLERY = "tcp://127.0.0.1:5556"
# Two frames of a crowd; beyond that a spectator that does not look misses what is new.
_QUEUE = 1024


class Topics:
    """Under which a bundle's characters are published.

    Args:
        bundle: its name; empty for the first of a server's bundles.
    """

    def __init__(self, bundle: str = "") -> None:
        prefix = f"bundle/{bundle}/" if bundle else ""
        self.scene = f"{prefix}scene".encode()
        self.poses = f"{prefix}pose/".encode()

    def pose(self, number: int) -> bytes:
        """The topic of a character's poses: five digits, so that none is the beginning of another."""
        return self.poses + b"%05d" % number


class Spectator:
    """Looks at a server's characters; also a context manager.

    Args:
        address: where the server publishes, such as ``tcp://127.0.0.1:5556``.
        characters: public numbers of those to look at, all where not given.
        timeout: how long to wait for the scene, which comes once a second, and for poses unless said otherwise.
        curve: the client's keys and the server's, for a server that lets in only those it knows.
        bundle: whose characters to look at, those of the server's first unless given.

    Attributes:
        scene: what the characters are made of, in the form of a welcome.

    Raises:
        LocalError: for an address that is none.
        RefusedError: where no scene comes in time (code ``timeout``), or there is no such bundle (``bundle``).
    """

    def __init__(
        self,
        address: str = DEFAULT_GALLERY,
        *,
        characters: Iterable[int] | None = None,
        timeout: float = 5.0,
        curve: CurveKeys | None = None,
        bundle: str = "",
    ) -> None:
        self._timeout = timeout
        self._socket = zmq.Context.instance().socket(zmq.SUB)
        self._socket.set(zmq.MAXMSGSIZE, SERVER_MESSAGE_BYTES)
        self._socket.set(zmq.RCVHWM, _QUEUE)
        if curve is not None:
            curve.put_on(self._socket)
        try:
            connect(self._socket, address, DEFAULT_GALLERY)
            topics, self.scene = self._find(bundle)
        except BaseException:
            self.close()
            raise
        for topic in [topics.poses] if characters is None else map(topics.pose, characters):
            self._socket.subscribe(topic)

    def _find(self, bundle: str) -> tuple[Topics, m.Welcome]:
        """Where a bundle is shown: the first one's scene tells its own name and those of the others."""
        first = self._scene_at(Topics())
        if bundle in ("", first.bundle):
            return Topics(), first
        if bundle not in first.bundles:
            raise RefusedError(BUNDLE, f"no bundle {bundle!r}", valid=first.bundles)
        self._socket.unsubscribe(Topics().scene)
        return Topics(bundle), self._scene_at(Topics(bundle))

    def _scene_at(self, topics: Topics) -> m.Welcome:
        self._socket.subscribe(topics.scene)
        end = time.monotonic() + self._timeout
        while (left := end - time.monotonic()) > 0.0 and self._socket.poll(round(1000.0 * left)):
            frames = self._socket.recv_multipart()
            if frames[0] == topics.scene:  # and not one that was on its way from a topic before
                return _scene(_message(frames))
        raise RefusedError("timeout", f"no scene in {self._timeout:g} s")

    def receive(self, timeout: float) -> m.Welcome | m.Pose | None:
        """The next pose or scene, None where none comes in ``timeout`` seconds.

        Raises:
            PeerError: for a server that publishes anything else.
        """
        if not self._socket.poll(round(1000.0 * timeout)):
            return None
        return _message(self._socket.recv_multipart())

    def poses(self, timeout: float | None = None) -> Iterator[m.Pose]:
        """Poses as they come, until none does for ``timeout`` seconds; ``scene`` is kept up to date meanwhile."""
        timeout = self._timeout if timeout is None else timeout
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


def _message(frames: list[bytes]) -> m.Welcome | m.Pose:
    message = decode_from_server(frames[-1])
    if len(frames) != 2 or not isinstance(message, m.Welcome | m.Pose):
        raise PeerError(MALFORMED, f"{type(message).__name__.lower()} in {len(frames)} frames, expected a pose")
    return message


def _scene(message: m.Welcome | m.Pose) -> m.Welcome:
    if not isinstance(message, m.Welcome):
        raise PeerError(MALFORMED, "a pose as a scene")
    return message
