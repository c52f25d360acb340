"""A character in a window: python examples/raylib_client.py [ADDRESS [PICTURES]]

Start a server first: footwork serve BUNDLE. Needs `pip install raylib`. W A S D to go, shift to run, space to jump;
the arrow keys or the mouse turn the camera. With PICTURES it walks by itself and saves one a second, walk1.png first.
"""

import math
import sys
import time

import numpy as np
import pyray as rl
from pyray import KeyboardKey as Key

from footwork.motion.kinematics import forward
from footwork.motion.quaternion import rotate
from footwork.motion.skeleton import Skeleton
from footwork.protocol.client import DEFAULT_ADDRESS, Client
from footwork.protocol.messages import Keys, Pose
from footwork.protocol.pose_arrays import root_of, rotations_of

PATIENCE = 60.0  # seconds; a server's first start on a machine compiles before it answers
THICK, DISTANCE, HEIGHT, FIELD = 0.05, 4.0, 1.6, 30  # metres
LEFT, RIGHT = rl.Color(92, 143, 204, 255), rl.Color(46, 72, 110, 255)
PERSPECTIVE = rl.CameraProjection.CAMERA_PERSPECTIVE
FLOOR, SKY = rl.Color(150, 154, 150, 255), rl.Color(226, 230, 234, 255)


def held(view_yaw: float, walking: bool) -> Keys:
    """What the player's keys ask for."""
    down = rl.is_key_down
    ahead = int(walking or down(Key.KEY_W)) - int(down(Key.KEY_S))
    strafe = int(down(Key.KEY_D)) - int(down(Key.KEY_A))
    run, jump = down(Key.KEY_LEFT_SHIFT), down(Key.KEY_SPACE)
    return Keys(view_yaw=view_yaw, forward=ahead, strafe=strafe, run=run, jump=jump)


def turned(view_yaw: float) -> float:
    """The camera's yaw after the arrow keys and the mouse; positive turns left."""
    keys = int(rl.is_key_down(Key.KEY_LEFT)) - int(rl.is_key_down(Key.KEY_RIGHT))
    yaw = view_yaw + 2.0 * keys * rl.get_frame_time() - 0.004 * rl.get_mouse_delta().x
    return math.remainder(yaw, 2.0 * math.pi)


def latest(client: Client, pose: Pose | None) -> Pose | None:
    """The newest pose that came, the one before where none did."""
    while (message := client.listen(0.0)) is not None:
        pose = message if isinstance(message, Pose) else pose
    return pose


def draw(body: Skeleton, pose: Pose, view_yaw: float) -> None:
    places, turns = forward(body, root_of(pose), rotations_of(pose))
    tips = places + rotate(turns, body.ends)
    x, z = float(places[0, 0]), float(places[0, 2])
    behind = rl.Vector3(x - DISTANCE * math.sin(view_yaw), HEIGHT, z - DISTANCE * math.cos(view_yaw))
    rl.begin_mode_3d(rl.Camera3D(behind, rl.Vector3(x, 0.9, z), rl.Vector3(0, 1, 0), 50.0, PERSPECTIVE))
    rl.draw_plane(rl.Vector3(x, 0, z), rl.Vector2(2 * FIELD, 2 * FIELD), FLOOR)
    for step in range(-FIELD, FIELD + 1):
        east, north = round(x) + step, round(z) + step
        rl.draw_line_3d(rl.Vector3(east, 0.002, z - FIELD), rl.Vector3(east, 0.002, z + FIELD), SKY)
        rl.draw_line_3d(rl.Vector3(x - FIELD, 0.002, north), rl.Vector3(x + FIELD, 0.002, north), SKY)
    for joint, parent in enumerate(body.parents):
        if parent >= 0:
            colour = RIGHT if "right" in body.names[joint] else LEFT
            rl.draw_capsule(rl.Vector3(*places[parent]), rl.Vector3(*places[joint]), THICK, 8, 4, colour)
            rl.draw_capsule(rl.Vector3(*places[joint]), rl.Vector3(*tips[joint]), THICK, 8, 4, colour)
    rl.end_mode_3d()


def main(address: str = DEFAULT_ADDRESS, pictures: str = "0") -> None:
    rl.set_trace_log_level(rl.TraceLogLevel.LOG_WARNING)
    rl.init_window(960, 640, "footwork")
    rl.set_target_fps(60)
    with Client(address, name="raylib_client.py", timeout=PATIENCE) as client:
        told = client.welcome
        body = Skeleton(told.joints, np.array(told.parents), np.array(told.offsets), np.array(told.ends))
        client.spawn(0)
        pose, view_yaw, sent, taken, start = None, 0.0, None, 0, time.monotonic()
        while not rl.window_should_close() and (pictures == "0" or taken < int(pictures)):
            view_yaw = turned(view_yaw)
            if (keys := held(view_yaw, pictures != "0")) != sent:
                client.keys(0, keys)
                sent = keys
            pose = latest(client, pose)
            rl.begin_drawing()
            rl.clear_background(SKY)
            if pose is not None:
                draw(body, pose, view_yaw)
            rl.end_drawing()
            if pictures != "0" and time.monotonic() - start > taken + 1:
                taken += 1
                rl.take_screenshot(f"walk{taken}.png")
    rl.close_window()


if __name__ == "__main__":
    main(*sys.argv[1:])
