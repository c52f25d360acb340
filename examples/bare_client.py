"""A client with nothing of footwork's: python examples/bare_client.py [ADDRESS]

Needs only pyzmq and msgpack. Walks ahead for a second, turns back for another, and prints how the character does.
protocol/SPEC.md tells what the fields mean.
"""

import math
import struct
import sys
import time

import msgpack
import zmq

VERSION = 1
SILENCE_MS = 5000
PACKER = msgpack.Packer()


def connect(address: str) -> zmq.Socket:
    socket = zmq.Context.instance().socket(zmq.DEALER)
    socket.set(zmq.LINGER, 200)
    socket.connect(address)
    return socket


def send(socket: zmq.Socket, kind: str, **fields) -> None:
    socket.send(PACKER.pack({"type": kind, **fields}))


def receive(socket: zmq.Socket) -> dict:
    if not socket.poll(SILENCE_MS):
        sys.exit("the server is silent")
    message = msgpack.unpackb(socket.recv())
    if message["type"] in ("error", "bye"):
        sys.exit(f"the server says {message}")
    return message


def place_of(pose: dict) -> tuple[float, float, float]:
    return struct.unpack("<3f", pose["root"])


def joint_rotations(pose: dict) -> list[tuple[float, float, float, float]]:
    return list(struct.iter_unpack("<4f", pose["rotations"]))


def walk(socket: zmq.Socket, view_yaw: float, seconds: float, sequence: int) -> int:
    """Hold the forward key with the camera at ``view_yaw``; returns the last sequence number used."""
    end = time.monotonic() + seconds
    sent: dict[int, float] = {}
    waits = [0.0]
    pose = None
    while pose is None or time.monotonic() < end:
        message = receive(socket)
        if message["type"] != "pose" or message["frame"] != 1:
            continue
        pose = message
        if pose["acknowledged"] in sent:
            waits.append(time.monotonic() - sent.pop(pose["acknowledged"]))
        sequence += 1
        sent[sequence] = time.monotonic()
        keys = {"view_yaw": view_yaw, "forward": 1}
        send(socket, "command", sequence=sequence, character=0, keys=keys)
    x, _, z = place_of(pose)
    print(
        f"tick {pose['tick']}: at ({x:.2f}, {z:.2f}) m facing {pose['facing']:.2f} rad, "
        f"{len(joint_rotations(pose))} joints, command to pose at most {1000 * max(waits):.1f} ms"
    )
    return sequence


def main(address: str = "tcp://127.0.0.1:5555") -> None:
    socket = connect(address)
    send(socket, "hello", version=VERSION, client="bare_client.py")
    welcome = receive(socket)
    print(f"{len(welcome['joints'])} joints, behaviours {', '.join(welcome['behaviours'])}")
    send(socket, "spawn", sequence=1, character=0)
    sequence = walk(socket, 0.0, 1.0, 1)
    walk(socket, math.pi, 1.0, sequence)
    send(socket, "bye")
    socket.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
