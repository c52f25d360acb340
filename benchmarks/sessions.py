"""Many sessions of one character each on one server, for long: who starves, how late ticks are, whether memory grows.

    python benchmarks/sessions.py [--sessions 500] [--seconds 600] [--rate 60] [--realtime] [BUNDLE]

Prints one JSON object. The server is a process of its own, and so are its clients, which share the cores with it and so
speak ZMTP on bare TCP sockets (loopback). Every session sends a command twice a second, on its own beat. The baseline,
in the same run before it: an empty loop on the same deadlines.

A session starves where a second passes without a pose. ``cores`` tells how much of a core each took: the server's loop,
the rest of the server, which is libzmq's thread, and the clients. Without a bundle the tests' toy one is played.
"""

import argparse
import heapq
import json
import os
import platform
import random
import sys
import time
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from footwork.motion.bundle import read_bundle
from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server, encode
from footwork.runtime.limits import Limits
from footwork.runtime.realtime import take_realtime
from footwork.runtime.server import Server
from support.bare_clients import BareClient, Readable
from support.machine import resident_bytes
from support.processes import idle, in_process, lateness_shares
from toy_bundle import toy_bundle

COMMAND_EVERY = 0.5
STARVED = 1.0
FIRST = 60.0  # seconds, after which memory shall not grow
# libzmq's queue for a connection takes its memory slot by slot, the last after so many messages: with two commands a
# second, after four minutes. In runs of more than a minute clients say as much within the first one.
SLOTS, SETTLING = 512, 45.0
POSE = b"\xa4type\xa4pose"  # after the head of its map


def serve(path: str, rate: int, sessions: int, realtime: bool, pipe: Connection) -> None:
    """Process: a server until the pipe says something; tells its address first, its figures last."""
    limits = Limits(connections=2 * sessions, sessions=sessions, characters=sessions, session_characters=1)
    server = Server(read_bundle(path) if path else toy_bundle(), bind="tcp://127.0.0.1:0", rate=rate, limits=limits)
    problems = take_realtime() if realtime else []
    pipe.send(server.address)
    memory, began = [], time.monotonic()

    def until() -> bool:
        if time.monotonic() - began >= 5.0 * len(memory):
            memory.append(resident_bytes())
        return pipe.poll()

    loop, whole = time.thread_time(), time.process_time()
    server.run(until=until)
    loop, whole = time.thread_time() - loop, time.process_time() - whole
    took = {"server_loop": loop, "server_transport": whole - loop}
    figures = {"lateness_us": lateness_shares(server.lateness_us), "memory": memory, "took": took}
    pipe.send(server.summary() | figures | {"not_permitted": problems})


class Session(BareClient):
    """One client's connection, and what came."""

    def __init__(self, address: str) -> None:
        super().__init__(address)
        self.sequence, self.poses, self.last, self.longest, self.refused = 1, 0, 0.0, 0.0, 0
        self.send(encode(m.Hello(version=1)))
        self.send(encode(m.Spawn(sequence=1, character=0)))

    def command(self, heading: float) -> None:
        """Ask for another heading."""
        self.sequence += 1
        self.send(encode(m.Command(sequence=self.sequence, character=0, heading=heading, behaviour="walk")))

    def read(self, now: float) -> None:
        """Look at what is there; of poses no further than what they are, as all of them would be too much work."""
        for data in self.take():
            if data.startswith(POSE, 1):
                self.longest = max(self.longest, now - self.last) if self.poses else 0.0
                self.poses, self.last = self.poses + 1, now
            else:
                self.refused += isinstance(decode_from_server(data), m.Error | m.Bye)


def play(address: str, sessions: int, seconds: float, pipe: Connection) -> None:
    """Process: the clients; tells what each got, of those whose connection broke nothing, and their processor time."""
    rng, began = random.Random(0), time.monotonic()
    clients = [Session(address) for _ in range(sessions)]
    readable, lost = Readable(clients), set()
    settled = began + SETTLING if seconds > FIRST else began
    beats = [(began + COMMAND_EVERY * number / sessions, number) for number in range(sessions)]
    while (now := time.monotonic()) < began + seconds:
        while beats[0][0] <= now:
            due, number = beats[0]
            settling, own = due + SETTLING / SLOTS < settled, settled + COMMAND_EVERY * number / sessions
            after = due + SETTLING / SLOTS if settling else own if due < own else due + COMMAND_EVERY
            heapq.heapreplace(beats, (after, number))
            client = clients[number]
            with suppress(ConnectionError):  # the next read tells
                client.send(encode(m.Ping())) if settling else client.command(rng.uniform(-3.0, 3.0))
        for client in readable.wait(max(0.0, beats[0][0] - now)):
            try:
                client.read(now)
            except ConnectionError:
                lost.add(client)
                readable.forget(client)
    got = [(0 if client in lost else client.poses, client.longest, client.refused) for client in clients]
    pipe.send((got, time.process_time()))
    for client in clients:
        with suppress(ConnectionError):
            client.send(encode(m.Bye()))
    pipe.recv()


def served(path: str, rate: int, sessions: int, seconds: float, realtime: bool) -> dict[str, Any]:
    """Figures of the server and of its clients."""
    process, pipe = in_process(serve, path, rate, sessions, realtime)
    players, theirs = in_process(play, pipe.recv(), sessions, seconds)
    got, took = theirs.recv()
    pipe.send("enough")
    summary = pipe.recv()
    theirs.send("enough")
    for one in (process, players):
        one.join()
    memory = summary.pop("memory")
    after = memory[min(len(memory) - 1, int(FIRST / 5.0))]
    return summary | {
        "starved": sum(longest > STARVED or not poses for poses, longest, _ in got),
        "poses_a_second": {"least": min(got)[0] / seconds, "most": max(got)[0] / seconds},
        "longest_wait_s": round(max(longest for _, longest, _ in got), 3),
        "refused_to_clients": sum(refused for _, _, refused in got),
        "cores": {name: round(used / seconds, 3) for name, used in (summary.pop("took") | {"clients": took}).items()},
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
    parser.add_argument("--realtime", action="store_true", help="as footwork serve --realtime, where permitted")
    options = parser.parse_args()
    report: dict[str, Any] = {"machine": platform.machine(), "cores": os.cpu_count(), "load": os.getloadavg()[0]}
    report |= {"sessions": options.sessions, "seconds": options.seconds, "rate": options.rate}
    report["empty_loop_lateness_us"] = idle(options.rate, min(60.0, options.seconds))
    report["served"] = served(options.bundle, options.rate, options.sessions, options.seconds, options.realtime)
    print(json.dumps(report))


if __name__ == "__main__":
    main()
