"""Contact sheets: the poses of a clip side by side on a PNG, for looking at motion without playing it."""

import math
import os
import re
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.body import NAMES
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.study import drawing
from footwork.study.camera import Camera
from footwork.study.drawing import Canvas
from footwork.study.figure import body_parts

View = Literal["side", "front", "three-quarter"]
# the camera's yaw against the direction the clip goes in, and how far it looks down
_VIEWS = {"side": (0.5 * math.pi, 0.06), "front": (math.pi, 0.06), "three-quarter": (0.8 * math.pi, 0.3)}
_PIXELS_PER_METRE = 92.0
_MARGIN = 0.14  # metres round each pose
_CAPTION = 0.34  # metres under each row: contacts, frame number, label strip
_TITLE = 0.3
MOST_POSES = 400


def contact_sheet(
    path: str | os.PathLike,
    clip: Clip,
    every: int | None = None,
    columns: int = 12,
    view: View = "side",
) -> Path:
    """Draw poses of a clip in rows, with frame numbers, labels and the feet in contact.

    All poses are seen from one direction, so that turns show: "side" looks at the right-hand side of the way
    the clip goes. Each is moved to its own cell. Left limbs are blue, right limbs orange.

    Args:
        path: the PNG to write.
        clip: on the common body, or on any skeleton in metres (drawn as sticks).
        every: draw each ``every``-th frame; by default about forty-eight poses.
        columns: poses in a row.
        view: where to look from.

    Raises:
        InputError: for an unknown view, counts below one, more than MOST_POSES poses, a place that cannot be
            written or a missing matplotlib.
    """
    if view not in _VIEWS:
        raise InputError(f"view {view!r}, expected one of {', '.join(_VIEWS)}", clip.name)
    every = max(1, math.ceil(clip.frame_count / 48)) if every is None else every
    if every < 1 or columns < 1:
        raise InputError(f"every {every} and columns {columns}, expected at least 1", clip.name)
    frames = np.arange(0, clip.frame_count, every)
    if len(frames) > MOST_POSES:
        raise InputError(f"{len(frames)} poses, expected at most {MOST_POSES}: raise every", clip.name)
    plt = drawing.pyplot()
    return drawing.save(_Sheet(clip, frames, columns, view).draw(plt), path)


def contact_sheets(directory: str | os.PathLike, clips: list[Clip], view: View = "side") -> list[Path]:
    """Draw one contact sheet a clip into ``directory``, named after the clips, and return their paths.

    Raises:
        InputError: as ``contact_sheet``, and for a folder that cannot be made.
    """
    directory = Path(directory)
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be made ({error.strerror})", directory) from None
    return [contact_sheet(directory / f"{_file_name(clip.name)}.png", clip, view=view) for clip in clips]


def _file_name(name: str) -> str:
    """A clip's name with nothing in it that a file's name may not hold: ``walk.bvh[0:60]`` is ``walk_bvh_0_60``."""
    return re.sub(r"[^A-Za-z0-9-]+", "_", name).strip("_") or "clip"


def clip_yaw(clip: Clip, places: NDArray) -> float:
    """The way a clip goes: from its first root to its last, or where it first faces if that is under 0.3 m."""
    travel = clip.root_position[-1] - clip.root_position[0]
    if math.hypot(travel[0], travel[2]) > 0.3:
        return math.atan2(travel[0], travel[2])
    return float(facing_yaw(clip.skeleton, places[0])) if clip.skeleton.names == NAMES else 0.0


