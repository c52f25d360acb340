"""A coverage-guided run on the decoder and the sessions behind it; needs atheris (LibFuzzer for Python, Linux).

    pip install atheris
    python tests/fuzzing/decoder.py -runs=1000000

Options are LibFuzzer's; a file is run again, a folder keeps inputs that led to something new. Each input is what two
clients of one server do, one thing after the other (``things_in``). Anything raised but a refusal ends the run with the
input that did it, and so do an answer that no client could read, and a peer that is told something and had said
nothing. LibFuzzer itself stops at a memory limit of 2 GB, or at an input that takes over ten seconds.

Bytes changed blindly are hardly ever messages, and msgspec's own code, which is C, guides nobody to them. So most
changes are made to whole messages and their fields; some still are to bytes.
"""

import random
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import atheris  # pyright: ignore[reportMissingImports]
import msgspec

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

# compiled kernels cannot be looked into: what has some is imported before what follows, or left out there
from footwork.runtime.arena import Arena  # noqa: F401
from footwork.runtime.simulation import Simulation
from odd_messages import VALID, odd_message
from toy_bundle import toy_bundle

kernels = ["footwork.runtime.pose_messages"]
with atheris.instrument_imports(["footwork"], kernels):  # pyright: ignore[reportAttributeAccessIssue]
    from footwork.protocol import messages as m
    from footwork.protocol.codec import decode_from_server, encode
    from footwork.runtime.host import Host
    from footwork.runtime.limits import Limits

PEERS = (b"peer", b"other")
SAID, GONE, TICK, KINDS = 0, 2, 4, 5  # said by the first or the other, gone is the first or the other, a tick
MOST_BYTES = 4096
OTHER_CLOCK = 0.05  # how often an input goes on in the other kind of server
SECOND = 1_000_000_000
SIMULATION = Simulation(toy_bundle(), 4)
LIMITS = Limits(sessions=2, characters=4, session_characters=2, messages_per_tick=8, idle_seconds=2.0)


def things_in(data: bytes) -> Iterator[tuple[int, bytes]]:
    """What happens: after one byte, of each thing a byte tells what it is, two how long the message is that follows."""
    data = data[1:]
    while data:
        kind, length = data[0] % KINDS, int.from_bytes(data[1:3], "little")
        yield kind, data[3 : 3 + length]
        data = data[3 + length :]


def joined(lockstep: bool, things: list[tuple[int, bytes]]) -> bytes:
    """The input of what happens to a server in lock-step or by a clock."""
    parts = (bytes([kind]) + len(said).to_bytes(2, "little") + said for kind, said in things)
    return b"".join((bytes([lockstep]), *parts))


class Run:
    """A fresh host, in lock-step or by the clock, with both peers greeted."""

    def __init__(self, lockstep: bool) -> None:
        for slot in SIMULATION.world.slots.tolist():
            SIMULATION.remove(slot)
        SIMULATION.tick = 0
        self.host, self.now, self.spoke = Host(SIMULATION, 30, LIMITS, lockstep=lockstep), 0, set()
        for number, _ in enumerate(PEERS):
            self.happens(SAID + number, encode(m.Hello(version=1, events=m.EVENTS)))

    def happens(self, kind: int, said: bytes) -> None:
        """Let it happen."""
        if kind == TICK:
            self.tick()
        elif kind >= GONE:
            self.host.lose(PEERS[kind - GONE], self.now)
        else:
            self.spoke.add(PEERS[kind])
            self.host.receive(PEERS[kind], said, self.now)

    def tick(self) -> None:
        """Some time passes; all that is told can be read."""
        self.now += SECOND
        self.host.end_overdue(self.now)
        if self.host.lockstep:
            self.host.count_anew()
            self.host.step()
        else:
            self.host.tick()
        told = [*self.host.outgoing(), *((peer, pose) for peer, _, pose in self.host.poses(1))]
        for peer, data in told:
            decode_from_server(data)
            if peer not in self.spoke:
                raise AssertionError(f"told {peer}, which had said nothing")


def one_input(data: bytes) -> None:
    """Let all happen that an input says, then end."""
    run = Run(lockstep=data[:1] == b"\1")
    for kind, said in things_in(data):
        run.happens(kind, said)
    run.tick()
    run.host.end_all("done")


def changed(data: bytes, most: int, seed: int) -> bytes:
    """An input with something more, less, or otherwise."""
    rng, things = random.Random(seed), list(things_in(data))
    change = rng.choice((_more, _more, _less, _elsewhere, _bytes_of_one))
    change(rng, things)
    return joined((data[:1] == b"\1") != (rng.random() < OTHER_CLOCK), things)[:most]


def _more(rng: random.Random, things: list[tuple[int, bytes]]) -> None:
    kind = rng.choice((SAID, SAID, SAID + 1, TICK, GONE + rng.randrange(2)))
    at = rng.randrange(len(things) + 1)
    things.insert(at, (kind, odd_message(rng, at + 1) if kind < GONE else b""))


def _less(rng: random.Random, things: list[tuple[int, bytes]]) -> None:
    if things:
        del things[rng.randrange(len(things))]


def _elsewhere(rng: random.Random, things: list[tuple[int, bytes]]) -> None:
    if things:
        things.insert(rng.randrange(len(things)), things.pop(rng.randrange(len(things))))


def _bytes_of_one(rng: random.Random, things: list[tuple[int, bytes]]) -> None:
    if things:
        at = rng.randrange(len(things))
        said = atheris.Mutate(things[at][1] or b"\x80", 1100)  # pyright: ignore[reportAttributeAccessIssue]
        things[at] = things[at][0], said


def main() -> None:
    """Begin with valid messages and go where there is code not yet reached."""
    with tempfile.TemporaryDirectory() as folder:
        said: list[tuple[int, bytes]] = [(SAID, msgspec.msgpack.encode(fields)) for fields in VALID]
        for number, thing in enumerate(said):
            (Path(folder) / str(number)).write_bytes(joined(False, [thing, (TICK, b"")]))
        (Path(folder) / "all").write_bytes(joined(True, said))
        limits = ["-timeout=10", "-rss_limit_mb=2048", f"-max_len={MOST_BYTES}"]
        again = any(Path(argument).is_file() for argument in sys.argv[1:])
        begin_with = [] if again else [folder]
        atheris.Setup([sys.argv[0], *limits, *sys.argv[1:], *begin_with], one_input, custom_mutator=changed)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
