"""Text files from outside, read with bounds: lines of bytes, and rows of numbers that name the bad line."""

import contextlib
import os
from collections.abc import Sequence
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError

MAX_BYTES = 64 * 2**20  # ten minutes at 120 frames a second
MAX_JOINTS = 1000
# No length, angle or time in a motion file comes near it, and products of numbers under it stay finite.
MAX_SIZE = 1e9


def read_lines(path: str | Path) -> list[bytes]:
    """The lines of a file without their ends (\\n, \\r\\n or \\r) and without a byte order mark.

    Raises:
        InputError: for a file that cannot be read, is empty, or is longer than ``MAX_BYTES``.
    """
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
    return data.removeprefix(b"\xef\xbb\xbf").splitlines()


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


def number_rows(
    rows: Sequence[Sequence[bytes]], lines: Sequence[int], width: int, path: str | Path
) -> NDArray[np.float64]:
    """Rows of words as numbers.  # (len(rows), width)

    Args:
        rows: the words of each row.
        lines: line number of each row in the file, from 1.
        width: how many numbers each row must have.
        path: the file, for messages.

    Raises:
        InputError: for a row of another length, or a word that is no finite number of ordinary size.
    """
    for row, line in zip(rows, lines, strict=True):
        if len(row) != width:
            raise InputError(f"{len(row)} numbers, expected {width}", f"{path}:{line}")
    flat = list(chain.from_iterable(rows))
    try:
        values = np.fromiter(map(float, flat), np.float64, len(flat))
        sound = bool((np.abs(values) < MAX_SIZE).all()) and b"_" not in b" ".join(flat)
    except ValueError:
        values, sound = np.empty(0), False
    if not sound:
        _raise_first_bad(rows, lines, path)
    return values.reshape(len(rows), width)


def _raise_first_bad(rows: Sequence[Sequence[bytes]], lines: Sequence[int], path: str | Path) -> None:
    for row, line in zip(rows, lines, strict=True):
        for word in row:
            number(word, f"{path}:{line}")


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
