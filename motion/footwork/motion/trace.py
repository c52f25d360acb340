"""Recorded players: traces of what a human held, tick by tick, and the steering commands they stand for.

Format and convention: traces/PROVENANCE.md.
"""

import hashlib
import math
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen
from footwork.motion.keys import heading_of_keys
from footwork.motion.task import BEHAVIOURS
from footwork.motion.textfile import lines_of, number, read_data
from footwork.motion.tick import TICK_RATE

SOURCE_HZ = 35
JUMP_SECONDS = 0.33
"""How long a press of attack asks for a jump."""
JUMP_PAUSE = 2.0
"""A press is taken only this long after the last one taken, seconds."""
_LIMITS = {
    "tick": (0.0, 1e7),
    "forward": (-1.0, 1.0),
    "strafe": (-1.0, 1.0),
    "run": (0.0, 1.0),
    "yaw_delta_deg": (-180.0, 180.0),
    "attack": (0.0, 1.0),
    "use": (0.0, 1.0),
}
COLUMNS = tuple(_LIMITS)


@dataclass(frozen=True, eq=False)
class Trace:
    """What one player held at each tick of 1/35 s.

    Args:
        name: the file it came from.
        forward: -1 back, 0, 1 forward.  # (T,)
        strafe: -1 left, 0, 1 right.  # (T,)
        run: whether run was held.  # (T,) bool
        yaw_delta: turn of the view in this tick, radians, positive left.  # (T,)
        attack: whether attack was held.  # (T,) bool
        use: whether use was held.  # (T,) bool
        digest: SHA-256 of the file, empty for a trace that was not read from one.
    """

    name: str
    forward: NDArray[np.int8]
    strafe: NDArray[np.int8]
    run: NDArray[np.bool_]
    yaw_delta: NDArray[np.float64]
    attack: NDArray[np.bool_]
    use: NDArray[np.bool_]
    digest: str = ""

    @property
    def ticks(self) -> int:
        """How many ticks of 1/35 s it has."""
        return len(self.forward)

    @property
    def seconds(self) -> float:
        """How long it is."""
        return self.ticks / SOURCE_HZ


@dataclass(frozen=True, eq=False)
class SteeringCommands:
    """What a trace asks for at each tick of 1/30 s.

    Args:
        heading: wanted yaw in the world, radians.  # (K,)
        behaviour: index into ``task.BEHAVIOURS``.  # (K,)
        jump: number of the jump window that the tick lies in, -1 for none.  # (K,)
    """

    heading: NDArray[np.float64]
    behaviour: NDArray[np.int32]
    jump: NDArray[np.int32]

    def first(self, ticks: int | None) -> "SteeringCommands":
        """The first so many ticks, all of them for None."""
        return SteeringCommands(self.heading[:ticks], self.behaviour[:ticks], self.jump[:ticks])


def read_trace(path: str | Path) -> Trace:
    """Read a trace from a CSV file with a header line; columns may stand in any order, others are ignored.

    Raises:
        InputError: naming the line, for columns that are missing or there twice, cells that are no numbers or out of
            range, ticks that do not count up from 0 one by one (gaps, another rate), and for fewer than two rows.
    """
    data = read_data(path)
    lines = [(place, line) for place, line in enumerate(lines_of(data), 1) if line.strip()]
    header = [cell.strip() for cell in lines[0][1].decode("utf-8", errors="replace").split(",")] if lines else []
    _check_header(header, f"{path}:{lines[0][0] if lines else 1}")
    if len(lines) < 3:
        raise InputError(f"rows: {len(lines) - 1}, expected at least 2", path)
    places = [header.index(name) for name in COLUMNS]
    rows = [_row(line, len(header), places, f"{path}:{place}") for place, line in lines[1:]]
    columns = dict(zip(COLUMNS, np.array(rows).T, strict=True))
    _check_ticks(columns["tick"], [place for place, _ in lines[1:]], path)
    return Trace(
        name=Path(path).name,
        forward=frozen(columns["forward"], np.int8),
        strafe=frozen(columns["strafe"], np.int8),
        run=frozen(columns["run"], np.bool_),
        yaw_delta=frozen(np.radians(columns["yaw_delta_deg"]), np.float64),
        attack=frozen(columns["attack"], np.bool_),
        use=frozen(columns["use"], np.bool_),
        digest=hashlib.sha256(data).hexdigest(),
    )


