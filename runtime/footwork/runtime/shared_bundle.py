"""A bundle in memory that all servers on a machine share which serve the same one.

Each server maps a copy that is named by its digest, kept in a folder of the servers' own and never written to again. So
whatever becomes of the file that it was read from, the map stays as it was verified; a file that is cut short while
it is mapped would take its readers down.

A server holds a lock on its copy for as long as it has the bundle, and whoever comes removes the copies that nobody
holds any more. A copy that is removed while somebody maps it (by a lock that the file system does not keep) stays as it
is for them; only, the next server makes another.
"""

import os
import sys
import weakref
from contextlib import suppress
from pathlib import Path

from footwork.errors import InputError
from footwork.motion import tensor_file
from footwork.motion.bundle import Bundle, decode_bundle, read_bundle

if sys.platform != "win32":
    import fcntl

_SUFFIX = ".footwork"
_TRIES = 8


def shared_bundle(path: Path, store: Path) -> Bundle:
    """The bundle in a file, its arrays as views of a mapped copy in the folder ``store``.

    Raises:
        InputError: for a file that is no sound bundle, and a folder that cannot be written to.
    """
    data = tensor_file.read_bytes(path)
    digest = decode_bundle(data, str(path)).digest
    copy = store / f"{digest}{_SUFFIX}"
    for _ in range(_TRIES):
        bundle = _held(copy, digest)
        if bundle is not None:
            _remove_unused(store)
            return bundle
        _publish(copy, data)
    raise InputError("its copies vanish as soon as they are made", copy)


def _held(copy: Path, digest: str) -> Bundle | None:
    """The bundle of a copy, held for as long as the bundle is there; None where it is not there, or another."""
    try:
        handle = os.open(copy, os.O_RDONLY)
    except OSError:
        return None
    with suppress(InputError, OSError):  # damaged, or removed by whoever had the lock before us
        _lock(handle)
        bundle = read_bundle(copy, mapped=True)
        if bundle.digest == digest and os.path.samestat(os.fstat(handle), copy.stat()):
            weakref.finalize(bundle, os.close, handle)
            return bundle
    os.close(handle)
    return None


def _remove_unused(store: Path) -> None:
    """Remove the copies that no server holds."""
    if sys.platform == "win32":  # a file that is mapped cannot be removed there, and locks are others
        return
    for copy in store.glob(f"*{_SUFFIX}"):
        with suppress(OSError):
            handle = os.open(copy, os.O_RDONLY)
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                copy.unlink()
            finally:
                os.close(handle)


def _lock(handle: int) -> None:
    """Share a copy with others who hold it, waiting for whoever is about to remove it; given up with the handle."""
    if sys.platform != "win32":
        with suppress(OSError):  # some file systems have no locks
            fcntl.flock(handle, fcntl.LOCK_SH)


def _publish(copy: Path, data: bytes) -> None:
    try:
        copy.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be made: {error.strerror}", copy.parent) from None
    tensor_file.publish(copy, data)
