"""TOML files that say how data are to be read, such as name tables: read with bounds, unknown keys refused."""

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from footwork.errors import InputError

MAX_BYTES = 1 << 20


def read_toml(path: Path, expected: str) -> dict[str, Any]:
    """The values of a TOML file.

    Args:
        path: the file.
        expected: what it should be, for messages: ``a name table``.

    Raises:
        InputError: for a file that cannot be read, is longer than ``MAX_BYTES`` or is not TOML.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise InputError(f"cannot be read ({reason}), expected {expected} in TOML", path) from None
    if len(data) > MAX_BYTES:
        raise InputError(f"is longer than {MAX_BYTES} bytes, expected {expected} in TOML", path)
    try:
        return tomllib.loads(data.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(f"is not TOML ({error})", path) from None


def only_keys(values: dict[str, Any], allowed: Sequence[str], where: str) -> None:
    """Raise InputError unless all keys are among ``allowed``."""
    unknown = [key for key in values if key not in allowed]
    if unknown:
        raise InputError(f"unknown key {unknown[0]!r}, expected {', '.join(allowed)}", where)


def text_of(values: dict[str, Any], key: str, where: str) -> str:
    """The text under a key; InputError where there is none."""
    value = values.get(key)
    if not isinstance(value, str):
        raise InputError(f"{key} is {shown(value)}, expected a text", where)
    return value


def shown(value: object) -> str:
    """A value as messages show it."""
    return "missing" if value is None else repr(value)[:60]