def _check_header(header: list[str], where: str) -> None:
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        raise InputError(f"no column {', '.join(missing)}, expected {','.join(COLUMNS)}", where)
    twice = [name for name in COLUMNS if header.count(name) > 1]
    if twice:
        raise InputError(f"column {twice[0]} is there twice", where)


def _row(line: bytes, width: int, places: list[int], where: str) -> list[float]:
    cells = line.split(b",")
    if len(cells) != width:
        raise InputError(f"{len(cells)} cells, but the header has {width}", where)
    values = [number(cells[place].strip(), where) for place in places]
    for name, value in zip(COLUMNS, values, strict=True):
        low, high = _LIMITS[name]
        if not low <= value <= high:
            raise InputError(f"{name} is {value:g}, expected {low:g} to {high:g}", where)
        if name != "yaw_delta_deg" and value != math.floor(value):
            raise InputError(f"{name} is {value:g}, expected a whole number", where)
    return values


def _check_ticks(ticks: NDArray, lines: list[int], path: str | Path) -> None:
    wrong = np.flatnonzero(ticks != np.arange(len(ticks)))
    if wrong.size == 0:
        return
    row = int(wrong[0])
    where, steps = f"{path}:{lines[row]}", np.diff(ticks)
    if steps[0] > 1 and (steps == steps[0]).all():
        rate = f"{SOURCE_HZ / steps[0]:.4g}"
        raise InputError(f"every row is {steps[0]:g} ticks on ({rate} rows a second), expected {SOURCE_HZ}", where)
    raise InputError(f"tick {ticks[row]:g}, expected {row}: ticks count up from 0 one by one", where)


def steering_commands(trace: Trace, start_facing: float, behaviours: Collection[str]) -> SteeringCommands:
    """What a trace asks for at the controller's ticks, 30 a second: the latest source tick not after each.

    Source: traces/PROVENANCE.md, "As steering commands".

    Args:
        trace: the recording.
        start_facing: the character's own facing at the start, where the view begins, radians.
        behaviours: those that the graph shows; without run among them, run is taken as walk.
    """
    view = start_facing + np.cumsum(trace.yaw_delta)
    heading = heading_of_keys(view, trace.forward, trace.strafe)
    moving = (trace.forward != 0) | (trace.strafe != 0)
    fast = BEHAVIOURS.index("run" if "run" in behaviours else "walk")
    behaviour = np.where(trace.run, fast, BEHAVIOURS.index("walk"))
    behaviour = np.where(moving, behaviour, BEHAVIOURS.index("stop"))
    jump = jump_windows(trace.attack)
    behaviour = np.where(jump >= 0, BEHAVIOURS.index("jump"), behaviour)
    latest = np.arange(-(-trace.ticks * TICK_RATE // SOURCE_HZ)) * SOURCE_HZ // TICK_RATE
    return SteeringCommands(
        heading=frozen(heading[latest], np.float64),
        behaviour=frozen(behaviour[latest], np.int32),
        jump=frozen(jump[latest], np.int32),
    )


def jump_windows(attack: ArrayLike) -> NDArray[np.int32]:
    """The number of the jump window that each source tick lies in, -1 for none.  # (T,) bool -> (T,)

    A window opens when attack goes down at least JUMP_PAUSE after the last one opened, and lasts JUMP_SECONDS.
    """
    held = np.asarray(attack, dtype=bool)
    presses = np.flatnonzero(held & ~np.concatenate([[False], held[:-1]]))
    windows = np.full(len(held), -1, dtype=np.int32)
    length = math.ceil(JUMP_SECONDS * SOURCE_HZ)
    last, count = -math.inf, 0
    for press in presses:
        if press - last >= JUMP_PAUSE * SOURCE_HZ:
            windows[press : press + length] = count
            last, count = press, count + 1
    return windows
