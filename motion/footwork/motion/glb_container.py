"""The container of a GLB file: a header, a chunk of JSON and one of bytes (glTF 2.0, 4.4)."""

import struct
from pathlib import Path

import msgspec

from footwork.errors import InputError
from footwork.motion import gltf_document as g
from footwork.motion.textfile import read_data, write_whole

MAGIC, VERSION = b"glTF", 2
MAX_WRITTEN = 1 << 30  # bytes
_HEADER, _CHUNK = struct.Struct("<4sII"), struct.Struct("<I4s")
_JSON, _BYTES = b"JSON", b"BIN\0"


def write_container(path: str | Path, document: g.Document, blob: bytes) -> None:
    """Write a file, whole or not at all; ``blob`` is the document's one buffer.

    Raises:
        InputError: for a file of more than ``MAX_WRITTEN`` bytes, or one that cannot be written.
    """
    chunks = _chunk(_JSON, g.encode(document), b" ") + _chunk(_BYTES, blob, b"\0")
    size = _HEADER.size + len(chunks)
    if size > MAX_WRITTEN:
        raise InputError(f"would be {size >> 20} MiB long, expected at most {MAX_WRITTEN >> 20}", path)
    write_whole(path, _HEADER.pack(MAGIC, VERSION, size) + chunks)


def _chunk(kind: bytes, data: bytes, padding: bytes) -> bytes:
    data += padding * (-len(data) % 4)
    return _CHUNK.pack(len(data), kind) + data


def read_container(path: str | Path) -> tuple[g.Document, bytes]:
    """The document of a file, and the bytes that it speaks of.

    Raises:
        InputError: for a file that cannot be read, is too long, no GLB of version 2, cut short, or whose JSON is none
            of glTF.
    """
    data = read_data(path)
    if data[:4] != MAGIC or len(data) < _HEADER.size:
        raise InputError("no GLB file, expected one that begins with glTF", path)
    _, version, size = _HEADER.unpack_from(data)
    if version != VERSION:
        raise InputError(f"GLB of version {version}, expected {VERSION}", path)
    if size != len(data):
        raise InputError(f"{len(data)} bytes, but its header says {size}: cut short?", path)
    chunks = _chunks(data, path)
    if not chunks or chunks[0][0] != _JSON:
        raise InputError("no JSON in its first chunk, expected a GLB file", path)
    blob = next((body for kind, body in chunks[1:] if kind == _BYTES), b"")
    return _document(chunks[0][1], path), blob


def _chunks(data: bytes, path: str | Path) -> list[tuple[bytes, bytes]]:
    place, chunks = _HEADER.size, []
    while place < len(data):
        if place + _CHUNK.size > len(data):
            raise InputError(f"ends inside a chunk at byte {place}", path)
        length, kind = _CHUNK.unpack_from(data, place)
        place += _CHUNK.size
        if place + length > len(data):
            raise InputError(f"a chunk of {length} bytes at byte {place}, where {len(data) - place} are left", path)
        chunks.append((kind, data[place : place + length]))
        place += length
    return chunks


def _document(text: bytes, path: str | Path) -> g.Document:
    try:
        document = g.decode(text)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(f"its JSON is none of glTF: {str(error)[:200]}", path) from None
    if document.asset.version.split(".")[0] != str(VERSION):
        raise InputError(f"glTF of version {document.asset.version[:20]!r}, expected 2.0", path)
    return document
