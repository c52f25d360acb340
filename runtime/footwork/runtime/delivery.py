"""What leaves for clients: in order and whole, but for the poses that a slow reader has no use for any more.

While the transport takes all, nothing is kept here. Once it takes no more for a peer, that peer has a backlog: messages
in order, up to a bound, and of every character the newest pose, which counts those that were dropped before it.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from footwork.runtime.router import Sent


@dataclass
class Backlog:
    """What waits for one peer.

    Args:
        messages: all but poses, oldest first.
        poses: the newest of each character, by number, and how many dropped before it that one tells of.
        dropped: of characters without a pose of this frame as yet, how many were dropped since the last one sent.
        stale_since: when it was first seen that the peer has no session, nanoseconds.
        closed: whether nothing may follow what waits.
        outdated: whether the poses are not to be sent any more, only counted.
    """

    messages: deque[bytes] = field(default_factory=deque)
    poses: dict[int, tuple[bytes, int]] = field(default_factory=dict)
    dropped: dict[int, int] = field(default_factory=dict)
    stale_since: int | None = None
    closed: bool = False
    outdated: bool = False


class Delivery:
    """Sends to all peers.

    Args:
        send: hands a message to the transport.
        known: whether a peer has a session; for others nothing is kept that the transport does not take.
        most: how many messages may wait for a peer, poses apart.

    Attributes:
        dropped: poses dropped, and messages to peers without a session.
    """

    def __init__(self, send: Callable[[bytes, bytes], Sent], known: Callable[[bytes], bool], most: int) -> None:
        self.dropped = 0
        self._send = send
        self._known = known
        self._most = most
        self._backlogs: dict[bytes, Backlog] = {}

    @property
    def waiting(self) -> bool:
        """Whether anything waits."""
        return bool(self._backlogs)

    def tell(self, peer: bytes, data: bytes) -> Sent:
        """Send a message now or later; ``DROPPED`` where too many wait already, or the peer has no session."""
        backlog = self._backlogs.get(peer)
        if backlog is None:
            sent = self._send(peer, data)
            if sent is not Sent.DROPPED:
                return sent
            if not self._known(peer):
                self.dropped += 1
                return sent
            backlog = self._backlogs[peer] = Backlog()
        if backlog.closed or len(backlog.messages) >= self._most:
            return Sent.DROPPED
        backlog.messages.append(data)
        return Sent.QUEUED

    def say_last(self, peer: bytes, data: bytes) -> None:
        """Let a message take the place of all that waits for a peer, and of what would follow."""
        self._backlogs[peer] = Backlog(messages=deque([data]), closed=True)

    def begin_frame(self) -> dict[tuple[bytes, int], int]:
        """Give up the poses that wait: those of another frame are to follow.

        Returns:
            By peer and number of a character how many of its poses were dropped, for the next one to tell.
        """
        for backlog in self._backlogs.values():
            self.dropped += len(backlog.poses)
            backlog.dropped = {number: lost + 1 for number, (_, lost) in backlog.poses.items()}
            backlog.poses, backlog.outdated = {}, False
        return {
            (peer, number): lost for peer, backlog in self._backlogs.items() for number, lost in backlog.dropped.items()
        }

    def outdate(self, peer: bytes) -> None:
        """Send none of the poses that wait for a peer; those of the next frame tell that they were dropped."""
        if peer in self._backlogs:
            self._backlogs[peer].outdated = True

    def show(self, peer: bytes, number: int, pose: bytes) -> Sent:
        """Send the pose of a character, which tells what ``begin_frame`` said, or keep it until there is room."""
        backlog = self._backlogs.get(peer)
        if backlog is None:
            sent = self._send(peer, pose)
            if sent is Sent.DROPPED:
                self._backlogs[peer] = Backlog(poses={number: (pose, 0)})
            return sent
        backlog.poses[number] = pose, backlog.dropped.pop(number, 0)
        return Sent.QUEUED

    def retry(self) -> list[bytes]:
        """Send what waits, as far as there is room; the peers that are gone."""
        return [peer for peer, backlog in list(self._backlogs.items()) if self._retry(peer, backlog) is Sent.GONE]

    def _retry(self, peer: bytes, backlog: Backlog) -> Sent:
        while backlog.messages:
            sent = self._send(peer, backlog.messages[0])
            if sent is not Sent.QUEUED:
                return sent
            backlog.messages.popleft()
        if backlog.outdated:
            return Sent.DROPPED
        for number in list(backlog.poses):
            sent = self._send(peer, backlog.poses[number][0])
            if sent is not Sent.QUEUED:
                return sent
            del backlog.poses[number]
        del self._backlogs[peer]
        return Sent.QUEUED

    def forget(self, peer: bytes) -> None:
        """Keep nothing for a peer."""
        self._backlogs.pop(peer, None)

    def forget_strangers(self, now: int, patience: int) -> None:
        """Keep nothing for peers that have had no session for ``patience`` nanoseconds."""
        for peer, backlog in list(self._backlogs.items()):
            if self._known(peer):
                continue
            if backlog.stale_since is None:
                backlog.stale_since = now
            elif now - backlog.stale_since > patience:
                del self._backlogs[peer]
