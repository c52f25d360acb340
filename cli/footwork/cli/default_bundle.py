"""The bundle of the demo: built once from the embedded motions (or a folder), then kept in the user's cache."""

from __future__ import annotations

import hashlib
import math
import os
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from footwork.cli.output import Report, log
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.motion.bundle import Bundle
    from footwork.training.dataset import Dataset

# What makes a character answer at once and go at a usual pace, and still builds while one waits.
THRESHOLD, BRIDGES = 1.0, 2
TASK = {
    "warp": math.radians(6.0),
    "reward": "sum",
    "transition_price": 0.001,
    "speeds": {"walk": (1.2,), "run": (2.8,)},
}


def cache_folder() -> Path:
    """Where bundles are kept between runs: ``footwork`` in the user's cache folder."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "footwork"


def build_or_reuse(dataset: Dataset, cache: Path, progress: Report) -> tuple[Path, Bundle]:
    """The bundle of ``dataset``, from ``cache`` where an intact one lies there."""
    from footwork.motion.bundle import read_bundle

    path = cache / f"{_fingerprint(dataset)}.footwork"
    if path.exists():
        try:
            return path, read_bundle(path)
        except InputError as error:
            log(f"building anew: {error}")
    return path, _build(dataset, path, progress)


def _build(dataset: Dataset, path: Path, progress: Report) -> Bundle:
    from footwork.motion.bundle import write_bundle
    from footwork.motion.task import SteeringTask
    from footwork.training.build import build_bundle
    from footwork.training.graph_options import GraphOptions

    path.parent.mkdir(parents=True, exist_ok=True)
    options = GraphOptions(threshold=THRESHOLD, mirror=True, bridges=BRIDGES)
    bundle, _ = build_bundle(dataset, options, task=SteeringTask(**TASK), progress=progress)
    write_bundle(path, bundle)
    return bundle


def _fingerprint(dataset: Dataset) -> str:
    """A name for what the bundle is made of: the motion, the version and how it is built."""
    how = version("footwork"), THRESHOLD, BRIDGES, TASK
    digest = hashlib.sha256(repr(how).encode())
    for clip in dataset.clips:
        for part in (clip.skeleton.offsets, clip.root_position, clip.rotations, clip.contacts):
            digest.update(part.tobytes())
        digest.update("\n".join((clip.name, *clip.labels)).encode())
    return digest.hexdigest()[:24]
