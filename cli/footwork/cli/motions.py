"""Motions named on the command line: a folder of capture, or the motions that footwork generates itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.motion.clip import Clip
    from footwork.training.dataset import Dataset

EMBEDDED = "embedded:"


def load_motions(motions: str, labels: Path | None, ranges: Path | None, tables: tuple[Path, ...]) -> Dataset:
    """Clips on the common body from a folder, or from ``embedded:locomotion`` and ``embedded:fighting``.

    Raises:
        InputError: for files that cannot be read, and for labels or ranges of embedded motions, which have none.
    """
    if not motions.startswith(EMBEDDED):
        from footwork.training.dataset import load_clips

        return load_clips(Path(motions), labels=labels, ranges=ranges, tables=tables)
    if labels or ranges or tables:
        raise InputError("embedded motions bring their own labels and body", "--labels, --ranges or --table")
    return embedded_dataset(motions.removeprefix(EMBEDDED))


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
