"""Writes a minute of play as a trace: python examples/made_up_player.py player.csv

A player who changes direction, pace or both about once a second, turns the view by up to 90 degrees as he does, and now
and then asks for a jump. `footwork score BUNDLE --traces player.csv` plays it.
"""

import sys
from pathlib import Path

import numpy as np

HERTZ, SECONDS = 35, 60
WAYS = ((1, 0), (1, 0), (1, 1), (1, -1), (-1, 0), (0, 0))  # forward and strafe


def main(path: str) -> None:
    random = np.random.default_rng(1)
    lines = ["tick,forward,strafe,run,yaw_delta_deg,attack,use"]
    while len(lines) <= SECONDS * HERTZ:
        forward, strafe = random.choice(WAYS)
        run, jump, turn = random.random() < 0.4, random.random() < 0.15, random.choice([0, 45, -45, 90, -90])
        for tick in range(random.integers(12, 70)):
            yaw = turn / 10 if tick < 10 else 0
            lines.append(f"{len(lines) - 1},{forward},{strafe},{run:d},{yaw:g},{jump and tick < 5:d},0")
    Path(path).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
