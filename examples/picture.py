"""The picture at the top of the README: python examples/picture.py BUNDLE PNG

A character walks, turns left, runs and comes back, as it is told to, and is drawn along its way.
"""

import sys

from footwork.motion.bundle import read_bundle
from footwork.study.portrait import draw_character
from footwork.study.steered_clip import steered_clip

ORDERS = [(3.0, 0.0, "walk"), (3.0, 90.0, "walk"), (1.6, 90.0, "run"), (1.6, 20.0, "run"), (2.2, 20.0, "stop")]
EVERY = 26  # frames from one pose to the next


def main(bundle: str, picture: str) -> None:
    clip = steered_clip(read_bundle(bundle), ORDERS)
    draw_character(picture, clip, frames=range(EVERY, clip.frame_count, EVERY))
    print(f"drew {picture}")


if __name__ == "__main__":
    main(*sys.argv[1:3])
