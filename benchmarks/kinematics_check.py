"""Check readers and kinematics on every motion file against a second reading that shares no code with them.

Prints one JSON object: files, frames, the worst error of any joint or tip in any frame, and the worst error after the
clip was written as BVH and read again, both in metres. Run ``python benchmarks/kinematics_check.py [MOTIONS]``.
"""

import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from footwork.motion.bvh import read_bvh, write_bvh  # noqa: E402
from footwork.motion.capture import read_capture  # noqa: E402
from footwork.motion.clip import Clip  # noqa: E402
from footwork.motion.kinematics import clip_places  # noqa: E402
from footwork.motion.quaternion import rotate  # noqa: E402
from plain_motion_reader import plain_places  # noqa: E402


def places(clip: Clip) -> dict[str, NDArray[np.float64]]:
    """World places (F, 3) in metres of every joint, and of the tips that the skeleton knows."""
    joints, turns = clip_places(clip)
    tips = joints + rotate(turns, clip.skeleton.ends)
    found = {name: joints[:, joint] for joint, name in enumerate(clip.skeleton.names)}
    with_tip = np.flatnonzero(clip.skeleton.ends.any(axis=1))
    return found | {f"{clip.skeleton.names[joint]} tip": tips[:, joint] for joint in with_tip}


def worst(ours: dict[str, NDArray[np.float64]], theirs: dict[str, NDArray[np.float64]]) -> float:
    """The largest distance between two places of the same name, metres."""
    return max(float(np.linalg.norm(ours[name] - theirs[name], axis=-1).max()) for name in ours)


def main() -> None:
    """Check every file under the folder named on the command line, or beside the checkout."""
    motions = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT.parent / "shared" / "motions"
    if not motions.is_dir():
        print(json.dumps({"skipped": f"no motion capture at {motions}"}))
        return
    report = {"files": 0, "frames": 0, "worst_error_m": 0.0, "round_trip_error_m": 0.0}
    with TemporaryDirectory() as folder:
        copy = Path(folder) / "copy.bvh"
        for path in sorted([*motions.rglob("*.bvh"), *motions.rglob("*.amc")]):
            clip = read_capture(path)
            write_bvh(copy, clip)
            ours = places(clip)
            report["files"] += 1
            report["frames"] += clip.frame_count
            report["worst_error_m"] = max(report["worst_error_m"], worst(ours, plain_places(path)))
            report["round_trip_error_m"] = max(report["round_trip_error_m"], worst(ours, places(read_bvh(copy))))
    print(json.dumps(report))


if __name__ == "__main__":
    main()
