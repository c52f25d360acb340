"""A coverage-guided run on the decoder and the sessions behind it; needs atheris (LibFuzzer for Python, Linux).

    pip install atheris
    python tests/fuzzing/decoder.py -runs=1000000

Options are LibFuzzer's. Each input is a few messages, a byte of length before each, of one client. Anything raised but
a refusal ends the run with the input that did it, and so does a peer that is told something and had said nothing.
LibFuzzer itself stops at a memory limit of 2 GB, or at an input that takes over a second.
"""

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import atheris  # pyright: ignore[reportMissingImports]
import msgspec

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from footwork.runtime.simulation import Simulation
from odd_messages import VALID
from toy_bundle import toy_bundle

# not of what is above: compiled kernels cannot be looked into
with atheris.instrument_imports():  # pyright: ignore[reportAttributeAccessIssue]
    from footwork.protocol import messages as m
    from footwork.protocol.codec import encode
    from footwork.runtime.host import Host
    from footwork.runtime.limits import Limits

PEER = b"peer"
SIMULATION = Simulation(toy_bundle(), 4)
LIMITS = Limits(sessions=2, characters=4, session_characters=2)


def messages_in(data: bytes) -> Iterator[bytes]:
    """The messages of an input: a byte tells how long each is, in fours."""
    while data:
        length, data = 4 * data[0], data[1:]
        yield data[:length]
        data = data[length:]


def one_input(data: bytes) -> None:
    """Say the messages to a fresh host that has greeted the peer, then make a tick."""
    host = Host(SIMULATION, 30, LIMITS)
    host.receive(PEER, encode(m.Hello(version=1)), 0)
    for message in messages_in(data):
        host.receive(PEER, message, 0)
    host.tick()
    strangers = {peer for peer, _ in host.outgoing()} - {PEER}
    if strangers:
        raise AssertionError(f"told {strangers}, which had said nothing")
    host.end_all("done")


def main() -> None:
    """Begin with valid messages and go where there is code not yet reached."""
    with tempfile.TemporaryDirectory() as folder:
        for number, fields in enumerate(VALID):
            data = msgspec.msgpack.encode(fields)
            (Path(folder) / str(number)).write_bytes(bytes([-(-len(data) // 4)]) + data)
        limits = ["-timeout=1", "-rss_limit_mb=2048", "-max_len=4096"]
        atheris.Setup([sys.argv[0], *limits, *sys.argv[1:], folder], one_input)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
