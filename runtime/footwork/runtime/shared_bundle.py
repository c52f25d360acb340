"""A bundle in memory that all servers on a machine share which serve the same one.

Each server maps a copy that is named by its digest, kept in a folder of the servers' own and never written to again. So
whatever becomes of the file that it was read from, the map stays as it was verified; a file that is cut short while
it is mapped would take its readers down.
"""

from pathlib import Path

from footwork.errors import InputError
from footwork.motion import tensor_file
from footwork.motion.bundle import Bundle, decode_bundle, read_bundle


def shared_bundle(path: Path, store: Path) -> Bundle:
    """The bundle in a file, its arrays as views of a mapped copy in the folder ``store``.

    Raises:
        InputError: for a file that is no sound bundle, and a folder that cannot be written to.
    """
    data = tensor_file.read_bytes(path)
    digest = decode_bundle(data, str(path)).digest
    copy = store / f"{digest}.footwork"
    try:
        mapped = read_bundle(copy, mapped=True)
        if mapped.digest == digest:
            return mapped
    except InputError:  # not there yet, or damaged
        pass
    _publish(copy, data)
    return read_bundle(copy, mapped=True)


def _publish(copy: Path, data: bytes) -> None:
    try:
        copy.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be made: {error.strerror}", copy.parent) from None
    tensor_file.publish(copy, data)
