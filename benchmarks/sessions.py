"""Many sessions of one character each on one server, for long: who starves, how late ticks are, whether memory grows.

    python benchmarks/sessions.py [--sessions 500] [--seconds 600] [--rate 60] [BUNDLE]

Prints one JSON object. The server is a process of its own; clients are DEALER sockets on TCP loopback, shared out to
half as many processes as there are cores. Every session sends a command twice a second, on its own beat. The baseline,
in the same run before it: an empty loop on the same deadlines.

A session starves where a second passes without a pose. Without a bundle the tests' toy one is played.
"""

import argparse
import json
import os
import platform
import random
import sys
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import zmq

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from footwork.motion.bundle import read_bundle
from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server, encode
from footwork.runtime.limits import Limits
from footwork.runtime.server import Server
from support.machine import resident_bytes
from support.processes import idle, in_process, lateness_shares
from toy_bundle import toy_bundle

COMMAND_EVERY = 0.5
STARVED = 1.0
FIRST = 60.0  # seconds, after which memory shall not grow


def serve(path: str, rate: int, sessions: int, pipe: Connection) -> None:
    """Process: a server until the pipe says something; tells its address first, its figures last."""
    limits = Limits(connections=2 * sessions, sessions=sessions, characters=sessions, session_characters=1)
    server = Server(read_bundle(path) if path else toy_bundle(), bind="tcp://127.0.0.1:0", rate=rate, limits=limits)
    pipe.send(server.address)
    memory, began = [], time.monotonic()

    def until() -> bool:
        if time.monotonic() - began >= 5.0 * len(memory):
            memory.append(resident_bytes())
        return pipe.poll()

    server.run(until=until)
    pipe.send(server.summary() | {"lateness_us": lateness_shares(server.lateness_us), "memory": memory})


class Session:
    """One client's socket, and what came."""

    def __init__(self, address: str, beat: float) -> None:
        self.socket = zmq.Context.instance().socket(zmq.DEALER)
        self.socket.set(zmq.LINGER, 0)
        self.socket.connect(address)
        self.sequence, self.beat, self.poses, self.lost, self.last, self.longest = 1, beat, 0, 0, 0.0, 0.0
        self.refused = 0
        self.say(m.Hello(version=1))
        self.say(m.Spawn(sequence=1, character=0))

    def say(self, message: m.FromClient) -> None:
        """Send it."""
        self.socket.send(encode(message))

    def command(self, now: float, rng: random.Random) -> None:
        """Ask for another heading, if it is time to."""
        if now >= self.beat:
            self.beat, self.sequence = self.beat + COMMAND_EVERY, self.sequence + 1
            self.say(m.Command(sequence=self.sequence, character=0, heading=rng.uniform(-3, 3), behaviour="walk"))

    def take(self, now: float) -> None:
        """Read what is there."""
        while True:
            try:
                data = self.socket.recv(zmq.NOBLOCK)
            except zmq.Again:
                return
            message = decode_from_server(data)
            if isinstance(message, m.Pose):
                self.longest = max(self.longest, now - self.last) if self.poses else 0.0
                self.poses, self.last = self.poses + 1, now
            elif isinstance(message, m.Error | m.Bye):
                self.refused += 1


def play(address: str, sessions: int, seconds: float, seed: int, pipe: Connection) -> None:
    """Process: a share of the clients; tells what each got."""
    rng, began = random.Random(seed), time.monotonic()
    clients = [Session(address, began + 2.0 + rng.uniform(0.0, COMMAND_EVERY)) for _ in range(sessions)]
    poller = zmq.Poller()
    for client in clients:
        poller.register(client.socket, zmq.POLLIN)
    by_socket = {client.socket: client for client in clients}
    while (now := time.monotonic()) < began + seconds:
        for socket, _ in poller.poll(5):
            by_socket[socket].take(now)
        for client in clients:
            client.command(now, rng)
    for client in clients:
        client.say(m.Bye())
    pipe.send([(client.poses, client.longest, client.refused) for client in clients])
    time.sleep(0.5)


def served(path: str, rate: int, sessions: int, seconds: float) -> dict[str, Any]:
    """Figures of the server and of its clients."""
    process, pipe = in_process(serve, path, rate, sessions)
    address, count = pipe.recv(), max(1, (os.cpu_count() or 2) // 2)
    shares = [sessions // count + (k < sessions % count) for k in range(count)]
    players = [in_process(play, address, share, seconds, k) for k, share in enumerate(shares)]
    got = [one for _, ours in players for one in ours.recv()]
    pipe.send("enough")
    summary = pipe.recv()
    process.join()
    memory = summary.pop("memory")
    after = memory[min(len(memory) - 1, int(FIRST / 5.0))]
    return summary | {
        "starved": sum(longest > STARVED or not poses for poses, longest, _ in got),
        "poses_a_second": {"least": min(got)[0] / seconds, "most": max(got)[0] / seconds},
        "longest_wait_s": round(max(longest for _, longest, _ in got), 3),
        "refused_to_clients": sum(refused for _, _, refused in got),
        "late_share": summary["late_ticks"] / max(1, summary["ticks"]),
        "memory_mb": {"after_a_minute": after / 1e6, "at_the_end": memory[-1] / 1e6, "growth": memory[-1] / after},
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bundle", nargs="?", default="", metavar="BUNDLE")
    parser.add_argument("--sessions", type=int, default=500)
    parser.add_argument("--seconds", type=float, default=60.0, help="600 for figures to report (default 60)")
    parser.add_argument("--rate", type=int, default=60)
    options = parser.parse_args()
    report: dict[str, Any] = {"machine": platform.machine(), "cores": os.cpu_count(), "load": os.getloadavg()[0]}
    report |= {"sessions": options.sessions, "seconds": options.seconds, "rate": options.rate}
    report["empty_loop_lateness_us"] = idle(options.rate, min(60.0, options.seconds))
    report["served"] = served(options.bundle, options.rate, options.sessions, options.seconds)
    print(json.dumps(report))


if __name__ == "__main__":
    main()
