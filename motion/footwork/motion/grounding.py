"""Feet on the floor y = 0: those that press through it are laid upon it. Source: convention.

Heights here are above rest: zero for an ankle or ball at the height it has while the common body stands.
"""

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT, FEET
from footwork.motion.skeleton import Skeleton

_ANKLES, _BALLS = FEET[:, 0], FEET[:, 1]
# Captured ankles sink a little as the heel lands; deeper than this they are raised.
_DEEPEST_ANKLE = 0.01  # metres
# A sunken ball is tilted up while its ankle is near the floor, raised with its ankle when that is higher.
_TILTED, _RAISED = 0.03, 0.07  # metres, ankle's height above rest
_TIP_HEIGHT = 0.01  # metres above the floor: the tips of the toes come no lower
_SOFTLY = 0.003  # metres over which a height begins to be held, so that nothing jerks
_STEEP = 0.5  # cosine of the pitch from which a foot's heading counts less and less


def ball_places(body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where the balls are that belong to the ankles' places and rotations.  # (F, feet, 3)"""
    return places[:, _ANKLES] + quaternion.rotate(turns[:, _ANKLES], body.offsets[_BALLS])


def heights_above_rest(
    body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Heights of ankles and balls above their rest on the floor, metres.  # (F, feet) each"""
    ankles = places[:, _ANKLES, 1] - (BALL_HEIGHT - body.offsets[_BALLS, 1])
    return ankles, ball_places(body, places, turns)[..., 1] - BALL_HEIGHT


def lay_feet(
    body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Ankle places (F, feet, 3) and all rotations (F, J, 4) with feet and toes above the floor y = 0.

    Feet that are above it keep their rotation. Marker sets bend feet by some degrees as they press into the
    ground: a foot with its ankle near the floor is tilted flat, which leaves the knee alone; one that rolls over
    its toes is raised. Balls stay above the same spot of the floor throughout, so that planted feet stay planted.
    """
    ankles, balls = heights_above_rest(body, places, turns)
    raise_by = _held(ankles, -_DEEPEST_ANKLE) - ankles
    sunk = _held(balls + raise_by, -_SOFTLY) - (balls + raise_by)
    tilt = _ease((_RAISED - ankles) / (_RAISED - _TILTED))
    laid = turns.copy()
    laid[:, _ANKLES] = _tilted(turns[:, _ANKLES], body.offsets[_BALLS], tilt * sunk)
    ankle_places = _behind_balls(body, places, turns, laid)
    ankle_places[..., 1] += raise_by + (1.0 - tilt) * sunk
    _lay_toes(body, places, ankle_places, turns, laid)
    return ankle_places, laid


def _behind_balls(
    body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64], laid: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The captured ankles moved level so that the body's balls are above the captured ones.  # (F, feet, 3)

    Where the body's feet are longer or shorter the balls are ahead or behind by the difference in length, along
    the foot's heading: flat feet keep their ankles, and a foot that rolls over its ball does not push it away.
    """
    captured = quaternion.rotate(quaternion.conjugate(turns[:, _ANKLES]), places[:, _BALLS] - places[:, _ANKLES])
    shorter = captured[..., 2].mean(axis=0) - body.offsets[_BALLS, 2]
    heading = quaternion.rotate(laid[:, _ANKLES], [0.0, 0.0, 1.0])[..., [0, 2]]
    heading /= np.maximum(np.linalg.norm(heading, axis=-1, keepdims=True), _STEEP)
    bones = quaternion.rotate(laid[:, _ANKLES], body.offsets[_BALLS])[..., [0, 2]]
    ankles = places[:, _ANKLES].copy()
    ankles[..., [0, 2]] = places[:, _BALLS][..., [0, 2]] - shorter[:, None] * heading - bones
    return ankles


def _lay_toes(
    body: Skeleton,
    places: NDArray[np.float64],
    ankles: NDArray[np.float64],
    turns: NDArray[np.float64],
    laid: NDArray[np.float64],
) -> None:
    """Turn the toes in ``laid`` so that their tips keep their height while the balls rise, or lie on the floor."""
    toes = quaternion.rotate(turns[:, _BALLS], body.ends[_BALLS])[..., 1]
    before = ball_places(body, places, turns)[..., 1] + toes
    after = ankles[..., 1] + quaternion.rotate(laid[:, _ANKLES], body.offsets[_BALLS])[..., 1] + toes
    laid[:, _BALLS] = _tilted(turns[:, _BALLS], body.ends[_BALLS], _held(before, _TIP_HEIGHT) - after)


def _held(heights: NDArray[np.float64], lowest: float) -> NDArray[np.float64]:
    """The larger of the two without a corner, too large by half of ``_SOFTLY`` at most."""
    over = heights - lowest
    return lowest + 0.5 * (over + np.sqrt(over**2 + _SOFTLY**2))


def _ease(share: NDArray[np.float64]) -> NDArray[np.float64]:
    """0 to 1 with level ends, as ``share`` goes from 0 to 1."""
    share = np.clip(share, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def _tilted(turns: NDArray[np.float64], bone: NDArray[np.float64], rise: NDArray[np.float64]) -> NDArray[np.float64]:
    """``turns`` (F, feet, 4) with the tip of ``bone`` (feet, 3) higher by ``rise`` (F, feet), its heading kept."""
    present = quaternion.rotate(turns, bone)
    length = np.linalg.norm(bone, axis=-1)
    level = np.linalg.norm(present[..., [0, 2]], axis=-1)
    pitch = np.arcsin(np.clip((present[..., 1] + rise) / length, -1.0, 1.0)) - np.arctan2(present[..., 1], level)
    side = np.stack([-present[..., 2], np.zeros_like(level), present[..., 0]], axis=-1)
    axis = side / np.maximum(level, 1e-9)[..., None]
    return quaternion.multiply(quaternion.from_rotation_vector(pitch[..., None] * axis), turns)
