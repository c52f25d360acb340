"""The folder that the reproduction writes: one page and one JSON file, each always whole."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from footwork.errors import InputError

PAGE, NUMBERS = "index.html", "reproduction.json"


def prepared(folder: Path) -> Path:
    """The folder, made if need be.

    Raises:
        InputError: where it cannot be made or written into.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _publish(folder / ".writable", "")
        (folder / ".writable").unlink()
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror}), expected a folder to write into", folder) from None
    return folder


def write(folder: Path, page: str, report: Mapping[str, Any]) -> None:
    """Write the page and the numbers, each replaced only once its new version is whole.

    Raises:
        InputError: where they cannot be written.
    """
    try:
        _publish(folder / PAGE, page)
        _publish(folder / NUMBERS, json.dumps(report, allow_nan=False, indent=1) + "\n")
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", folder) from None


def _publish(path: Path, text: str) -> None:
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)
