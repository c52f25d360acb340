"""Messages to bytes and back: one reused encoder, and one reused decoder a direction.

What msgspec lets through by itself, and what becomes of it here: NaN and infinities are refused by the bounds of
every float; a repeated key is taken at its last value, except ``type``, which must not change; unknown fields are
skipped, and nested too deeply they are refused. A whole number is taken where a float is expected.
"""

import struct
from typing import get_args

import msgspec

from footwork.protocol.errors import MALFORMED, TOO_LARGE, LocalError, PeerError
from footwork.protocol.messages import AnyMessage, FromClient, FromServer

CLIENT_MESSAGE_BYTES = 1024
SERVER_MESSAGE_BYTES = 1 << 20

_encoder = msgspec.msgpack.Encoder()
_from_client: msgspec.msgpack.Decoder[FromClient] = msgspec.msgpack.Decoder(FromClient)
_from_server: msgspec.msgpack.Decoder[FromServer] = msgspec.msgpack.Decoder(FromServer)


def encode(message: AnyMessage) -> bytes:
    """The bytes of a message, unchecked: what the server does for every pose.

    Raises:
        LocalError: for fields that MessagePack cannot hold.
    """
    try:
        return _encoder.encode(message)
    except (TypeError, OverflowError, UnicodeEncodeError) as error:
        raise LocalError(f"{type(message).__name__.lower()}: {error}") from None


def encode_checked(message: AnyMessage) -> bytes:
    """The bytes of a message, after its fields were held against their bounds: what a client does.

    Raises:
        LocalError: for fields out of bounds.
    """
    data = encode(message)
    decode = decode_from_client if isinstance(message, get_args(FromClient)) else decode_from_server
    try:
        decode(data)
    except PeerError as error:
        raise LocalError(f"{type(message).__name__.lower()}: {error.problem}") from None
    return data


def decode_from_client(data: bytes) -> FromClient:
    """The message that a client sent.

    Raises:
        PeerError: ``too_large`` or ``malformed``, with the path to the bad field.
    """
    return _decode(_from_client, data, CLIENT_MESSAGE_BYTES)


def decode_from_server(data: bytes) -> FromServer:
    """The message that a server sent.

    Raises:
        PeerError: ``too_large`` or ``malformed``, with the path to the bad field.
    """
    return _decode(_from_server, data, SERVER_MESSAGE_BYTES)


def _decode(decoder: msgspec.msgpack.Decoder, data: bytes, limit: int):
    if len(data) > limit:
        raise PeerError(TOO_LARGE, f"{len(data)} bytes, expected at most {limit}")
    try:
        return decoder.decode(data)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError, OverflowError, struct.error) as error:
        raise PeerError(MALFORMED, _one_line(error)) from None


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())[:300]
