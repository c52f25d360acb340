"""A small folder of motions laid out as the reproduction of the papers wants it, made of generated clips."""

from collections.abc import Sequence
from pathlib import Path

from footwork.motion.bvh import write_bvh
from footwork.training.embedded import embedded_clips

FROM, FRAMES = 20, 70  # of each clip, so that a search takes no time
# set -> clip -> how many of its frames are in the core
LAYOUT = {
    "dataset1": {"walk_slow": 60, "walk_normal": 60},
    "dataset2": {"walk_normal": 60, "curve_wide_left": 60},
    "dataset3": {"walk_normal": 60, "run_short": 60, "walk_duck": 60},
}


def write_motion_sets(folder: Path) -> Path:
    """Write the three sets with their labels and core ranges, and return the folder."""
    clips = {clip.name: clip for clip in embedded_clips()}
    labels, ranges = ["set,file,start_frame,end_frame,label"], ["set,file,start_frame,end_frame"]
    for name, cores in LAYOUT.items():
        (folder / name).mkdir(parents=True)
        for clip_name, frames in cores.items():
            clip, file = clips[clip_name].cut(FROM, FROM + FRAMES), f"{clip_name}.bvh"
            write_bvh(folder / name / file, clip)
            labels += [f"{name},{file},{start},{end},{label}" for start, end, label in _runs(list(clip.labels))]
            ranges.append(f"{name},{file},0,{frames}")
    (folder / "labels.csv").write_text("\n".join(labels) + "\n")
    (folder / "core_ranges.csv").write_text("\n".join(ranges) + "\n")
    return folder


def _runs(labels: Sequence[str]) -> list[tuple[int, int, str]]:
    starts = [0, *(at for at in range(1, len(labels)) if labels[at] != labels[at - 1])]
    return [(start, end, labels[start]) for start, end in zip(starts, [*starts[1:], len(labels)], strict=True)]
