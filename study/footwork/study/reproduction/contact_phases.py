"""Why one metric's picks skate less than another's: what their feet do, and how they are laid."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.clip import Clip
from footwork.study.bootstrap import ratio
from footwork.study.reproduction.row import OURS, Cell, Column, Table
from footwork.study.transition_slide import TransitionSlide
from footwork.training.transitions import Minima

SAME, CHANGED, AIRBORNE = "the same feet stand", "other feet stand", "no foot stands"


def phases_of_picks(clips: Sequence[Clip], picks: Minima) -> dict[str, NDArray[np.bool_]]:
    """Which picks join two frames at which the same feet stand, other feet, or none at either.  # (M,) each"""
    contacts = np.concatenate([clip.contacts for clip in clips])
    here, there = contacts[picks.i], contacts[picks.j]
    alike = (here == there).all(axis=1)
    none = alike & ~here.any(axis=1)
    return {SAME: alike & ~none, CHANGED: ~alike, AIRBORNE: none}


def phase_lines(clips: Sequence[Clip], picks: Minima, slide: TransitionSlide) -> dict[str, dict[str, Any]]:
    """For each phase the share of the picks and their arc length, cm for each foot that stands."""
    lines = {}
    for name, chosen in phases_of_picks(clips, picks).items():
        both = np.concatenate([chosen, chosen])
        arc = ratio(slide.either.arc[both].sum(axis=1), slide.either.stands[both].sum(axis=1))
        lines[name] = {"share": float(chosen.mean()), "arc": arc}
    return lines


def phase_table(caption: str, found: dict[str, dict[str, dict[str, Any]]]) -> Table:
    """A line for each metric: share and arc length by phase."""
    columns = [Column("metric")]
    for name in (SAME, CHANGED, AIRBORNE):
        columns += [Column(name, "% of picks", OURS, 0), Column("arc length", "cm", OURS)]
    lines: list[list[Cell]] = []
    for metric, phases in found.items():
        line: list[Cell] = [metric]
        for phase in phases.values():
            line += [100.0 * phase["share"], phase["arc"].words()]
        lines.append(line)
    return Table(caption, columns, lines)
