"""Exchange sheets: moments of a fight side by side on a PNG, both fighters in each, seen from beside them."""

import math
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.kinematics import forward
from footwork.motion.skeleton import Skeleton
from footwork.study import drawing
from footwork.study.camera import Camera
from footwork.study.drawing import Canvas
from footwork.study.figure import LEFT, RIGHT, TRUNK, Part, body_parts

MOST_MOMENTS = 200
_WIDTH, _HEIGHT = 3.8, 2.35  # metres of a cell
_GROUND = 0.3  # metres of a cell under the middle of the ground
_PIXELS_PER_METRE = 68.0
_PITCH = 0.14
_OTHERS_PAINT = {LEFT: RIGHT, RIGHT: LEFT}


def exchange_sheet(
    path: str | os.PathLike, skeleton: Skeleton, poses: NDArray, captions: Sequence[str], columns: int = 6
) -> Path:
    """Draw moments of a fight in rows; the second fighter is paler.

    Args:
        path: the PNG to write.
        skeleton: of both.
        poses: place of joint 0, then local rotations, of both.  # (F, 2, 3 + 4 J)
        captions: a line under each moment.  # F
        columns: moments in a row.

    Raises:
        InputError: for no moments or more than MOST_MOMENTS, a place that cannot be written or a missing matplotlib.
    """
    if not 1 <= len(poses) <= MOST_MOMENTS:
        raise InputError(f"{len(poses)} moments, expected 1 to {MOST_MOMENTS}", path)
    places, turns = forward(skeleton, poses[..., :3], poses[..., 3:].reshape(*poses.shape[:2], -1, 4))
    camera = Camera(_beside(places), _PITCH)
    columns = min(columns, len(poses))
    rows = math.ceil(len(poses) / columns)
    plt = drawing.pyplot()
    size = columns * _WIDTH * _PIXELS_PER_METRE / 100, rows * _HEIGHT * _PIXELS_PER_METRE / 100
    figure = plt.figure(figsize=size, facecolor=drawing.PAPER)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, columns * _WIDTH), ylim=(-rows * _HEIGHT, 0))
    axes.axis("off")
    canvas = Canvas()
    parts = body_parts(skeleton)
    for index in range(len(poses)):
        row, column = divmod(index, columns)
        origin = (column + 0.5) * _WIDTH, _GROUND - (row + 1) * _HEIGHT
        _add_moment(canvas, parts, places[index], turns[index], camera, origin)
        _caption(axes, captions[index], origin)
    canvas.paint(axes)
    return drawing.save(figure, path)


def _beside(places: NDArray) -> float:
    """Where to look so that the fighters of the middle moment stand left and right.  # (F, 2, J, 3)"""
    one, other = places[len(places) // 2, :, 0]
    return math.atan2(other[0] - one[0], other[2] - one[2]) + 0.5 * math.pi


def _add_moment(
    canvas: Canvas, parts: list[Part], places: NDArray, turns: NDArray, camera: Camera, origin: tuple[float, float]
) -> None:
    """Both fighters about the middle between them, the further one first.  # places (2, J, 3), turns (2, J, 4)"""
    middle = places[:, 0].mean(axis=0) * [1.0, 0.0, 1.0]
    places = places - middle
    for who in range(2):
        drawing.add_shadow(
            canvas, parts, places[who], turns[who], camera, grow=0.02, colour=drawing.GROUND, shift=origin
        )
    depth = camera.project(places[:, 0])[1]
    for who in np.argsort(-depth):
        painted = parts if who == 0 else [_paler(part) for part in parts]
        drawing.add_figure(canvas, painted, places[who], turns[who], camera, shift=origin, fade=0.35 * who)


def _paler(part: Part) -> Part:
    """A part of the second fighter: left and right change colours, so that the two are told apart."""
    return replace(part, paint=_OTHERS_PAINT.get(part.paint, TRUNK))


def _caption(axes: Any, text: str, origin: tuple[float, float]) -> None:
    axes.text(origin[0], origin[1] - 0.2, text, color=drawing.INK, fontsize=6, ha="center", va="center")
