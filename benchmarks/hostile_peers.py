"""What peers that stall, flood, never end a message or come back a thousand times do to the ticks of others.

    python benchmarks/hostile_peers.py [--seconds S]

Prints one JSON object: for each kind of peer how late the server's frames began, microseconds, how late they began
without any such peer in the same run (before each kind), how much memory grew at most, megabytes, how many connections
were cut, messages refused and sessions begun, and whether the one well-behaved client saw every tick. Linux; the peers
run in a process of their own.
"""

import argparse
import json
import os
import socket
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.synchronize import Event
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from footwork.protocol.client import Client
from footwork.runtime.server import Server
from support.machine import resident_bytes
from support.processes import PROCESSES
from toy_bundle import toy_bundle

GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\x00") + bytes(32)
READY = b"\x04\x1c\x05READY\x0bSocket-Type\x00\x00\x00\x06DEALER"
HELLO = b"\x00\x15\x82\xa4type\xa5hello\xa7version\x01"
Address = tuple[str, int]


def opened(address: Address, *sent: bytes) -> socket.socket:
    """A connection that has sent these bytes."""
    peer = socket.create_connection(address)
    peer.settimeout(0.2)
    with suppress(OSError):
        peer.sendall(b"".join(sent))
    return peer


def stall(address: Address, end: float) -> None:
    """Hold two hundred connections that stop within the handshake, and as many that stop within a message."""
    held = []
    while time.monotonic() < end:
        held = held[-400:]
        held += [opened(address, GREETING[:11]), opened(address, GREETING, READY, b"\x02" + (8000).to_bytes(8, "big"))]
        time.sleep(0.002)


def never_end(address: Address, end: float) -> None:
    """Send frames of one byte that promise another, as fast as they are taken."""
    while time.monotonic() < end:
        with suppress(OSError), opened(address, GREETING, READY) as peer:
            while time.monotonic() < end:
                peer.sendall(b"\x01\x01x" * 10_000)


def flood(address: Address, end: float) -> None:
    """Send whole messages that say nothing, as fast as they are taken."""
    while time.monotonic() < end:
        with suppress(OSError), opened(address, GREETING, READY) as peer:
            while time.monotonic() < end:
                peer.sendall((b"\x00\x20" + bytes(32)) * 1000)


def come_back(address: Address, end: float) -> None:
    """Connect, begin a session and vanish once welcome, over and over."""
    while time.monotonic() < end:
        with suppress(OSError), opened(address, GREETING, READY) as peer:
            said = peer.recv(1 << 12)  # libzmq reads a message in one piece with the greeting as part of it
            peer.sendall(HELLO)
            while b"welcome" not in said and (more := peer.recv(1 << 16)):
                said += more


PEERS: dict[str, Callable[[Address, float], None]] = {
    "stall": stall,
    "never_end": never_end,
    "flood": flood,
    "come_back": come_back,
}


def behave(kind: str, address: Address, seconds: float, started: Event) -> None:
    """Be such a peer for so long."""
    started.set()
    PEERS[kind](address, time.monotonic() + seconds)


class Lateness:
    """What the server adds, with nothing thrown away."""

    def __init__(self) -> None:
        self.values: list[float] = []

    def add(self, value: float) -> None:
        """Keep a number."""
        self.values.append(value)

    def taken(self) -> dict[str, float]:
        """Percentiles of what was kept, microseconds; it is kept no more."""
        values, self.values = np.array(self.values), []
        return {f"p{share:g}": round(float(np.percentile(values, share)), 1) for share in (50, 99, 100)}


def watch(client: Client, seconds: float) -> tuple[bool, float]:
    """Whether the client saw all ticks for so long, and how much memory grew at most."""
    begun, most, ticks = resident_bytes() / 1e6, 0.0, []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        ticks.append(next(client.poses()).tick)
        most = max(most, resident_bytes() / 1e6 - begun)
    return set(np.diff(ticks)) <= {0, 1}, most


def suffered(server: Server, client: Client, lateness: Lateness, kind: str, seconds: float) -> dict[str, Any]:
    """What one kind of peer did."""
    watch(client, seconds)
    before = lateness.taken()
    host, port = server.address.removeprefix("tcp://").split(":")
    former = server.summary()
    started = PROCESSES.Event()
    peer = PROCESSES.Process(target=behave, args=(kind, (host, int(port)), seconds, started))
    peer.start()
    while not started.is_set():
        next(client.poses())
    lateness.taken()
    whole, grown = watch(client, seconds)
    found = {"late_us": lateness.taken(), "late_before_us": before, "no_tick_missed": whole, "grew_mb": round(grown, 1)}
    peer.join()
    return found | {name: server.summary()[name] - former[name] for name in ("cut", "refused", "sessions")}


def main() -> None:
    """Measure and print."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--seconds", type=float, default=5.0, help="for each kind of peer, and before it")
    seconds = arguments.parse_args().seconds
    server, lateness = Server(toy_bundle(), bind="tcp://127.0.0.1:0"), Lateness()
    server.lateness_us = lateness  # type: ignore[assignment]
    thread = threading.Thread(target=server.run)
    thread.start()
    with Client(server.address) as client:
        client.spawn(0)
        kinds = {kind: suffered(server, client, lateness, kind, seconds) for kind in PEERS}
    server.stop()
    thread.join()
    print(
        json.dumps(
            {"workload": f"60 Hz, one client, {seconds:g} s a kind", "peers": kinds, "processors": os.cpu_count()}
        )
    )


if __name__ == "__main__":
    main()
