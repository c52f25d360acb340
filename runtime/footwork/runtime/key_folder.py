"""The folder of a server's CURVE keys: its own pair, and the public keys of the clients that it lets in.

``server.key`` is for the clients, ``server.key_secret`` for nobody else, and ``allowed/`` holds one ``NAME.key`` for
each client that may come in.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Self

from footwork.errors import InputError
from footwork.protocol.curve import PUBLIC, SECRET, KeyPair, read_public, require_name, write_public

_SERVER, _ALLOWED = "server", "allowed"


class KeyFolder:
    """A server's keys and the clients that it lets in.

    Args:
        folder: where they are.

    Raises:
        InputError: for a folder without a server's pair of keys.
    """

    def __init__(self, folder: str | Path) -> None:
        self._folder = Path(folder)
        self.pair = KeyPair.read(self._folder / f"{_SERVER}{SECRET}")
        self._seen: object = None
        self._allowed: dict[bytes, str] = {}

    @classmethod
    def create(cls, folder: str | Path) -> Self:
        """Make a folder with a new pair, and nobody allowed.

        Raises:
            InputError: where a pair is there already, or the folder cannot be written to.
        """
        folder = Path(folder)
        try:
            if not folder.is_dir():  # one that is there already stays as open as its owner made it
                folder.mkdir(parents=True, mode=0o700)
            (folder / _ALLOWED).mkdir(exist_ok=True)
        except OSError as error:
            raise InputError(f"cannot be made: {error.strerror}", folder) from None
        KeyPair.new().write(folder, _SERVER)
        return cls(folder)

    @property
    def public_file(self) -> Path:
        """What clients need of the server."""
        return self._folder / f"{_SERVER}{PUBLIC}"

    def allow(self, name: str, public: bytes) -> Path:
        """Let a client in from now on; returns the file that says so.

        Raises:
            InputError: for a name that is none or is there already, and for a key that is there already.
        """
        others = self.allowed()
        if public in others:
            raise InputError(f"the key is there already, as {others[public]}", self._folder)
        path = self._file_of(name)
        write_public(path, public)
        return path

    def revoke(self, name: str) -> None:
        """Let a client in no more; a connection that it has stays until it ends.

        Raises:
            InputError: for a name that is not there, listing those that are.
        """
        try:
            self._file_of(name).unlink()
        except FileNotFoundError:
            names = ", ".join(sorted(self.allowed().values())) or "none"
            raise InputError(f"no client {name!r}, it has {names}", self._folder) from None

    def allowed(self) -> Mapping[bytes, str]:
        """Names of the clients that are let in, by public key; read again where a file has changed.

        Raises:
            InputError: for a folder that cannot be read, or a file in it without a public key.
        """
        try:
            files = sorted((self._folder / _ALLOWED).glob(f"*{PUBLIC}"))
            seen = [(path, path.stat().st_mtime_ns, path.stat().st_size) for path in files]
        except OSError as error:
            raise InputError(f"cannot be read: {error.strerror}", self._folder / _ALLOWED) from None
        if seen != self._seen:
            self._allowed = {read_public(path): path.stem for path in files}
            self._seen = seen
        return self._allowed

    def _file_of(self, name: str) -> Path:
        return self._folder / _ALLOWED / f"{require_name(name)}{PUBLIC}"
