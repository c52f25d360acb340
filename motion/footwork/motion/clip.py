"""A stretch of motion of one skeleton at an even frame rate."""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_shape
from footwork.motion.skeleton import Skeleton

UNLABELLED = ""


@dataclass(frozen=True, eq=False)
class Clip:
    """Frames of motion: where the root is and how every joint is turned in its parent's frame.

    Args:
        name: the file it came from, such as ``07_01.amc``.
        skeleton: the body that moves.
        fps: frames a second.
        root_position: place of joint 0 in the world, metres.  # (F, 3)
        rotations: local rotation of each joint, unit quaternions xyzw.  # (F, J, 4)
        contacts: which feet stand on the ground.  # (F, feet) bool
        labels: what the body does, one word a frame, empty for none.  # (F,) str
        translations: place of each joint in its parent's frame, metres, for files that move joints apart
            (position channels on joints other than the root); None where the skeleton's offsets hold.  # (F, J, 3)

    Raises:
        InputError: for a clip with no frames, wrong shapes or numbers that are not finite.
    """

    name: str
    skeleton: Skeleton
    fps: float
    root_position: NDArray[np.float64]
    rotations: NDArray[np.float64]
    contacts: NDArray[np.bool_] = field(default=None)  # type: ignore[assignment]
    labels: NDArray[np.str_] = field(default=None)  # type: ignore[assignment]
    translations: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        frames = len(self.rotations)
        fill = {"contacts": np.zeros((frames, len(self.skeleton.feet))), "labels": np.full(frames, UNLABELLED)}
        kinds = {"root_position": np.float64, "rotations": np.float64, "contacts": np.bool_, "labels": np.str_}
        for name, kind in kinds.items():
            value = getattr(self, name)
            object.__setattr__(self, name, frozen(fill[name] if value is None else value, kind))
        if self.translations is not None:
            object.__setattr__(self, "translations", frozen(self.translations, np.float64))
        self._check()

    def _check(self) -> None:
        frames, joints = len(self.rotations), self.skeleton.joint_count
        if frames == 0:
            raise InputError("the clip is empty, expected at least one frame", self.name)
        if not (np.isfinite(self.fps) and self.fps > 0):
            raise InputError(f"{self.fps} frames a second, expected a positive number", self.name)
        shapes = {
            "root_position": (frames, 3),
            "rotations": (frames, joints, 4),
            "contacts": (frames, len(self.skeleton.feet)),
            "labels": (frames,),
        }
        if self.translations is not None:
            shapes["translations"] = (frames, joints, 3)
        for name, shape in shapes.items():
            require_shape(getattr(self, name), shape, name, self.name)
            if name not in ("contacts", "labels"):
                require_finite(getattr(self, name), name, self.name)

    @property
    def frame_count(self) -> int:
        """The number of frames F."""
        return len(self.rotations)

    @property
    def seconds(self) -> float:
        """The time from the first frame to the last."""
        return (self.frame_count - 1) / self.fps

    def cut(self, start: int, end: int) -> "Clip":
        """The frames start..end-1 as a clip of their own.

        Raises:
            InputError: unless ``0 <= start < end <= frame_count``.
        """
        if not 0 <= start < end <= self.frame_count:
            raise InputError(f"frames {start}..{end}, expected a range inside 0..{self.frame_count}", self.name)
        names = ("root_position", "rotations", "contacts", "labels", "translations")
        parts = {name: value[start:end] for name in names if (value := getattr(self, name)) is not None}
        return replace(self, **parts)
