"""Finds the strikes in the attacks of a state-annotated graph.

Convention: a limb strikes where it moves away from the hips over the ground at 2 m/s at least, ahead of the body, and
comes to its furthest 0.4 m out and half a metre high at least: a foot that steps stays low, a hand that is pulled back
stays near. Contact is the frame of that reach, speed the greatest in the 0.2 s before it. Within 0.3 s only the fastest
counts.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from footwork.motion.annotation import Annotation
from footwork.motion.fighting_points import LIMBS, points_of
from footwork.motion.graph import MotionGraph
from footwork.motion.stretch_places import natural_steps, stretch_places
from footwork.motion.strikes import Strikes
from footwork.motion.tick import TICK_RATE

OUTWARD = 2.0  # m/s
FURTHEST, HIGH = 0.4, 0.5  # metres: least reach and height at contact
APART = 9  # frames
BEFORE = 6  # frames in which the speed is sought


@dataclass(frozen=True)
class _Found:
    node: int
    limb: int
    speed: float


def detected_strikes(graph: MotionGraph, annotation: Annotation, state: int) -> Strikes:
    """The strikes in all stretches of a state, by its number.

    Raises:
        InputError: for a body without hands, feet or head.
    """
    points = points_of(graph)[:, : len(LIMBS)]
    follows, places = natural_steps(graph)[0], stretch_places(graph)
    own = annotation.state[annotation.segment] == state
    found: list[_Found] = []
    for first, end in _stretches(own, follows):
        found += _strikes_in(points[first:end], places[first:end], first)
    found.sort(key=lambda strike: strike.node)
    return Strikes(
        np.array([one.node for one in found], dtype=np.int32),
        np.array([one.limb for one in found], dtype=np.int16),
        np.array([one.speed for one in found], dtype=np.float32),
    )


def speeds_at(graph: MotionGraph, nodes: NDArray, limbs: NDArray) -> NDArray[np.float32]:
    """The greatest speed of a limb in the time before each of some nodes, m/s.  # (S,), (S,) -> (S,)"""
    follows, places = natural_steps(graph)[0], stretch_places(graph)
    points = points_of(graph)[:, : len(LIMBS)]

    def speed(node: int, limb: int) -> float:
        first = node
        while first > max(0, node - BEFORE) and follows[first]:
            first -= 1
        way = slice(first, node + 1)
        return float(_speed(points[way], places[way])[:, limb].max()) if first < node else 0.0

    return np.array([speed(int(node), int(limb)) for node, limb in zip(nodes, limbs, strict=True)], dtype=np.float32)


def _stretches(own: NDArray[np.bool_], follows: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First nodes and ends of what the capture has in one piece of the nodes meant."""
    joined = own[1:] & own[:-1] & follows[1:]
    cuts = np.flatnonzero(np.concatenate([[True], ~joined, [True]]))
    return [(int(first), int(end)) for first, end in pairwise(cuts) if own[first]]


def _strikes_in(points: NDArray, places: NDArray, first: int) -> list[_Found]:
    """Of one stretch: limbs (F, 4, 3) in the nodes' planar frames, and those frames' places (F, 3)."""
    if len(points) < 3:
        return []
    reach = np.hypot(points[..., 0], points[..., 2])
    outward, speed = np.gradient(reach, axis=0) * TICK_RATE, _speed(points, places)
    found = [
        _Found(first + contact, limb, float(speed[max(0, contact - BEFORE) : contact + 1, limb].max()))
        for limb in range(points.shape[1])
        for contact in _contacts(reach[:, limb], outward[:, limb])
        if _strikes(points[contact, limb])
    ]
    return _apart(found)


def _contacts(reach: NDArray, outward: NDArray) -> set[int]:
    """Frames of furthest reach after each time that a limb moved out quickly.  # (F,), (F,)"""
    contacts = set()
    for frame in np.flatnonzero(outward >= OUTWARD).tolist():
        while frame + 1 < len(reach) and reach[frame + 1] > reach[frame]:
            frame += 1
        if frame + 1 < len(reach):
            contacts.add(frame)
    return contacts


def _strikes(point: NDArray) -> bool:
    """Whether a limb that is furthest out there may hit somebody."""
    return bool(point[2] > 0.0 and point[1] >= HIGH and np.hypot(point[0], point[2]) >= FURTHEST)


def _speed(points: NDArray, places: NDArray) -> NDArray[np.float64]:
    """Speeds of points over the ground, m/s.  # (F, 4)"""
    sine, cosine = np.sin(places[:, None, 2]), np.cos(places[:, None, 2])
    x = places[:, None, 0] + points[..., 0] * cosine + points[..., 2] * sine
    z = places[:, None, 1] - points[..., 0] * sine + points[..., 2] * cosine
    world = np.stack([x, points[..., 1], z], axis=-1)
    return np.linalg.norm(np.gradient(world, axis=0), axis=-1) * TICK_RATE


def _apart(found: list[_Found]) -> list[_Found]:
    """The fastest, then the fastest of those that are not near it, and so on."""
    kept: list[_Found] = []
    for strike in sorted(found, key=lambda one: (-one.speed, one.node, one.limb)):
        if all(abs(strike.node - other.node) > APART for other in kept):
            kept.append(strike)
    return kept
