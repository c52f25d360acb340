"""A map of characters, seen from above: where somebody is, went and looks."""

import math
from collections.abc import Sequence

METRES = 0.25
"""How wide one character of the map is; lines are twice as far apart as characters."""
GRID = 5.0
_ARROWS = "↑↖←↙↓↘→↗"


def text_map(
    trail: Sequence[tuple[float, float]],
    facing: float,
    width: int,
    height: int,
    others: Sequence[tuple[float, float]] = (),
) -> str:
    """Lines of text around the last place of a trail; +z is up and +x to the left, as yaw 0 looks along +z.

    Args:
        trail: places x, z in metres, the newest last.
        facing: yaw, radians; positive turns left.
        width: characters in a line.
        height: lines.
        others: places of others, shown by a cross.
    """
    x, z = trail[-1]
    rows = [[_ground(x, z, row, column, width, height) for column in range(width)] for row in range(height)]
    for mark, places in (("·", trail), ("x", others)):
        for place in places:
            row, column = _cell(place[0] - x, place[1] - z, width, height)
            if 0 <= row < height and 0 <= column < width:
                rows[row][column] = mark
    row, column = _cell(0.0, 0.0, width, height)
    rows[row][column] = _ARROWS[round(facing / (math.pi / 4)) % 8]
    return "\n".join("".join(line) for line in rows)


def _cell(x: float, z: float, width: int, height: int) -> tuple[int, int]:
    return height // 2 - round(z / (2.0 * METRES)), width // 2 - round(x / METRES)


def _ground(x: float, z: float, row: int, column: int, width: int, height: int) -> str:
    """A cross in the cell that a crossing of the grid lies in."""
    across, along = x - (column - width // 2) * METRES, z - (row - height // 2) * 2.0 * METRES
    return "+" if _near_grid(across, METRES) and _near_grid(along, 2.0 * METRES) else " "


def _near_grid(value: float, size: float) -> bool:
    return abs(value - GRID * round(value / GRID)) <= size / 2.0
