"""Text files from outside, read with bounds: lines of bytes, and rows of numbers that name the bad line."""

import contextlib
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError

MAX_BYTES = 64 * 2**20  # ten minutes at 120 frames a second
MAX_JOINTS = 1000
MAX_NAME = 200
# No length, angle or time in a motion file comes near it, and products of numbers under it stay finite.
MAX_SIZE = 1e9


def read_lines(path: str | Path) -> list[bytes]:
    """The lines of a file without their ends (\\n, \\r\\n or \\r) and without a byte order mark.

    Raises:
        InputError: for a file that cannot be read, is empty, or is longer than ``MAX_BYTES``.
    """
    return lines_of(read_data(path))


def lines_of(data: bytes) -> list[bytes]:
    """The lines of a file that was read, as ``read_lines`` gives them."""
    return data.removeprefix(b"\xef\xbb\xbf").splitlines()


def read_data(path: str | Path) -> bytes:
    """The bytes of a file; errors as of ``read_lines``."""
    try:
        with Path(path).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror}), expected a file", path) from None
    except ValueError as error:
        raise InputError(f"cannot be read ({error}), expected a file", repr(path)) from None
    if len(data) > MAX_BYTES:
        raise InputError(f"is longer than {MAX_BYTES >> 20} MiB, expected one recording", path)
    if not data.strip():
        raise InputError("is empty", path)
    return data


def words(line: bytes) -> list[str]:
    """The words of a line; bytes that are no UTF-8 become U+FFFD."""
    return line.decode("utf-8", errors="replace").split()


def number(word: str | bytes, where: object) -> float:
    """One finite number of ordinary size.

    Raises:
        InputError: for anything else, NaN and 1e999 included.
    """
    text = word.decode("utf-8", errors="replace") if isinstance(word, bytes) else word
    try:
        value = float(text)
    except ValueError:
        raise InputError(f"{text[:40]!r} is not a number", where) from None
    if "_" in text or not abs(value) < MAX_SIZE:
        raise InputError(f"{text[:40]!r} is not a finite number under {MAX_SIZE:g}", where)
    return value


def whole_number(word: str | bytes, where: object) -> int:
    """One whole number, zero or more.

    Raises:
        InputError: for anything else.
    """
    value = number(word, where)
    if value < 0 or value != int(value):
        raise InputError(f"{value:g} is not a whole number of zero or more", where)
    return int(value)


def number_rows(texts: Sequence[bytes], lines: Sequence[int], width: int, path: str | Path) -> NDArray[np.float64]:
    """Lines of numbers as an array.  # (len(texts), width)

    Args:
        texts: numbers between white space.
        lines: line number of each text in the file, from 1.
        width: how many numbers each must hold.
        path: the file, for messages.

    Raises:
        InputError: for a line with another count, or a word that is no finite number of ordinary size.
    """
    values = _loaded(texts) if width and texts else np.empty((len(texts), width))
    # loadtxt passes over empty lines, so the number of rows tells whether there were any.
    if not width or values.shape != (len(texts), width) or not (np.abs(values) < MAX_SIZE).all():
        _require_rows(texts, lines, width, path)
    return values


def _loaded(texts: Sequence[bytes]) -> NDArray[np.float64]:
    """The numbers, or an empty array where something is wrong with them."""
    try:
        return np.loadtxt(texts, comments=None, ndmin=2) if any(texts) else np.empty((0, 0))
    except ValueError:
        return np.empty((0, 0))


def _require_rows(texts: Sequence[bytes], lines: Sequence[int], width: int, path: str | Path) -> None:
    """Find the first bad line and raise InputError."""
    for text, line in zip(texts, lines, strict=True):
        row = text.split()
        if len(row) != width:
            raise InputError(f"{len(row)} numbers, expected {width}", f"{path}:{line}")
        for word in row:
            number(word, f"{path}:{line}")
    if width:
        raise InputError("numbers that cannot be read", f"{path}:{lines[0]}")


def write_whole(path: str | Path, data: bytes) -> None:
    """Write a file so that nothing half-written ever bears its name.

    Raises:
        InputError: where it cannot be written.
    """
    target = Path(path)
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        part.write_bytes(data)
        part.replace(target)
    except OSError as error:
        with contextlib.suppress(OSError):
            part.unlink()
        raise InputError(f"cannot be written ({error.strerror})", path) from None
