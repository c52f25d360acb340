"""Command-to-pose time, tick time and lateness of a server with one client, beside what the machine does without it.

    python benchmarks/server.py [--seconds 10] [BUNDLE]

Prints one JSON object. Server and client are processes of their own, on TCP loopback. Beside the server, in the same
run: a bare ROUTER/DEALER echo of messages of the same sizes, and the lateness of an empty loop on the same deadlines.

Command-to-pose is measured twice: for commands sent at random moments, most of which is the wait for the next tick
(on average half of 33.3 ms), and for commands aimed to arrive ``AIM`` before a tick, where that wait is small. In
lock-step there is no such wait: a command and a step go out, a pose comes back, and the echo does the same with bare
messages of their sizes; ``ratio`` is of the medians and of the 99th percentiles. Both are taken at bare sockets; beside
them what our client in Python takes until the step is over, with all that it checks and reads.
Without a bundle it plays the tests' toy one, whose poses have the sizes of any on the common body.
"""

import argparse
import json
import os
import platform
import random
import sys
import time
from collections.abc import Iterable, Sequence
from itertools import repeat
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np
import zmq

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from footwork.motion.bundle import Bundle, read_bundle
from footwork.protocol import messages as m
from footwork.protocol.client import Client
from footwork.protocol.codec import decode_from_server, encode
from footwork.runtime.server import Server
from support.processes import idle, in_process, lateness_shares
from toy_bundle import toy_bundle

TICK = 1.0 / 30.0
AIM = 0.003
ECHOES = 3000


def shares(values: list[float], *wanted: float) -> dict[str, float]:
    """Percentiles by name."""
    return {f"p{share:g}": round(float(np.percentile(values, share)), 3) for share in wanted}


def load(path: str) -> Bundle:
    """The bundle of a file, or the toy one for no file."""
    return read_bundle(path) if path else toy_bundle()


def serve(path: str, rate: int, lockstep: bool, pipe: Connection) -> None:
    """Process: a server until the pipe says something; tells its address first and its figures last."""
    server = Server(load(path), bind="tcp://127.0.0.1:0", rate=rate, lockstep=lockstep)
    pipe.send(server.address)
    # beside it: looking into the pipe at every frame would take its time
    Thread(target=lambda: pipe.recv() and server.stop(), daemon=True).start()
    server.run()
    pipe.send({**server.summary(), "lateness_us": lateness_shares(server.lateness_us)})


def echo(question: int, answers: Sequence[int], pipe: Connection) -> None:
    """Process: a bare ROUTER that answers each message of so many bytes with messages of others."""
    socket = zmq.Context.instance().socket(zmq.ROUTER)
    socket.bind("tcp://127.0.0.1:*")
    pipe.send(socket.get_string(zmq.LAST_ENDPOINT))
    parts = [bytes(size) for size in answers]
    while (asked := socket.poll(10)) or not pipe.poll():
        if asked:
            peer, said = socket.recv_multipart()
            for part in parts if len(said) == question else ():
                socket.send_multipart([peer, part])


def command_to_pose(client: Client, seconds: float, aimed: bool) -> list[float]:
    """Milliseconds from sending a command to the first pose that acknowledges it, one command after another."""
    rng, waits = random.Random(1), []
    end = time.monotonic() + seconds
    poses = client.poses()
    while time.monotonic() < end:
        last_tick = next(time.monotonic() for pose in poses if pose.frame == 1)
        time.sleep(max(0.0, last_tick + TICK - AIM - time.monotonic()) if aimed else rng.uniform(0.0, 2.0 * TICK))
        sent = time.monotonic()
        sequence = client.command(0, rng.uniform(-3.0, 3.0), client.welcome.behaviours[0])
        arrived = next(time.monotonic() for pose in poses if pose.acknowledged >= sequence)
        waits.append(1000.0 * (arrived - sent))
    return waits


def served(path: str, rate: int, seconds: float) -> dict[str, Any]:
    """Figures of a server at one rate."""
    process, pipe = in_process(serve, path, rate, False)
    with Client(pipe.recv(), timeout=60.0) as client:
        client.spawn(0)
        waits = {name: command_to_pose(client, seconds / 2, name == "aimed") for name in ("random", "aimed")}
    pipe.send("enough")
    summary = pipe.recv()
    process.join()
    times = {name: shares(values, 50, 99) for name, values in waits.items()}
    return {"command_to_pose_ms": times, "commands": {name: len(values) for name, values in waits.items()}} | summary


