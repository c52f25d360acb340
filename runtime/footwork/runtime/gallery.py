"""Where spectators watch: an XPUB socket with every character's poses, for whoever subscribes, and nothing to say."""

import logging
import math
from collections.abc import Iterable

import zmq
from msgspec.structs import replace

from footwork.errors import InputError
from footwork.protocol.address import is_ipv6, port_fits
from footwork.protocol.codec import encode
from footwork.protocol.messages import TICK_RATE, Welcome
from footwork.runtime.connections import Connections
from footwork.runtime.limits import Limits
from footwork.runtime.router import Router, is_local
from footwork.runtime.scene import Scene

log = logging.getLogger(__name__)

_TOPIC_BYTES = 64
_SUBSCRIPTIONS_AT_ONCE = 1024


class Gallery:
    """A bound XPUB socket.

    Args:
        socket: the XPUB socket, with keys asked for or not; closed with this.
        bind: where to listen; port 0 or ``*`` takes any free one, told by ``address``.
        queue: how many messages may wait for a spectator before more are dropped.
        most: how many spectators there may be.

    Raises:
        InputError: for an address that cannot be bound.
    """

    def __init__(self, socket: zmq.Socket, bind: str, *, queue: int, most: int) -> None:
        self._socket = socket
        self._told: dict[bytes, tuple[Welcome, int]] = {}  # topic -> what was said there, and when to say it again
        options = {zmq.SNDHWM: queue, zmq.MAXMSGSIZE: _TOPIC_BYTES, zmq.IPV6: is_ipv6(bind), zmq.TCP_KEEPALIVE: 1}
        for option, value in options.items():
            socket.set(option, value)
        # Subscriptions are no messages: all of them that a spectator ever sent are bounded together.
        self._connections = Connections(socket, most, silent=math.inf)
        try:
            self.address = self._bind(bind)
        except InputError:
            self.close()
            raise
        if not is_local(self.address):
            log.warning("%s can be reached from other machines, and whoever may connect to it can watch", self.address)

    def _bind(self, address: str) -> str:
        if not port_fits(address):
            raise InputError("cannot bind: a port is at most 65535", address)
        try:
            self._socket.bind(address)
        except zmq.ZMQError as error:
            problem = f"cannot bind: {error.strerror}, expected such as tcp://127.0.0.1:5556"
            raise InputError(problem, address) from None
        return self._socket.get_string(zmq.LAST_ENDPOINT)

    def look(self) -> None:
        """Bound the connections, and pass over what they say: an XSUB socket can send anything."""
        self._connections.look()
        for _ in range(_SUBSCRIPTIONS_AT_ONCE):
            try:
                self._socket.recv(zmq.NOBLOCK)
            except zmq.Again:
                return

    def show(self, scenes: Iterable[Scene], frame: int) -> None:
        """Publish a shown frame of the tick last made; what a scene is made of once a second, and when it changes.

        Args:
            scenes: whose characters are shown; their slots are their public numbers.
            frame: 1, 2 ... frame_rate / 30.
        """
        self.look()
        if len(self._connections):
            for scene in scenes:
                self._show(scene, frame)

    def _show(self, scene: Scene, frame: int) -> None:
        simulation, welcome, topics = scene.simulation, scene.welcome, scene.topics
        tick = simulation.tick
        told, due = self._told.get(topics.scene, (None, 0))
        if tick >= due or welcome is not told:
            self._told[topics.scene] = welcome, tick + TICK_RATE
            self._publish(topics.scene, encode(replace(welcome, tick=tick)))
        simulation.show(frame * TICK_RATE / welcome.frame_rate)
        slots = simulation.world.slots.tolist()
        poses = scene.messages.of([(slot, slot, 0, 0) for slot in slots], tick=tick, frame=frame)
        for slot, pose in zip(slots, poses, strict=True):
            self._publish(topics.pose(slot), pose)

    def _publish(self, topic: bytes, data: bytes) -> None:
        self._socket.send_multipart([topic, data], zmq.NOBLOCK)  # PUB sockets drop what a subscriber has no room for

    def close(self) -> None:
        """Close; what spectators have not got yet they miss."""
        self._connections.close()
        self._socket.close(linger=0)


def open_gallery(router: Router, bind: str, limits: Limits) -> Gallery:
    """Where those may watch who may connect to a router; where it cannot be, the router is closed too.

    Raises:
        InputError: for an address that cannot be bound.
    """
    socket = router.socket(zmq.XPUB)
    try:
        return Gallery(socket, bind, queue=2 * limits.characters, most=limits.connections)
    except InputError:
        socket.close(linger=0)
        router.close()
        raise
