"""What benchmarks run on: dataset3's core ranges where they lie beside the checkout, made-up motion otherwise."""

import sys
from collections.abc import Sequence
from pathlib import Path

from footwork.motion.clip import Clip

ROOT = Path(__file__).resolve().parents[2]
MOTIONS = ROOT.parent / "shared" / "motions"
# the lengths of dataset3's core ranges, 2,721 frames in all
LENGTHS = (120, 183, 246, 227, 306, 218, 181, 236, 210, 156, 189, 96, 46, 121, 81, 105)


def benchmark_clips() -> tuple[str, Sequence[Clip]]:
    """The name of the motion and its clips."""
    if MOTIONS.is_dir():
        from footwork.training.dataset import load_clips

        labels, ranges = MOTIONS / "labels.csv", MOTIONS / "core_ranges.csv"
        return "dataset3 core", load_clips(MOTIONS / "dataset3", labels=labels, ranges=ranges).clips
    sys.path.insert(0, str(ROOT / "tests"))
    from motion_samples import sample_clip

    return "made up", [sample_clip(seed, frames) for seed, frames in enumerate(LENGTHS)]
