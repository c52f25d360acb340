"""A line to a host that is driven by hand: time passes when somebody waits for a message."""

from collections import defaultdict, deque
from itertools import count

from footwork.runtime.host import Host

TICKS = 40


class Switchboard:
    """The lines of one host.

    Args:
        host: what they lead to.
        frames: shown frames a tick.
    """

    def __init__(self, host: Host, frames: int) -> None:
        self.host = host
        self.frames = frames
        self.waiting: dict[bytes, deque[bytes]] = defaultdict(deque)
        self.closed: set[bytes] = set()
        self._peers = count()

    def dial(self) -> "InProcessLine":
        return InProcessLine(self, next(self._peers).to_bytes(4, "big"))

    def deliver(self) -> None:
        for peer, data in self.host.outgoing():
            self._put(peer, data)

    def _put(self, peer: bytes, data: bytes) -> None:
        if peer in self.closed:
            self.host.lose(peer, 0)
        else:
            self.waiting[peer].append(data)

    def pass_time(self) -> None:
        if self.host.lockstep:
            self.host.count_anew()
            while self.host.step():
                pass
            self.deliver()
            return
        self.host.tick()
        self.deliver()
        for frame in range(1, self.frames + 1):
            for peer, _, pose in self.host.poses(frame):
                self._put(peer, pose)


class InProcessLine:
    """One line."""

    def __init__(self, switchboard: Switchboard, peer: bytes) -> None:
        self._board = switchboard
        self._peer = peer

    def send(self, data: bytes) -> None:
        self._board.host.receive(self._peer, data, 0)

    def receive(self, seconds: float) -> bytes | None:
        self._board.deliver()
        for _ in range(TICKS):
            if self._board.waiting[self._peer]:
                break
            self._board.pass_time()
        queue = self._board.waiting[self._peer]
        return queue.popleft() if queue else None

    def close(self) -> None:
        self._board.closed.add(self._peer)
        self._board.waiting.pop(self._peer, None)
