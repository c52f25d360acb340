"""One sealed file of arrays: the safetensors layout, with JSON about them and a digest of every byte.

Nothing in such a file is ever executed. The digest is the SHA-256 of the whole file with the digest's own 64
hexadecimal characters read as zeros, so that any changed byte is noticed, the header's included.
"""

import contextlib
import hashlib
import mmap
import os
import stat
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import msgspec
import numpy as np
from numpy.typing import NDArray
from safetensors.numpy import save

from footwork.errors import InputError

MAX_FILE_BYTES = 4 << 30
MAX_HEADER_BYTES = 32 << 20
_UNSEALED = "0" * 64
Data = bytes | mmap.mmap
_KINDS = {"F64": "<f8", "F32": "<f4", "I32": "<i4", "I16": "<i2", "U16": "<u2", "U8": "|u1", "BOOL": "?"}


class _Tensor(msgspec.Struct, forbid_unknown_fields=True):
    """Where one array lies in the data part of the file."""

    dtype: str
    shape: list[int]
    data_offsets: tuple[int, int]


class _Seal(msgspec.Struct):
    """The one entry of the safetensors metadata: a single key keeps the bytes the same from run to run."""

    digest: str
    about: msgspec.Raw


class _Metadata(msgspec.Struct):
    footwork: str


def seal(arrays: Mapping[str, NDArray], about: Any) -> tuple[bytes, str]:
    """The bytes of a file with these arrays and this JSON-able ``about``, and its digest; the same for the same input.

    Raises:
        InputError: where ``about`` is not JSON-able.
    """
    try:
        text = msgspec.json.encode({"about": about, "digest": _UNSEALED}, order="sorted").decode()
    except (TypeError, ValueError) as error:
        raise InputError(f"cannot be written as JSON: {error}", "bundle") from None
    packed = {name: np.ascontiguousarray(arrays[name]) for name in sorted(arrays)}
    data = bytearray(save(packed, metadata={"footwork": text}))
    digest = hashlib.sha256(data).hexdigest()
    # keys are sorted and the header comes first, so the seal is the last run of zeros before the arrays' entries
    place = data.rfind(_UNSEALED.encode(), 0, 8 + int.from_bytes(data[:8], "little"))
    data[place : place + 64] = digest.encode()
    return bytes(data), digest


def unseal(data: Data, where: str) -> tuple[dict[str, NDArray], msgspec.Raw, str]:
    """The arrays (read-only views into ``data``), the JSON about them and the digest of a sealed file.

    Raises:
        InputError: for a file that is cut short, was changed, or is no such file.
    """
    header, start = _header(data, where)
    seal_text = _decode(header.pop("__metadata__", msgspec.Raw(b"{}")), _Metadata, where).footwork
    sealed = _decode(seal_text, _Seal, where)
    _check_digest(data, start, sealed.digest, where)
    arrays = {name: _view(data, start, _decode(entry, _Tensor, where), where) for name, entry in header.items()}
    return arrays, sealed.about, sealed.digest


def _header(data: Data, where: str) -> tuple[dict[str, msgspec.Raw], int]:
    """The entries of the JSON header, and where the arrays begin."""
    length = int.from_bytes(data[:8], "little")
    if len(data) < 8 or length > MAX_HEADER_BYTES or 8 + length > len(data):
        raise InputError("cut short, or not a bundle (a bundle is a safetensors file)", where)
    return _decode(data[8 : 8 + length], dict[str, msgspec.Raw], where), 8 + length


def _decode(text: Any, kind: Any, where: str) -> Any:
    try:
        return msgspec.json.decode(text, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(f"damaged or not a bundle: {error}", where) from None


def decode_about(text: msgspec.Raw, kind: Any, where: str) -> Any:
    """The JSON about the arrays as the type ``kind``.

    Raises:
        InputError: where it does not fit that type.
    """
    return _decode(text, kind, where)


def _check_digest(data: Data, start: int, digest: str, where: str) -> None:
    mark = digest.encode()
    place = data.find(mark, 0, start)
    if len(mark) != 64 or place < 0 or data.find(mark, place + 1, start) >= 0:
        raise InputError("damaged: the digest is not 64 hexadecimal characters", where)
    view = memoryview(data)
    found = hashlib.sha256(view[:place])
    found.update(_UNSEALED.encode())
    found.update(view[place + 64 :])
    if found.hexdigest() != digest:
        raise InputError(f"damaged: its digest is {found.hexdigest()[:12]}..., expected {digest[:12]}...", where)


def _view(data: Data, start: int, tensor: _Tensor, where: str) -> NDArray:
    begin, end = tensor.data_offsets
    kind = _KINDS.get(tensor.dtype)
    if kind is None:
        raise InputError(f"arrays of {tensor.dtype}, expected one of {', '.join(_KINDS)}", where)
    count = 1
    for length in tensor.shape:
        if length < 0:
            raise InputError(f"an array of shape {tensor.shape}, expected lengths of zero or more", where)
        count *= length
    if not 0 <= begin <= end <= len(data) - start or end - begin != count * np.dtype(kind).itemsize:
        raise InputError(f"an array at {begin}..{end} does not fit its shape {tensor.shape} or the file", where)
    return np.frombuffer(data, dtype=kind, count=count, offset=start + begin).reshape(tensor.shape)


def read_bytes(path: Path) -> bytes:
    """The file's bytes, an own copy, so that a file changed under us changes nothing here.

    Raises:
        InputError: for a file that cannot be read, is no regular file or is larger than any bundle.
    """
    with _opened(path) as file:
        return file.read()


def map_bytes(path: Path) -> Data:
    """The file's bytes as a read-only map, whose memory all processes that map the file share.

    A file that is replaced by renaming, as ``publish`` does, leaves its map as it was; one that is cut short or written
    over in place takes its readers down.

    Raises:
        InputError: as ``read_bytes`` does.
    """
    with _opened(path) as file:
        # an empty file cannot be mapped
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) if os.fstat(file.fileno()).st_size else b""


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[BinaryIO]:
    try:
        # a device or a pipe could go on without end, or hang as it is opened
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            raise InputError("cannot be read: not a regular file", path)
        if status.st_size > MAX_FILE_BYTES:
            raise InputError(f"{status.st_size} bytes, expected at most {MAX_FILE_BYTES}", path)
        with path.open("rb") as file:
            yield file
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", path) from None


def publish(path: Path, data: bytes) -> None:
    """Write the file whole or not at all: a temporary beside it, flushed to disk, then renamed over it.

    Raises:
        InputError: where the folder cannot be written to.
    """
    temporary = None
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as file:
            temporary = Path(file.name)
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        # temporary files are private to the user; a published bundle has the rights of any new file
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", path) from None
    finally:
        if temporary is not None:
            with contextlib.suppress(OSError):
                temporary.unlink()


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
