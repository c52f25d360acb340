"""The kernels of a tick: characters are moved along their edges, and shown."""

import numba
from numpy.typing import NDArray

from footwork.motion.kept import Kept
from footwork.motion.tick import TICK
from footwork.runtime.characters import Characters, Motion, Smoothing
from footwork.runtime.foot_lock import update_locks
from footwork.runtime.held_feet import hold_feet
from footwork.runtime.inertialisation import decay, take_jumps
from footwork.runtime.moving import first_wrong_move, make_moves
from footwork.runtime.posing import pose


@numba.njit(cache=True, nogil=True)
def advance(
    slots: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
    characters: Characters,
    motion: Motion,
    smoothing: Smoothing,
) -> int:
    """Take characters through one tick, in place; -1, or the first whose move cannot be made: nobody has moved then.

    Args:
        slots: rows of the characters, of the moves and of what is remembered.  # (n,)
        edge: of the moves, and so are target, displacement, adjustment and natural.  # (C,)
        characters: what is remembered of them.
        motion: what they move on.
        smoothing: how they are shown.
    """
    # to compiled code, each look into a tuple of arrays counts references: it is done once
    node, place, taken, as_captured, glide, ticks_left, offsets, roots, locked, anchor, slip, stride = characters
    edge_start, graph_target, contacts, root_position, root_velocity, nodes, legs, bones, _, floor = motion
    halflife = smoothing.halflife
    wrong = first_wrong_move(slots, node, edge, target, displacement, adjustment, edge_start, graph_target)
    if wrong >= 0:
        return wrong
    if smoothing.foot_lock:
        update_locks(
            slots,
            node,
            target,
            place,
            contacts,
            halflife,
            root_position,
            nodes,
            offsets,
            roots,
            legs,
            bones,
            floor,
            locked,
            anchor,
            slip,
            stride,
        )
    old_node, old_place = node[slots], place[slots]
    make_moves(slots, target, displacement, adjustment, node, place, glide)
    for who in slots:
        taken[who], as_captured[who] = edge[who], natural[who]
    if smoothing.inertialise:
        decay(slots, ticks_left, offsets, roots, TICK, halflife)
        take_jumps(
            slots,
            smoothing.settle_ticks,
            ticks_left,
            natural,
            old_node,
            old_place,
            node,
            place,
            glide,
            root_position,
            root_velocity,
            nodes,
            offsets,
            roots,
        )
    return -1


@numba.njit(cache=True, nogil=True)
def show_characters(
    slots: NDArray,
    fraction: float,
    characters: Characters,
    motion: Motion,
    smoothing: Smoothing,
    shown_root: NDArray,
    shown_rotations: NDArray,
) -> None:
    """Write the poses of characters at a fraction of the tick into their rows of the last two arrays.

    Args:
        slots: which.  # (n,)
        fraction: how much of the tick has passed, above 0 and at most 1.
        characters: what is remembered of them.
        motion: what they move on.
        smoothing: how they are shown.
        shown_root: joint 0 in the world, m.  # (C, 3) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (C, J, 4) float32
    """
    node, place, _, _, glide, _, offsets, roots, locked, anchor, slip, stride = characters
    _, _, _, root_position, root_velocity, nodes, legs, bones, spans, floor = motion
    pose(
        slots,
        node,
        place,
        glide,
        fraction,
        smoothing.halflife,
        root_position,
        root_velocity,
        nodes,
        offsets,
        roots,
        shown_root,
        shown_rotations,
    )
    if smoothing.foot_lock:
        hold_feet(
            slots,
            fraction,
            legs,
            bones,
            spans,
            floor,
            locked,
            anchor,
            slip,
            stride,
            shown_root,
            shown_rotations,
        )


@numba.njit(cache=True, nogil=True)
def advance_kept(
    slots: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
    kept: Kept,
) -> int:
    """``advance`` of what a world keeps: see ``show_kept``."""
    characters, motion, smoothing, _, _ = kept.parts
    return advance(slots, edge, target, displacement, adjustment, natural, characters, motion, smoothing)


@numba.njit(cache=True, nogil=True)
def show_kept(slots: NDArray, fraction: float, kept: Kept) -> None:
    """``show_characters`` of what a world keeps: characters, motion, smoothing and what is shown of all slots."""
    characters, motion, smoothing, shown_root, shown_rotations = kept.parts
    show_characters(slots, fraction, characters, motion, smoothing, shown_root, shown_rotations)
