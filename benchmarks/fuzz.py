"""A server's sessions under messages that are wrong in every way, beside one client that keeps to the protocol.

    python benchmarks/fuzz.py [--messages 1000000] [--seed 1]

Prints one JSON object: how many messages were taken, what was refused by code, seconds and microseconds a message, how
memory grew from the first tenth to the end, and what the honest client saw. It exits with 1 where anything was raised
that is no refusal, a reply went to a peer that had said nothing, the honest client was disturbed, or memory grew.
"""

import argparse
import gc
import json
import random
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server, encode
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.simulation import Simulation
from odd_messages import odd_message
from support.machine import resident_bytes
from toy_bundle import toy_bundle

PEERS = [b"odd %d" % number for number in range(8)]
HONEST = b"honest"
A_TICK = 200  # messages
GROWTH = 1.01
SECOND = 1_000_000_000


class Bench:
    """A host, eight peers who say odd things, and one who does not; ``seed`` is of what is said."""

    def __init__(self, seed: int) -> None:
        limits = Limits(sessions=6, characters=8, session_characters=3)
        self.host = Host(Simulation(toy_bundle(), limits.characters), 60, limits)
        self.rng, self.now, self.said = random.Random(seed), 0, 0
        self.refused: Counter[str] = Counter()
        self.faults: list[str] = []
        self.honest_sequence = self.honest_poses = 0
        self.honest_says(m.Hello(version=1, client="honest"))
        self.honest_says(m.Spawn(sequence=self.next_sequence(), character=0))

    def next_sequence(self) -> int:
        """Of the honest client."""
        self.honest_sequence += 1
        return self.honest_sequence

    def honest_says(self, message: m.FromClient) -> None:
        """Say what keeps to the protocol; a refusal of it is a fault."""
        self.host.receive(HONEST, encode(message), self.now)
        self.read()

    def read(self) -> None:
        """Look at all replies."""
        for peer, data in self.host.outgoing():
            message = decode_from_server(data)
            if peer not in (HONEST, *PEERS):
                self.faults.append(f"a reply to {peer!r}")
            if isinstance(message, m.Error):
                self.refused[message.code] += 1
            if peer == HONEST and isinstance(message, m.Error | m.Bye):
                self.faults.append(f"the honest client was told {message}")

    def tick(self) -> None:
        """A tick's odd messages, a command of the honest client, and the tick."""
        for _ in range(A_TICK):
            self.said += 1
            data = odd_message(self.rng, self.said)
            try:
                self.host.receive(self.rng.choice(PEERS), data, self.now)
            except Exception as error:  # whatever it is, it is what this looks for
                self.faults.append(f"{type(error).__name__}: {error} at {data.hex()}")
        sequence = self.next_sequence()
        self.honest_says(m.Command(sequence=sequence, character=0, heading=self.rng.uniform(-3, 3), behaviour="walk"))
        self.now += SECOND // m.TICK_RATE
        self.host.end_overdue(self.now)
        self.host.tick()
        self.read()
        for peer, _, data in self.host.poses(1):
            if peer == HONEST:
                self.honest_poses += 1
                pose = decode_from_server(data)
                if not isinstance(pose, m.Pose) or pose.acknowledged != sequence:
                    self.faults.append(f"the honest client's {sequence} was not taken")


def without_garbage() -> int:
    """Resident bytes after a collection."""
    gc.collect()
    return resident_bytes()


def run(messages: int, seed: int) -> dict[str, Any]:
    """Figures of so many odd messages."""
    bench, ticks = Bench(seed), messages // A_TICK
    began, early = time.perf_counter(), 0
    for tick in range(ticks):
        bench.tick()
        if tick == ticks // 10:
            early = without_garbage()
    seconds, growth = time.perf_counter() - began, without_garbage() / early
    if growth > GROWTH:
        bench.faults.append(f"memory grew to {growth:.3f} times what it was after a tenth")
    return {
        "messages": bench.said,
        "seconds": round(seconds, 2),
        "us_a_message": round(1e6 * seconds / max(1, bench.said), 2),
        "refused": bench.host.refused,
        "told": dict(bench.refused.most_common()),
        "sessions_begun": bench.host.scenes.first.sessions_begun,
        "honest_poses": bench.honest_poses,
        "ticks": ticks,
        "memory_growth": round(growth, 4),
        "faults": bench.faults[:10],
    }


def main() -> None:
    """Say it all and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--messages", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    report = run(options.messages, options.seed)
    print(json.dumps(report))
    sys.exit(bool(report["faults"]))


if __name__ == "__main__":
    main()
