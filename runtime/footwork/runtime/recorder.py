"""The recorder: it is told what takes effect and writes it from a thread of its own, so that no tick waits for a disk.

What cannot be written ends the recording, not the server: an error is logged and counted, and what was written before
stays readable. Whatever is older than ``FLUSH_SECONDS`` is on the disk, so that a crash loses no more than that.
"""

import hashlib
import logging
import os
import queue
import threading
import time
from io import FileIO
from pathlib import Path

from footwork.errors import InputError
from footwork.runtime.recording import (
    MAGIC,
    SUFFIX,
    AnyRecord,
    Effect,
    End,
    Header,
    State,
    framed,
    framed_soundly,
    made_by,
)

log = logging.getLogger(__name__)

FLUSH_SECONDS = 1.0
MOST_WAITING = 1 << 26
"""Bytes that wait to be written before the disk counts as too slow."""
_RECORD_BYTES = 256  # what a record that waits takes in memory, roughly


def state_digest(slots: bytes, rows: bytes) -> bytes:
    """The digest of all that is remembered of characters: their slots and their rows.  # 16 bytes"""
    return hashlib.blake2b(rows, digest_size=16, key=hashlib.blake2b(slots).digest()).digest()


def new_recording(folder: str | Path, bundle: str = "") -> Path:
    """A name for a recording that starts now, of one of several bundles if named, not yet taken in this folder."""
    stem = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime())
    whose = f"{stem}-{os.getpid()}-{bundle}".rstrip("-")
    names = (f"{whose}{again}{SUFFIX}" for again in ("", *(f"-{n}" for n in range(1, 1000))))
    for path in (Path(folder, name) for name in names):
        if not path.exists():
            return path
    raise InputError("has no free name for another recording", folder)


class Recorder:
    """Writes one recording.

    Args:
        path: the file, which must not exist yet.
        header: what it is made with.

    Attributes:
        errors: how many failures ended it: 0 or 1.
        recorded: the tick up to which everything is on the disk.
        state_tick: the tick of the last state.

    Raises:
        InputError: for a file that exists, or a place that cannot be written to.
    """

    def __init__(self, path: str | Path, header: Header) -> None:
        self.path = Path(path)
        self.errors = 0
        self.recorded = 0
        self.state_tick = 0
        self._tick = 0
        self._waiting: queue.SimpleQueue[tuple[AnyRecord, bytes, bytes] | None] = queue.SimpleQueue()
        self._taken, self._written = 0, 0  # bytes handed over, and those done with
        self._failed = threading.Event()
        self._file = self._create(framed(header))
        self._thread = threading.Thread(target=self._write_all, name="recorder", daemon=True)
        self._thread.start()

    def _create(self, head: bytes) -> FileIO:
        try:
            file = FileIO(self.path, "xb")
            _write(file, MAGIC + head)
            _keep_name(self.path.parent)
        except FileExistsError:
            raise InputError("exists; a recording never takes the place of another", self.path) from None
        except OSError as error:
            raise InputError(f"cannot be written: {error.strerror}", self.path) from None
        return file

    def add(self, effect: Effect) -> None:
        """Record something that takes effect now; never waits."""
        self._hand_over(effect)

    def add_state(self, tick: int, slots: bytes, rows: bytes) -> None:
        """Record the digest of the state after a tick; the digest is made in the recorder's thread."""
        self.state_tick = tick
        self._hand_over(State(tick, bytes(16)), slots, rows)

    def end(self, tick: int) -> None:
        """End the recording after a tick; what waits is still written."""
        self._hand_over(End(tick))
        self._waiting.put(None)

    def wait(self) -> None:
        """Wait until a recording that was ended is on the disk."""
        self._thread.join()

    @property
    def written(self) -> bool:
        """Whether its thread has nothing more to write."""
        return not self._thread.is_alive()

    @property
    def recording(self) -> bool:
        """Whether what happens is still being recorded."""
        return not self._failed.is_set()

    def _hand_over(self, record: AnyRecord, slots: bytes = b"", rows: bytes = b"") -> None:
        if self._failed.is_set():
            return
        if self._taken - self._written > MOST_WAITING:
            self._fail("the disk is too slow")
            return
        self._taken += _RECORD_BYTES + len(slots) + len(rows)
        self._waiting.put((record, slots, rows))

    def _write_all(self) -> None:
        try:
            with self._file:
                while self._write_some():
                    pass
        except OSError as error:
            self._fail(error.strerror or str(error))
        except InputError as error:
            self._fail(str(error))

    def _write_some(self) -> bool:
        """Write what comes within ``FLUSH_SECONDS`` and bring it to the disk; whether there may be more."""
        end, more, pieces, tick = time.monotonic() + FLUSH_SECONDS, True, [], self.recorded
        try:
            while more and (left := end - time.monotonic()) > 0.0:
                item = self._waiting.get(timeout=left)
                more = item is not None
                if item is not None:
                    pieces.append(self._bytes_of(*item))
                    tick = made_by(item[0])
        except queue.Empty:
            pass
        finally:  # what came before a record that cannot be kept is kept
            if pieces and not self._failed.is_set():
                _write(self._file, b"".join(pieces))
                os.fsync(self._file.fileno())
                self.recorded = tick
        return more

    def _bytes_of(self, record: AnyRecord, slots: bytes, rows: bytes) -> bytes:
        self._written += _RECORD_BYTES + len(slots) + len(rows)
        state = isinstance(record, State)
        return framed_soundly(State(record.tick, state_digest(slots, rows)) if state else record)

    def _fail(self, problem: str) -> None:
        self.errors = 1
        self._failed.set()
        log.error("recording %s ends after tick %d: %s", self.path, self.recorded, problem)


def _keep_name(folder: Path) -> None:
    """Bring the names in a folder to the disk, where folders can be opened (not on Windows)."""
    if hasattr(os, "O_DIRECTORY"):
        handle = os.open(folder, os.O_DIRECTORY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _write(file: FileIO, data: bytes) -> None:
    """Write all of it, or leave the file as it was."""
    start, view = file.tell(), memoryview(data)
    try:
        while view:
            view = view[file.write(view) or 0 :]
    except OSError:
        file.truncate(start)
        raise