def message_sizes() -> dict[str, int]:
    """Bytes of a command, a step, a pose on the common body and the answer to a step."""
    command = m.Command(sequence=1000, character=0, heading=1.0, behaviour="walk")
    whole = {"tick": 1000, "frame": 1, "character": 0, "acknowledged": 1000, "behaviour": 1, "clip": 1}
    pose = m.Pose(**whole, source_frame=1, facing=1.0, transition=False, root=bytes(12), rotations=bytes(21 * 16))
    said = {"command": command, "step": m.Step(ticks=1), "pose": pose, "stepped": m.Stepped(tick=1000)}
    return {name: len(encode(message)) for name, message in said.items()}


def dealer(address: str) -> zmq.Socket:
    """A bare DEALER socket."""
    socket = zmq.Context.instance().socket(zmq.DEALER)
    socket.connect(address)
    return socket


def round_trips(socket: zmq.Socket, said: Iterable[Sequence[bytes]], answers: int) -> dict[str, float]:
    """Microseconds from sending some messages to the first of their answers."""
    trips = []
    for messages in said:
        sent = time.perf_counter()
        for message in messages:
            socket.send(message)
        socket.recv()
        trips.append(1e6 * (time.perf_counter() - sent))
        for _ in range(answers - 1):
            socket.recv()
    socket.close(linger=0)
    return shares(trips[ECHOES // 10 :], 50, 99)


def bare_echo(questions: Sequence[int], answers: Sequence[int]) -> dict[str, float]:
    """Microseconds from sending messages of so many bytes to the first answer, without anything of ours."""
    process, pipe = in_process(echo, questions[-1], answers)
    said = [bytes(size) for size in questions]
    trips = round_trips(dealer(pipe.recv()), repeat(said, ECHOES), len(answers))
    pipe.send("enough")
    process.join()
    return trips


def at_the_socket(address: str) -> dict[str, float]:
    """Microseconds from a command and a step to the pose where the client takes no time: bytes ready, bytes unread."""
    socket, rng, step = dealer(address), random.Random(1), encode(m.Step(ticks=1))
    for message in (m.Hello(version=1), m.Spawn(sequence=1, character=0), m.Step(ticks=1)):
        socket.send(encode(message))
    while not isinstance(decode_from_server(socket.recv()), m.Stepped):
        pass
    whole = {"character": 0, "behaviour": "walk"}
    commands = (m.Command(sequence=2 + turn, heading=rng.uniform(-3.0, 3.0), **whole) for turn in range(ECHOES))
    return round_trips(socket, ((encode(command), step) for command in commands), 2)


def of_our_client(address: str) -> dict[str, float]:
    """Microseconds from a command to the end of the step that shows it, by the client in Python."""
    rng, trips = random.Random(1), []
    with Client(address, timeout=60.0) as client:
        client.spawn(0)
        for _ in range(ECHOES):
            sent = time.perf_counter()
            client.command(0, rng.uniform(-3.0, 3.0), "walk")
            client.step()
            trips.append(1e6 * (time.perf_counter() - sent))
    return shares(trips[ECHOES // 10 :], 50, 99)


def in_lock_step(path: str) -> dict[str, Any]:
    """Microseconds from a command and a step to the pose, beside the echo of messages of the same sizes."""
    figures, tick_us, size = {}, {}, message_sizes()
    for name, measure in {"command_to_pose_us": at_the_socket, "by_our_client_us": of_our_client}.items():
        process, pipe = in_process(serve, path, 30, True)
        figures[name] = measure(pipe.recv())
        pipe.send("enough")
        tick_us[name] = pipe.recv()["tick_us"]
        process.join()
    bare = bare_echo((size["command"], size["step"]), (size["pose"], size["stepped"]))
    ratio = {name: {share: round(ours[share] / bare[share], 2) for share in ours} for name, ours in figures.items()}
    return figures | {"bare_us": bare, "ratio": ratio, "tick_us": tick_us, "bytes": size}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bundle", nargs="?", default="", metavar="BUNDLE")
    parser.add_argument("--seconds", type=float, default=10.0, help="of each measurement (default 10)")
    options = parser.parse_args()
    report: dict[str, Any] = {"machine": platform.machine(), "cores": os.cpu_count(), "load": os.getloadavg()[0]}
    size = message_sizes()
    report["echo"] = {"bytes": size, "round_trip_us": bare_echo((size["command"],), (size["pose"],))}
    report["lock_step"] = in_lock_step(options.bundle)
    for rate in (30, 60):
        figures = served(options.bundle, rate, options.seconds)
        report[f"rate_{rate}"] = figures | {"empty_loop_lateness_us": idle(rate, options.seconds)}
    print(json.dumps(report))


if __name__ == "__main__":
    main()
