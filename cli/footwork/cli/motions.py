"""Motions named on the command line: a folder of capture, or the motions that footwork generates itself."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cyclopts import Parameter

from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.motion.clip import Clip
    from footwork.training.dataset import Dataset

EMBEDDED = "embedded:"


@Parameter(name="*")
@dataclass(frozen=True)
class Reading:
    """Options of how a folder of capture is read.

    Args:
        labels: CSV file with set, file, start_frame, end_frame, label.
        ranges: CSV file with set, file, start_frame, end_frame: the parts to use; all where not given.
        table: Name table of a skeleton of your own (TOML); may be given several times.
        bvh_unit: Metres in one unit of length of the BVH files; they are in centimetres unless told otherwise.
    """

    labels: Path | None = None
    ranges: Path | None = None
    table: tuple[Path, ...] = ()
    bvh_unit: float = 0.01

    def __post_init__(self) -> None:
        if not (math.isfinite(self.bvh_unit) and self.bvh_unit > 0.0):
            raise InputError(f"{self.bvh_unit} metres, expected a positive number", "--bvh-unit")


AS_USUAL = Reading()


def load_motions(motions: str, reading: Reading = AS_USUAL) -> Dataset:
    """Clips on the common body from a folder, or from ``embedded:locomotion`` and ``embedded:fighting``.

    Raises:
        InputError: for files that cannot be read, and for options of reading where nothing is read.
    """
    if motions.startswith(EMBEDDED):
        if reading != AS_USUAL:
            problem = "embedded motions are not read from files, expected none of these options"
            raise InputError(problem, "--labels, --ranges, --table, --bvh-unit")
        return embedded_dataset(motions.removeprefix(EMBEDDED))
    from footwork.training.dataset import load_clips

    return load_clips(
        Path(motions),
        labels=reading.labels,
        ranges=reading.ranges,
        tables=reading.table,
        bvh_unit=reading.bvh_unit,
    )


def embedded_dataset(name: str) -> Dataset:
    """The generated motions called ``name``, with where they come from.

    Raises:
        InputError: for a name that is neither ``locomotion`` nor ``fighting``.
    """
    from footwork.training.dataset import Dataset
    from footwork.training.embedded import embedded_clips, fighting_clips

    generators = {"locomotion": embedded_clips, "fighting": fighting_clips}
    if name not in generators:
        raise InputError(f"no embedded motions {name!r}, there are {', '.join(generators)}", EMBEDDED + name)
    clips = generators[name]()
    return Dataset(clips=clips, files=[_provenance(clip) for clip in clips], attribution=())


def _provenance(clip: Clip) -> dict[str, object]:
    return {"file": clip.name, "frames": clip.frame_count, "generated": True}
