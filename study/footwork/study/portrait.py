"""One good picture of a character on the move: poses along its way in perspective, with the trail of its root."""

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.study import drawing
from footwork.study.camera import Camera
from footwork.study.drawing import Canvas
from footwork.study.figure import body_parts

_EDGE = 0.06  # share of the picture kept free on each side


def draw_character(
    path: str | os.PathLike,
    clip: Clip,
    *,
    frames: Sequence[int] | None = None,
    view_yaw: float | None = None,
    pitch: float = 0.32,
    size: tuple[int, int] = (1600, 500),
) -> Path:
    """Draw poses of a clip where they are on the ground, early ones paler, with a grid, shadows and the root's trail.

    Args:
        path: the PNG to write.
        clip: on the common body, or on any skeleton in metres.
        frames: which poses; by default nine, evenly spread along the way.
        view_yaw: where the camera looks, radians; by default across the way from first to last root.
        pitch: how far the camera looks down, radians.
        size: of the picture, pixels.

    Raises:
        InputError: for frames outside the clip, a place that cannot be written or a missing matplotlib.
    """
    chosen = _along_the_way(clip.root_position, 9) if frames is None else np.asarray(frames, dtype=int)
    if not chosen.size or chosen.min() < 0 or chosen.max() >= clip.frame_count:
        raise InputError(f"frames {list(chosen)}, expected some of 0 to {clip.frame_count - 1}", clip.name)
    plt = drawing.pyplot()
    places, turns = clip_places(clip)
    camera = _camera(places[:, 0], _across(places[:, 0]) if view_yaw is None else view_yaw, pitch)
    figure = plt.figure(figsize=(size[0] / 100, size[1] / 100), facecolor=drawing.PAPER)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.axis("off")
    _frame(axes, camera.project(places[chosen])[0], size[0] / size[1])
    _draw_grid(axes, camera, places[:, 0])
    _draw_trail(axes, camera, places[:, 0])
    _shadows(clip, chosen, places, turns, camera).paint(axes, zorder=1.0)
    _figures(clip, chosen, places, turns, camera).paint(axes, line_width=0.8)
    return drawing.save(figure, path)


def _along_the_way(root: NDArray, count: int) -> NDArray[np.intp]:
    """Frames evenly spread over how far the root went and, a little, over time, so that standing shows too."""
    gone = np.linalg.norm(np.diff(root[:, [0, 2]], axis=0), axis=1) + 0.002
    way = np.concatenate([[0.0], np.cumsum(gone)])
    return np.searchsorted(way, np.linspace(0.0, way[-1], count)).clip(0, len(root) - 1)


def _across(root: NDArray) -> float:
    travel = root[-1] - root[0]
    return math.atan2(travel[0], travel[2]) + 0.5 * math.pi


def _camera(root: NDArray, yaw: float, pitch: float) -> Camera:
    middle = 0.5 * (root.min(axis=0) + root.max(axis=0))
    reach = float(np.ptp(root[:, [0, 2]], axis=0).max())
    return Camera(yaw, pitch, (float(middle[0]), 0.9, float(middle[2])), distance=4.0 + 1.3 * reach)


def _frame(axes: Any, picture: NDArray, aspect: float) -> None:
    """Fit the picture's limits round the poses, whatever is longer."""
    low, high = picture.reshape(-1, 2).min(axis=0) - 0.15, picture.reshape(-1, 2).max(axis=0) + 0.15
    middle, half = 0.5 * (low + high), 0.5 * (high - low) / (1.0 - 2.0 * _EDGE)
    half = np.maximum(half, [half[1] * aspect, half[0] / aspect])
    axes.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))


def _draw_grid(axes: Any, camera: Camera, root: NDArray) -> None:
    """Lines on the ground each half metre, fading with the distance from the way."""
    low, high = np.floor(root.min(axis=0)) - 5.0, np.ceil(root.max(axis=0)) + 5.0
    colour = drawing.mix(drawing.PAPER, drawing.INK, 0.13)
    for axis, other in ((0, 2), (2, 0)):
        along = np.linspace(low[other], high[other], 60)
        for value in np.arange(low[axis], high[axis] + 0.25, 0.5):
            line = np.zeros((len(along), 3))
            line[:, axis], line[:, other] = value, along
            _draw_fading(axes, camera, line, root, colour)


def _draw_fading(axes: Any, camera: Camera, line: NDArray, root: NDArray, colour: str) -> None:
    from matplotlib.collections import LineCollection

    away = np.linalg.norm(line[:, None, [0, 2]] - root[None, ::5, [0, 2]], axis=-1).min(axis=1)
    strength = np.clip(1.2 - away / 3.0, 0.0, 1.0)[:-1]
    picture = camera.project(line)[0]
    pieces = np.stack([picture[:-1], picture[1:]], axis=1)
    axes.add_collection(LineCollection(list(pieces), colors=colour, alpha=strength, linewidths=0.8, zorder=0.5))


def _draw_trail(axes: Any, camera: Camera, root: NDArray) -> None:
    trail = camera.project(root * [1.0, 0.0, 1.0])[0]
    axes.plot(*trail.T, color=drawing.PAPER, lw=5, solid_capstyle="round")
    axes.plot(*trail.T, color=drawing.mix(drawing.LABEL_COLOURS["walk"], drawing.PAPER, 0.1), lw=2.5)


def _shadows(clip: Clip, chosen: NDArray, places: NDArray, turns: NDArray, camera: Camera) -> Canvas:
    canvas, parts = Canvas(), body_parts(clip.skeleton)
    for grow, shade in ((0.06, 0.05), (0.035, 0.1), (0.01, 0.16), (-0.01, 0.22)):
        colour = drawing.mix(drawing.PAPER, drawing.INK, shade)
        for frame in chosen:
            drawing.add_shadow(canvas, parts, places[frame], turns[frame], camera, grow=grow, colour=colour)
    return canvas


def _figures(clip: Clip, chosen: NDArray, places: NDArray, turns: NDArray, camera: Camera) -> Canvas:
    canvas, parts = Canvas(), body_parts(clip.skeleton)
    depth = camera.project(places[chosen, 0])[1]
    for index in np.argsort(depth)[::-1]:
        fade = 0.4 * (1.0 - (index + 1) / len(chosen))
        drawing.add_figure(canvas, parts, places[chosen[index]], turns[chosen[index]], camera, fade=fade)
    return canvas
