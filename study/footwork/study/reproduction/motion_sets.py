"""The folder of motions that the reproduction needs: three sets of capture, their labels and their core ranges."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from footwork.errors import InputError

SETS = ("dataset1", "dataset2", "dataset3")
LABELS, RANGES = "labels.csv", "core_ranges.csv"


@dataclass(frozen=True)
class MotionSets:
    """The three sets of a folder: one walker of many step lengths, several walkers, one person of many behaviours.

    Args:
        folder: holds the folders SETS and the tables LABELS and RANGES.

    Raises:
        InputError: where one of them is missing.
    """

    folder: Path

    def __post_init__(self) -> None:
        missing = [name for name in SETS if not (self.folder / name).is_dir()]
        missing += [name for name in (LABELS, RANGES) if not (self.folder / name).is_file()]
        if missing:
            expected = f"the folders {', '.join(SETS)} and the tables {LABELS}, {RANGES}"
            raise InputError(f"has no {', '.join(missing)}, expected {expected}", self.folder)

    @cached_property
    def labels(self) -> Path:
        """Table of labels."""
        return self.folder / LABELS

    @cached_property
    def ranges(self) -> Path:
        """Table of the parts whose sizes are those of the papers' experiments."""
        return self.folder / RANGES
