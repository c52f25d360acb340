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
from footwork.training.blend_kernels import blend, centres_of_mass, localise, place_joints
from footwork.training.centre_of_mass import mass_shares, segment_centres
from footwork.training.leg_kernel import reach_feet
from footwork.training.source_tracks import Tracks

KNEE_BEND = np.array([0.0, 0.0, 1.0])  # in the thigh's frame: knees bend forward


class Figure(NamedTuple):
    """What the kernels read of a body of J joints."""

    parents: NDArray[np.int32]  # (J,)
    offsets: NDArray[np.float64]  # (J, 3) metres
    centres: NDArray[np.float64]  # (J, 3) of the segments, in their joints' frames
    shares: NDArray[np.float64]  # (J,) of the segments in the body's mass
    joints: NDArray[np.intp]  # (J,) all of them
    legs: NDArray[np.intp]  # (feet, 3) hip, knee and ankle
    below: NDArray[np.intp]  # hips and all that hangs on them, parents first
    balls: NDArray[np.intp]  # (feet,)


def figure_of(body: Skeleton) -> Figure:
    """The figure of a body.

    Raises:
        InputError: for a body without masses.
    """
    ankles, balls = body.feet.T.astype(np.intp)
    knees = body.parents[ankles]
    legs = np.stack([body.parents[knees], knees, ankles], axis=1).astype(np.intp)
    joints = np.arange(body.joint_count)
    below = np.isin(joints, legs[:, 0])
    for joint in joints[1:]:
        below[joint] |= below[body.parents[joint]]
    centres, shares = segment_centres(body), mass_shares(body)
    return Figure(body.parents, body.offsets, centres, shares, joints, legs, np.flatnonzero(below), balls)


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
    centre: NDArray[np.float64]  # (R, 3) where the centre of mass should be (in flight it is there), metres
    missed: NDArray[np.float64]  # (R, feet) how far each ball is from where it should be, metres


def blended_poses(figure: Figure, tracks: Tracks, rows: Blend) -> BlendedPoses:
    """The poses of rows; each depends on its own row alone."""
    count, joints = len(rows.chain), len(figure.joints)
    turns, points = np.empty((count, *tracks.turns.shape[1:])), np.empty((count, *tracks.points.shape[1:]))
    blend(tracks.turns, tracks.points, rows.chain, rows.position, rows.bounds, rows.weight, rows.move, turns, points)
    local, feet, balls = turns[:, :joints], turns[:, joints:], points[:, 1:]
    places, world = np.empty((count, joints, 3)), np.empty((count, joints, 4))
    place_joints(figure.joints, figure.parents, figure.offsets, local, places, world)
    root = points[:, 0] - _centre(figure, places, world)
    ankles = balls - quaternion.rotate(feet, figure.offsets[figure.balls]) - root[:, None]
    _put_feet(figure, ankles, feet, local, places, world)
    missed = np.linalg.norm(places[:, figure.balls] + root[:, None] - balls, axis=-1)
    flying = np.flatnonzero(rows.airborne[rows.chain])
    root[flying] = points[flying, 0] - _centre(figure, places[flying], world[flying])
    places += root[:, None]
    return BlendedPoses(root, local, places, points[:, 0], missed)


def _put_feet(figure: Figure, ankles: NDArray, feet: NDArray, local: NDArray, places: NDArray, world: NDArray) -> None:
    """Change legs so that ankles and feet have these places and rotations; what hangs on a foot goes with it."""
    reach_feet(figure.legs, KNEE_BEND, places, world, ankles)
    world[:, figure.legs[:, 2]] = feet
    localise(figure.legs.ravel(), figure.parents, world, local)
    place_joints(figure.below, figure.parents, figure.offsets, local, places, world)


def _centre(figure: Figure, places: NDArray, world: NDArray) -> NDArray[np.float64]:
    """Centre of mass of poses.  # (R, 3)"""
    centre = np.empty((len(places), 3))
    centres_of_mass(figure.centres, figure.shares, places, world, centre)
    return centre
