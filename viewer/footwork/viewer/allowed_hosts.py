"""Who may speak to the bridge: names that it is called by, and pages that came from there.

A page from anywhere can open a socket to this machine, and a name that its owner controls can be made to mean
127.0.0.1 (DNS rebinding). So the Host header must be one of the bridge's own names, and a socket's Origin must be one
of them too; browsers let no page change either.
"""

from collections.abc import Iterable
from urllib.parse import urlsplit

LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


class AllowedHosts:
    """The names that a bridge goes by.

    Args:
        port: where it listens; its loopback names are allowed at this port.
        more: further names as they stand in a Host header, such as ``game.local:8000``.
    """

    def __init__(self, port: int, more: Iterable[str] = ()) -> None:
        self._names = frozenset([*(f"{name}:{port}" for name in LOOPBACK), *(name.lower() for name in more)])

    def __str__(self) -> str:
        return ", ".join(sorted(self._names))

    def has_host(self, host: str | None) -> bool:
        """Whether a Host header is one of the names."""
        return host is not None and host.lower() in self._names

    def has_origin(self, origin: str | None) -> bool:
        """Whether an Origin header is a page that the bridge served."""
        if origin is None:
            return False
        try:
            parts = urlsplit(origin)
        except ValueError:  # such as http://[
            return False
        return parts.scheme in ("http", "https") and parts.netloc.lower() in self._names
