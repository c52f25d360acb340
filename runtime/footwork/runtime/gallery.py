"""Where spectators watch: an XPUB socket with every character's poses, for whoever subscribes, and nothing to say."""

import logging
import math

import numpy as np
import zmq
from msgspec.structs import replace

from footwork.errors import InputError
from footwork.protocol.address import is_ipv6, port_fits
from footwork.protocol.codec import encode
from footwork.protocol.messages import TICK_RATE, Welcome
from footwork.protocol.spectator import SCENE_TOPIC, pose_topic
from footwork.runtime.connections import Connections
from footwork.runtime.pose_message import pose_message
from footwork.runtime.router import is_local
from footwork.runtime.simulation import Simulation

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
        self._scene_due = 0
        self._scene: Welcome | None = None
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

    def show(self, simulation: Simulation, welcome: Welcome, frame: int) -> None:
        """Publish a shown frame of the tick last made; what the scene is made of once a second, and when it changes.

        Args:
            simulation: whose characters are shown; their slots are their public numbers.
            welcome: what sessions are told of the scene.
            frame: 1, 2 ... frame_rate / 30.
        """
        self.look()
        if not len(self._connections):
            return
        tick = simulation.tick
        if tick >= self._scene_due or welcome is not self._scene:
            self._scene, self._scene_due = welcome, tick + TICK_RATE
            self._publish(SCENE_TOPIC, encode(replace(welcome, tick=tick)))
        shown = simulation.show(frame * TICK_RATE / welcome.frame_rate)
        for slot in np.flatnonzero(simulation.world.active).tolist():
            self._publish(pose_topic(slot), encode(pose_message(shown, slot, tick=tick, frame=frame, number=slot)))

    def _publish(self, topic: bytes, data: bytes) -> None:
        self._socket.send_multipart([topic, data], zmq.NOBLOCK)  # PUB sockets drop what a subscriber has no room for

    def close(self) -> None:
        """Close; what spectators have not got yet they miss."""
        self._connections.close()
        self._socket.close(linger=0)
