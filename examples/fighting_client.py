"""Fights the opponent of a server in lock-step: steps up to it, strikes, and says how the rounds went.

footwork serve fighters.footwork --opponent aggressive --lock-step
python fighting_client.py [ADDRESS [SECONDS]]
"""

import math
import sys
from collections import Counter
from collections.abc import Iterator

from footwork.protocol import messages as m
from footwork.protocol.client import DEFAULT_ADDRESS, Client
from footwork.protocol.pose_arrays import root_of

OWN = 0
NEAR = 1.3  # metres between the two, from which on to strike
TICKS = 3  # from one look at them to the next


def main(address: str = DEFAULT_ADDRESS, seconds: str = "20") -> None:
    happened: Counter[tuple[str, bool]] = Counter()
    poses: dict[int, m.Pose] = {}
    with Client(address, name="fighting_client.py", timeout=60) as client:
        client.spawn(OWN)
        for _ in range(round(m.TICK_RATE / TICKS * float(seconds))):
            poses = {pose.character: pose for pose in client.step(TICKS)}
            command(client, poses)
            happened.update((event.kind, event.character == OWN) for event in events(client))
    (other,) = poses.keys() - {OWN}
    print(f"struck {happened['hit', False]} times, was struck {happened['hit', True]} times")
    print(f"won {happened['round', True]} rounds, lost {happened['round', False]}")
    print(f"health {poses[OWN].health:.2f} and {poses[other].health:.2f}")


def command(client: Client, poses: dict[int, m.Pose]) -> None:
    """Step up to the opponent, and strike where it is near."""
    (other,) = poses.keys() - {OWN}
    (x, _, z), (there_x, _, there_z) = root_of(poses[OWN]), root_of(poses[other])
    towards = math.atan2(there_x - x, there_z - z)
    if math.hypot(there_x - x, there_z - z) < NEAR:
        client.command(OWN, towards, "attack")
    client.keys(OWN, m.Keys(view_yaw=towards, forward=1))


def events(client: Client) -> Iterator[m.Event]:
    """Those that have come since the last time."""
    while (message := client.receive(0.0)) is not None:
        if isinstance(message, m.Event):
            yield message


if __name__ == "__main__":
    main(*sys.argv[1:])