class _Sheet:
    """One sheet under way: what to draw and where the cells lie, in metres with y up."""

    def __init__(self, clip: Clip, frames: NDArray, columns: int, view: View) -> None:
        places, turns = clip_places(clip)
        yaw, pitch = _VIEWS[view]
        self.clip, self.frames, self.parts = clip, frames, body_parts(clip.skeleton)
        self.camera = Camera(clip_yaw(clip, places) + yaw, pitch)
        self.places, self.turns = places[frames].copy(), turns[frames]
        self.places[:, :, [0, 2]] -= self.places[:, :1, [0, 2]]
        picture = self.camera.project(self.places)[0]
        self.left = float(picture[..., 0].min()) - _MARGIN
        self.cell = float(picture[..., 0].max()) + _MARGIN - self.left
        self.top = max(float(picture[..., 1].max()), 1.0) + _MARGIN + 0.08
        self.bottom = min(float(picture[..., 1].min()), 0.0) - 0.12
        self.columns = min(columns, len(frames))
        self.rows = math.ceil(len(frames) / columns)
        self.row = self.top - self.bottom + _CAPTION

    def cell_origin(self, index: int) -> tuple[float, float]:
        """Where the ground point under pose ``index`` lies on the sheet."""
        row, column = divmod(index, self.columns)
        return column * self.cell - self.left, -_TITLE - row * self.row - self.top

    def draw(self, plt: Any) -> Any:
        """The whole sheet as a matplotlib figure."""
        width, height = self.columns * self.cell, _TITLE + self.rows * self.row
        size = (width * _PIXELS_PER_METRE / 100, height * _PIXELS_PER_METRE / 100)
        figure = plt.figure(figsize=size, facecolor=drawing.PAPER)
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set(xlim=(0, width), ylim=(-height, 0))
        axes.axis("off")
        seconds = f"{self.clip.frame_count} frames, {self.clip.seconds:.1f} s at {self.clip.fps:g} Hz"
        axes.text(0.08, -0.17, self.clip.name, color=drawing.INK, fontsize=10, weight="bold", va="center")
        axes.text(width - 0.08, -0.17, seconds, color=drawing.FAINT, fontsize=8, va="center", ha="right")
        self._draw_ground(axes, width)
        canvas = Canvas()
        self._add_shadows(canvas)
        for index in range(len(self.frames)):
            origin = self.cell_origin(index)
            drawing.add_figure(canvas, self.parts, self.places[index], self.turns[index], self.camera, shift=origin)
            self._add_contacts(canvas, index)
        canvas.paint(axes)
        self._draw_captions(axes)
        return figure

    def _draw_ground(self, axes: Any, width: float) -> None:
        for row in range(self.rows):
            y = self.cell_origin(row * self.columns)[1]
            axes.axhspan(y + self.bottom, y, color=drawing.GROUND, lw=0)
            axes.plot([0, width], [y, y], color=drawing.mix(drawing.GROUND, drawing.INK, 0.3), lw=0.6)

    def _add_shadows(self, canvas: Canvas) -> None:
        for grow, shade in ((0.04, 0.07), (0.0, 0.16)):
            colour = drawing.mix(drawing.GROUND, drawing.INK, shade)
            for index in range(len(self.frames)):
                drawing.add_shadow(
                    canvas,
                    self.parts,
                    self.places[index],
                    self.turns[index],
                    self.camera,
                    grow=grow,
                    colour=colour,
                    shift=self.cell_origin(index),
                )

    def _add_contacts(self, canvas: Canvas, index: int) -> None:
        x, y = self.cell_origin(index)
        for foot, (_, ball) in enumerate(self.clip.skeleton.feet):
            if self.clip.contacts[self.frames[index], foot]:
                across = self.camera.project(self.places[index, ball])[0][0]
                centre = np.array(
                    [[x + across - 0.05, y + self.bottom - 0.045], [x + across + 0.05, y + self.bottom - 0.045]]
                )
                paint = drawing.PAINTS["left" if foot == 0 else "right"]
                canvas.add(drawing.hull(centre, np.array([0.02, 0.02])), paint)

    def _draw_captions(self, axes: Any) -> None:
        labels = self.clip.labels[self.frames]
        colours = drawing.label_colours(list(labels))
        for index, frame in enumerate(self.frames):
            x, y = self.cell_origin(index)
            strip = y + self.bottom - 0.27
            left = x + self.left
            axes.fill_between([left, left + self.cell], strip, strip + 0.09, color=colours[str(labels[index])], lw=0)
            axes.text(x, y + self.bottom - 0.12, str(frame), color=drawing.FAINT, fontsize=6, ha="center", va="center")
            first = index % self.columns == 0 or labels[index] != labels[index - 1]
            if first and labels[index]:
                axes.text(left + 0.05, strip + 0.043, str(labels[index]), color="white", fontsize=6, va="center")
