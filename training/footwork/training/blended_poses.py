"""Poses between two segments: the centre of mass and the feet where the mix of both sources has them.

After Safonova and Hodgins (2005); what they leave open is convention. Joint angles are mixed by slerp, the centre of
mass linearly. Each foot's own pose in the world, ball and rotation, is mixed too, and its leg reaches for it
(two-bone inverse kinematics): between two feet that stand still a foot stands still, between two that roll it rolls,
and nothing jumps where a foot is set down. In flight the body is then moved so that its centre of mass falls freely.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.skeleton import Skeleton
from footwork.training.blend_kernels import blend, centres_of_mass, place_joints
from footwork.training.centre_of_mass import mass_shares, segment_centres
from footwork.training.leg_kernel import reach_feet
from footwork.training.source_tracks import Tracks

KNEE_BEND = np.array([0.0, 0.0, 1.0])  # in the thigh's frame: knees bend forward


class Blend(NamedTuple):
    """What R rows of some chains are mixed of; C of the chains."""

    chain: NDArray[np.intp]  # (R,) which chain a row belongs to
    position: NDArray[np.float64]  # (R, 2) where it is on the tracks of its sources, frames
    bounds: NDArray[np.intp]  # (C, 4) first and last frame of the clips of the first and of the second source
    weight: NDArray[np.float64]  # (C,) share of the first source
    move: NDArray[np.float64]  # (C, 3) yaw, x, z that align the second source to the first
    airborne: NDArray[np.bool_]  # (C,) whether it is a flight


class BlendedPoses(NamedTuple):
    """R poses."""

    root_position: NDArray[np.float64]  # (R, 3) metres
    rotations: NDArray[np.float64]  # (R, J, 4) local, joint 0 in the world
    places: NDArray[np.float64]  # (R, J, 3) world places of the joints, metres
    centre: NDArray[np.float64]  # (R, 3) centre of mass, metres
    missed: NDArray[np.float64]  # (R, feet) how far each ball is from where it should be, metres


def blended_poses(body: Skeleton, tracks: Tracks, rows: Blend) -> BlendedPoses:
    """The poses of rows; each depends on its own row alone."""
    joints = body.joint_count
    turns = np.empty((len(rows.chain), *tracks.turns.shape[1:]))
    points = np.empty((len(rows.chain), *tracks.points.shape[1:]))
    blend(tracks.turns, tracks.points, rows.chain, rows.position, rows.bounds, rows.weight, rows.move, turns, points)
    local, feet, balls = turns[:, :joints], turns[:, joints:], points[:, 1:]
    places, world = np.empty((len(local), joints, 3)), np.empty((len(local), joints, 4))
    place_joints(np.arange(joints), body.parents, body.offsets, local, places, world)
    root = points[:, 0] - _centre(body, places, world)
    ankles = balls - quaternion.rotate(feet, body.offsets[body.feet[:, 1]]) - root[:, None]
    _put_feet(body, ankles, feet, local, places, world)
    missed = np.linalg.norm(places[:, body.feet[:, 1]] + root[:, None] - balls, axis=-1)
    centre = root + _centre(body, places, world)
    fall = np.where(rows.airborne[rows.chain, None], points[:, 0] - centre, 0.0)
    places += (root + fall)[:, None]
    return BlendedPoses(root + fall, local, places, centre + fall, missed)


def _put_feet(body: Skeleton, ankles: NDArray, feet: NDArray, local: NDArray, places: NDArray, world: NDArray) -> None:
    """Change legs so that ankles and feet have these places and rotations; what hangs on a foot goes with it."""
    knees = body.parents[body.feet[:, 0]]
    legs = np.stack([body.parents[knees], knees, body.feet[:, 0]], axis=1)
    reach_feet(legs, KNEE_BEND, places, world, ankles)
    world[:, body.feet[:, 0]] = feet
    moved = legs.ravel()
    local[:, moved] = quaternion.multiply(quaternion.conjugate(world[:, body.parents[moved]]), world[:, moved])
    place_joints(_below(body, legs[:, 0]), body.parents, body.offsets, local, places, world)


def _below(body: Skeleton, roots: NDArray) -> NDArray[np.intp]:
    """Some joints and all that hang on them, parents first."""
    below = np.isin(np.arange(body.joint_count), roots)
    for joint in range(1, body.joint_count):
        below[joint] |= below[body.parents[joint]]
    return np.flatnonzero(below)


def _centre(body: Skeleton, places: NDArray, world: NDArray) -> NDArray[np.float64]:
    """Centre of mass of poses.  # (R, 3)"""
    centre = np.empty((len(places), 3))
    centres_of_mass(segment_centres(body), mass_shares(body), places, world, centre)
    return centre
