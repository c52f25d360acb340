"""Steers a character to the left and to the right for three seconds: python examples/steer.py [ADDRESS]

Start a server first: footwork serve BUNDLE
"""

import math
import sys

from footwork.protocol.client import DEFAULT_ADDRESS, Client
from footwork.protocol.pose_arrays import root_of

TICKS = 90
PATIENCE = 60.0  # seconds; a server's first start on a machine compiles before it answers


def main(address: str = DEFAULT_ADDRESS) -> None:
    with Client(address, name="steer.py", timeout=PATIENCE) as client:
        behaviours = client.welcome.behaviours
        behaviour = "walk" if "walk" in behaviours else behaviours[0]
        client.spawn(0)
        first = client.welcome.tick
        for pose in client.poses():
            passed = pose.tick - first
            if passed > TICKS:
                break
            if pose.frame == 1:
                heading = math.copysign(math.pi / 2, math.sin(2 * math.pi * passed / TICKS))
                client.command(0, heading, behaviour)
            if passed % 30 == 0 and pose.frame == 1:
                x, _, z = root_of(pose)
                doing = behaviours[pose.behaviour] if pose.behaviour >= 0 else "nothing"
                print(f"{passed / 30:4.1f} s  at ({x:5.2f}, {z:5.2f}) m  facing {pose.facing:5.2f} rad  {doing}")


if __name__ == "__main__":
    main(*sys.argv[1:])
