"""A made-up jump of the common body whose centre of mass falls exactly as it should."""

import numpy as np

from footwork.motion import quaternion
from footwork.motion.body import default_body, rest_height
from footwork.motion.clip import Clip
from footwork.motion.kinematics import forward
from footwork.training.centre_of_mass import centre_of_mass
from footwork.training.segments import GRAVITY


def jump_clip(
    flight: int = 12, gravity: float = GRAVITY, speed: float = 1.0, turn: float = 0.0, name: str = "jump"
) -> Clip:
    """Ten frames on both feet, ``flight`` frames in the air while all joints swing, ten on both feet again.

    It falls all the time, so that its flight begins and ends smoothly; its feet carry it in name alone.

    Args:
        flight: frames in the air.
        gravity: with which the centre of mass falls, m/s^2.
        speed: forwards in the air, m/s.
        turn: yaw over the flight, radians.
        name: of the clip.
    """
    body = default_body()
    frames = flight + 20
    step = np.arange(frames) - 10
    air = (step >= 0) & (step < flight)
    share = np.clip((step + 0.5) / flight, 0.0, 1.0)
    rng = np.random.default_rng(flight)
    swing = rng.normal(0.0, 0.3, (body.joint_count, 3))
    rotations = quaternion.from_rotation_vector(np.sin(np.pi * share)[:, None, None] * swing)
    rotations[:, 0] = quaternion.multiply(quaternion.from_yaw(turn * share), rotations[:, 0])
    time = (step + 0.5) / 30.0
    centre = np.zeros((frames, 3))
    centre[:, 2] = speed * time
    centre[:, 1] = 0.5 * gravity * time * (flight / 30.0 - time)
    places, turns = forward(body, np.zeros((frames, 3)), rotations)
    standing = rest_height(body) + centre_of_mass(body, places[0], turns[0])[1]
    root = centre + np.array([0.0, standing, 0.0]) - centre_of_mass(body, places, turns)
    contacts = np.repeat(~air[:, None], 2, axis=1)
    return Clip(name, body, 30.0, root, rotations, contacts=contacts, labels=np.full(frames, "jump"))
