"""Ticks of characters that a policy table steers, any number of them in one compiled call.

What is done is what ``chosen_ticks`` does one Python call after the other, to the same bytes.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.orders import Orders, ask, put_in_force
from footwork.controllers.steering import SteeringController
from footwork.controllers.steering_kernels import steer
from footwork.motion.kept import Kept, keep
from footwork.motion.moves import no_moves
from footwork.runtime.schedule import Schedule
from footwork.runtime.ticking import advance, show_characters
from footwork.runtime.world import World


@numba.njit(cache=True, nogil=True)
def make_ticks(slots: NDArray, schedule: Schedule, poses: NDArray, kept: Kept) -> int:
    """Take characters through T ticks and write their poses at F moments of each.

    Returns -1, or the first character whose move cannot be made: ticks end before that one.

    Args:
        slots: rows of the characters.  # (n,)
        schedule: commands to them.
        poses: written: place of joint 0, then local rotations joint by joint.  # (T, F, n, 3 + 4 J) float32
        kept: what the world keeps of characters, motion and smoothing; the graph's behaviour by node, the Policy,
            SteeringController.memory, the commands InForce, and room to work in: the arrays of Moves, a row for each
            slot.
    """
    characters, motion, smoothing, behaviour, policy, held, in_force, moves = kept.parts
    edge, target, displacement, adjustment, natural = moves
    node, place, heading = characters.node, characters.place, in_force.heading
    asked, asked_speed = in_force.asked, in_force.asked_speed
    count, frames, joints = slots.shape[0], poses.shape[1], (poses.shape[3] - 3) // 4
    room = node.shape[0] if frames else 0
    root, rotations = np.empty((room, 3), np.float32), np.empty((room, joints, 4), np.float32)
    come = 0
    for tick in range(poses.shape[0]):
        while come < schedule.shape[0] and schedule[come, 0] <= tick:
            _, who, ahead, lasting, once, pace = schedule[come]
            whose = int(who)
            put_in_force(whose, ahead, int(lasting), int(once), pace, int(behaviour[node[whose]]), in_force)
            come += 1
        ask(slots, behaviour[node[slots]], in_force)
        steer(
            policy,
            slots,
            node[slots],
            place[slots],
            heading[slots],
            asked[slots],
            asked_speed[slots],
            held,
            edge[:count],
            target[:count],
            displacement[:count],
            adjustment[:count],
            natural[:count],
        )
        _put_in_slots(slots, edge, target, displacement, adjustment, natural)
        wrong = advance(slots, edge, target, displacement, adjustment, natural, characters, motion, smoothing)
        if wrong >= 0:
            return wrong
        for frame in range(frames):
            show_characters(slots, (frame + 1) / frames, characters, motion, smoothing, root, rotations)
            _copy_shown(slots, root, rotations, poses[tick, frame])
    return -1


@numba.njit(cache=True, nogil=True)
def _put_in_slots(slots, edge, target, displacement, adjustment, natural):
    """Take moves from the first rows to the rows of their slots: from the last on, as slots rise."""
    for row in range(slots.shape[0] - 1, -1, -1):
        who = slots[row]
        edge[who], target[who], natural[who] = edge[row], target[row], natural[row]
        for k in range(3):
            displacement[who, k], adjustment[who, k] = displacement[row, k], adjustment[row, k]


@numba.njit(cache=True, nogil=True)
def _copy_shown(slots, root, rotations, poses):
    for row in range(slots.shape[0]):
        who, shown = slots[row], poses[row]
        for k in range(3):
            shown[k] = root[who, k]
        for joint in range(rotations.shape[1]):
            for k in range(4):
                shown[3 + 4 * joint + k] = rotations[who, joint, k]


class SteeredTicks:
    """Makes the ticks of a world whose characters a policy table steers.

    Args:
        controller: the table.
        world: where the characters are.
        orders: what they are asked for.
    """

    def __init__(self, controller: SteeringController, world: World, orders: Orders) -> None:
        (held,) = controller.memory(world.capacity)
        self._world, self._moves = world, no_moves(world.capacity)
        moves = self._moves
        room = moves.edge, moves.target, moves.displacement, moves.adjustment, moves.natural
        on = world.characters, world.motion, world.smoothing
        self._kept = keep((*on, world.graph.behaviour, controller.policy, held, orders.in_force, room))

    def make(self, slots: NDArray[np.intp], schedule: Schedule, poses: NDArray[np.float32]) -> None:
        """Take the characters of some slots, in rising order, through the ticks of ``poses``; see ``make_ticks``.

        Raises:
            WrongMove: where the table's move cannot be made in this world: the ticks before it have been made.
        """
        if not len(slots):
            return
        wrong = make_ticks(slots, schedule, poses, self._kept)
        if wrong >= 0:
            self._world.raise_wrong_move(wrong, self._moves)
