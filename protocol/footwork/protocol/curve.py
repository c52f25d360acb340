"""CURVE keys: pairs, the files that hold them, and what a client's socket is given.

The cryptography is libzmq's. A file has the format of zmq.auth's certificates: ``NAME.key`` may be shown to anybody,
``NAME.key_secret`` is for its owner alone. Keys are written in Z85, 40 characters for 32 bytes.
"""

import os
import re
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

import zmq
from zmq.utils import z85

from footwork.errors import InputError

PUBLIC, SECRET = ".key", ".key_secret"
_MOST_BYTES = 1 << 16
_KEY = re.compile(r"[0-9A-Za-z.\-:+=^!/*?&<>()\[\]{}@%$#]{40}")
_NAME = re.compile(r"[0-9A-Za-z_-][0-9A-Za-z._-]{0,63}")
_LINE = re.compile(rf'^\s*(public|secret)-key\s*=\s*"?({_KEY.pattern})"?\s*$', re.MULTILINE)


@dataclass(frozen=True)
class KeyPair:
    """A public key and its secret one, in Z85.  # 40 bytes each"""

    public: bytes
    secret: bytes = field(repr=False)

    @classmethod
    def new(cls) -> Self:
        """A pair that nobody else has."""
        return cls(*zmq.curve_keypair())

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """The pair in a ``.key_secret`` file.

        Raises:
            InputError: for a file that cannot be read or holds no pair that fits together.
        """
        found = _keys_in(Path(path))
        if "secret" not in found:
            raise InputError(f"holds no secret key, expected a file such as NAME{SECRET}", path)
        pair = cls(public=zmq.curve_public(found["secret"]), secret=found["secret"])
        if found.get("public", pair.public) != pair.public:
            raise InputError("its public key does not belong to its secret key", path)
        return pair

    def write(self, folder: Path, name: str) -> tuple[Path, Path]:
        """Write ``NAME.key`` and, for its owner's eyes only, ``NAME.key_secret``; returns both paths.

        Raises:
            InputError: for a name that is none, a file that is there already or a folder that cannot be written to.
        """
        public, secret = folder / f"{require_name(name)}{PUBLIC}", folder / f"{name}{SECRET}"
        if public.exists():
            raise InputError("is there already, and no key is written over", public)
        _write_new(secret, _text(self.public, self.secret), 0o600)
        _write_new(public, _text(self.public), 0o644)
        return public, secret


@dataclass(frozen=True)
class CurveKeys:
    """What a client needs: its own pair, and the public key of the server that it means to speak to."""

    own: KeyPair
    server: bytes

    @classmethod
    def read(cls, own: str | Path, server: str | Path) -> Self:
        """From the client's ``.key_secret`` file and the server's ``.key`` file.

        Raises:
            InputError: for a file without such a key.
        """
        return cls(KeyPair.read(own), read_public(server))

    def put_on(self, socket: zmq.Socket) -> None:
        """Let a socket speak to that server only, as this client; before it connects."""
        socket.set(zmq.CURVE_SERVERKEY, self.server)
        socket.set(zmq.CURVE_PUBLICKEY, self.own.public)
        socket.set(zmq.CURVE_SECRETKEY, self.own.secret)


def read_public(path: str | Path) -> bytes:
    """The public key in a ``.key`` file, in Z85.

    Raises:
        InputError: for a file that cannot be read or holds no public key.
    """
    found = _keys_in(Path(path))
    if "public" not in found:
        raise InputError(f"holds no public key, expected a file such as NAME{PUBLIC}", path)
    return found["public"]


def write_public(path: Path, public: bytes) -> None:
    """Write a public key into a new file.

    Raises:
        InputError: for a file that is there already or cannot be written.
    """
    _write_new(path, _text(public), 0o644)


def is_key(text: str) -> bool:
    """Whether a text has the form of a key: 32 bytes in Z85."""
    if _KEY.fullmatch(text) is None:
        return False
    try:
        return len(z85.decode(text)) == 32
    except (ValueError, struct.error):  # five characters that stand for more than 32 bits
        return False


def require_name(name: str) -> str:
    """The name, if it can be one of a key.

    Raises:
        InputError: otherwise.
    """
    if _NAME.fullmatch(name) is None:
        raise InputError("no name of a key: letters, digits, dots, - and _, at most 64", repr(name))
    return name


def _keys_in(path: Path) -> dict[str, bytes]:
    """The keys in a file by kind, "public" and "secret"."""
    if path.exists() and not path.is_file():
        raise InputError("cannot be read: not a regular file", path)
    try:
        with path.open("rb") as file:
            text = file.read(_MOST_BYTES).decode("ascii", errors="replace")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", path) from None
    return {kind: key.encode() for kind, key in _LINE.findall(text) if is_key(key)}


def _text(public: bytes, secret: bytes | None = None) -> str:
    said = "SECRET key, for its owner alone" if secret else "public key"
    lines = [f"#   ZeroMQ CURVE {said}", "metadata", "curve", f'    public-key = "{public.decode()}"']
    if secret:
        lines.append(f'    secret-key = "{secret.decode()}"')
    return "\n".join(lines) + "\n"


def _write_new(path: Path, text: str, mode: int) -> None:
    try:
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), "w") as file:
            file.write(text)
    except FileExistsError:
        raise InputError("is there already, and no key is written over", path) from None
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", path) from None
