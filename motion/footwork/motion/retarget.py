"""Mapping capture onto the common body: one body for all people, moved as each of them moved.

Every bone points where the captured one points, limbs keep their twist and bending plane, and the ankles stand
where the captured ankles stand, all lengths scaled by the legs' and the floor brought to y = 0. Source: convention.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import NAMES, PARENTS, default_body
from footwork.motion.clip import Clip
from footwork.motion.contacts import detect_contacts
from footwork.motion.floor_plane import Floor, floors_under, footing_of
from footwork.motion.grounding import lay_feet
from footwork.motion.ik import leg, reach
from footwork.motion.kinematics import forward, local_rotations
from footwork.motion.name_table import NameTable, table_for
from footwork.motion.skeleton import Skeleton
from footwork.motion.source_pose import source_pose

_SIDES = ("left", "right")
# The joint to which each bone points. Hips, feet, toes, hands and head are turned by their rotation alone.
_AIMS = {"spine": "chest", "chest": "neck", "neck": "head"} | {
    f"{side}_{bone}": f"{side}_{tip}"
    for side in _SIDES
    for bone, tip in (
        ("clavicle", "upper_arm"),
        ("upper_arm", "forearm"),
        ("forearm", "hand"),
        ("thigh", "shank"),
        ("shank", "foot"),
    )
}
_AIMED = {NAMES.index(bone): NAMES.index(tip) for bone, tip in _AIMS.items()}
_THIGHS, _SHANKS, _ANKLES = (
    np.array([NAMES.index(f"{side}_{part}") for side in _SIDES]) for part in ("thigh", "shank", "foot")
)
_SPINE, _CHEST = NAMES.index("spine"), NAMES.index("chest")
_ROUNDING = 1e-5  # metres by which offsets that were written and read again differ
_LEVEL = 0.02  # metres by which a floor that was found before is found elsewhere
_SHORTEST = 1e-6  # of the unit of the capture: below it a bone has no direction


def common_body_of(clips: Sequence[Clip], tables: Sequence[NameTable] = ()) -> Skeleton:
    """The common body with the mean bone lengths of the people in ``clips``, the same on both sides.

    A person is a skeleton: clips whose joints and offsets agree are one person's, whatever their files. Limbs,
    spine and neck lie along the default body's directions; hips, shoulders and feet keep the people's shape.

    Args:
        clips: capture as read.
        tables: name tables to try before those that come along.

    Raises:
        InputError: for no clips, a skeleton that no table fits, or legs that have no length.
    """
    if not clips:
        raise InputError("there are no clips, expected at least one", "common body")
    shapes = [_person_offsets(own, table_for(own[0].skeleton, tables)) for own in _people(clips)]
    return _body_with(_symmetric(np.mean(shapes, axis=0)))


def floors_of(clips: Sequence[Clip], body: Skeleton, tables: Sequence[NameTable] = ()) -> list[Floor]:
    """The floor of each clip, at the scale of the common body ``body``; found together for each person's clips.

    Raises:
        InputError: for a skeleton that no table fits, or legs that have no length.
    """
    floors: dict[int, Floor] = {}
    for own in _people(clips):
        table = table_for(own[0].skeleton, tables)
        footings = [footing_of(body, *_scaled_pose(clip, body, table), clip.fps) for clip in own]
        floors |= zip(map(id, own), floors_under(footings), strict=True)
    return [floors[id(clip)] for clip in clips]


def onto_common_body(clip: Clip, body: Skeleton, table: NameTable, floor: Floor | None = None) -> Clip:
    """``clip`` moved by the common body ``body``, feet on y = 0, with contacts; labels and rate are kept.

    Motion of that very body which stands on the floor already is kept as it is: what was written out comes back.

    Args:
        clip: capture as read.
        body: the common body.
        table: what the clip's joints are called.
        floor: what ``floors_of`` found; without it the floor that this clip shows by itself, which for a short run
            may be centimetres off.

    Raises:
        InputError: where the clip's skeleton lacks a joint of the table or its legs have no length.
    """
    if (own := _own_motion(clip, body)) is not None and _levelled(own, table, floor):
        return replace(own, contacts=detect_contacts(own))
    places, turns = _levelled_pose(clip, body, table, floor)
    turns = _lean_spine(body, places, _aimed(body, places, turns))
    at = _chain(body, places, turns)
    ankles, turns = lay_feet(body, places, turns)
    targets = _ankle_targets(body, places, ankles, at[:, _THIGHS])
    for foot, side in enumerate(_SIDES):
        limb = leg(body, side)
        turns[:, limb.upper], turns[:, limb.lower] = reach(at, turns, limb, targets[:, foot])
    rotations = quaternion.unroll(local_rotations(body, turns))
    mapped = Clip(clip.name, body, clip.fps, at[:, 0], rotations, labels=clip.labels)
    return replace(mapped, contacts=detect_contacts(mapped))


def _own_motion(clip: Clip, body: Skeleton) -> Clip | None:
    """The clip on the body, where its skeleton is that body, its joints in any order."""
    skeleton = clip.skeleton
    if clip.translations is not None or sorted(skeleton.names) != sorted(body.names):
        return None
    order = skeleton.indices(body.names)
    if not np.allclose(skeleton.offsets[order][1:], body.offsets[1:], rtol=0.0, atol=_ROUNDING):
        return None
    return replace(clip, skeleton=body, rotations=quaternion.unroll(clip.rotations[:, order]), contacts=None)


def _levelled(own: Clip, table: NameTable, floor: Floor | None) -> bool:
    """Whether the floor would hardly move the motion of the body itself."""
    places = _scaled_pose(own, own.skeleton, table)[0]
    return bool(np.abs(_levelled_pose(own, own.skeleton, table, floor)[0] - places).max() < _LEVEL)


def captured_places(clip: Clip, body: Skeleton, table: NameTable, floor: Floor | None = None) -> NDArray[np.float64]:
    """Where the captured joints are at the common body's scale and floor: what a mapping is measured against.

    Returns:
        places of the common body's joints as captured, metres.  # (F, J, 3)
    """
    return _levelled_pose(clip, body, table, floor)[0]


def _levelled_pose(
    clip: Clip, body: Skeleton, table: NameTable, floor: Floor | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    places, turns = _scaled_pose(clip, body, table)
    if floor is None:
        (floor,) = floors_under([footing_of(body, places, turns, clip.fps)])
    return floor.level(places, turns)


def _ankle_targets(
    body: Skeleton, places: NDArray[np.float64], ankles: NDArray[np.float64], hips: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Where the body's ankles shall be, given where the captured ones were laid and its hips are.  # (F, feet, 3)

    The way from hip to ankle is stretched by the ratio of the body's leg to the captured leg of that side. Legs of
    one person differ by millimetres, which hardly move an ankle but bend a straight knee by centimetres.
    """
    captured = np.linalg.norm(places[:, _SHANKS] - places[:, _THIGHS], axis=-1)
    captured = (captured + np.linalg.norm(places[:, _ANKLES] - places[:, _SHANKS], axis=-1)).mean(axis=0)
    stretch = np.linalg.norm(body.offsets[[_SHANKS, _ANKLES]], axis=-1).sum(axis=0) / captured
    return hips + stretch[:, None] * (ankles - hips)


def _scaled_pose(clip: Clip, body: Skeleton, table: NameTable) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The captured pose with its lengths and travel scaled by the legs', so that steps fit the body's legs."""
    places, turns = source_pose(clip, table)
    captured = sum(_distance(places[:, a], places[:, b]) for a, b in ((_THIGHS, _SHANKS), (_SHANKS, _ANKLES)))
    own = sum(np.linalg.norm(body.offsets[joints], axis=-1).mean() for joints in (_SHANKS, _ANKLES))
    return places * (own / captured), turns


def _distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Mean distance of two sets of places (..., 3)."""
    return float(np.linalg.norm(a - b, axis=-1).mean())


def _aimed(body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """World rotations (F, J, 4) with each bone along the captured one, by the smallest turn that does it."""
    aimed = turns.copy()
    for bone, tip in _AIMED.items():
        aimed[:, bone] = _aim(turns[:, bone], body.offsets[tip], places[:, tip] - places[:, bone])
    return aimed


def _aim(turns: NDArray[np.float64], rest: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.float64]:
    """``turns`` (F, 4) brought to point ``rest`` (3,) along ``directions`` (F, 3), kept where these are zero."""
    present = quaternion.rotate(turns, rest)
    some = np.linalg.norm(directions, axis=-1, keepdims=True) > _SHORTEST
    if not np.linalg.norm(rest) > _SHORTEST:
        return turns
    return quaternion.multiply(quaternion.between(present, np.where(some, directions, present)), turns)


def _lean_spine(body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """The spine turned to where the chest is seen from the hips, which makes up for spines of more joints.

    A captured back bends below the common body's spine too; pointing along the captured bone would leave the whole
    upper body beside its place.
    """
    middle = body.offsets[_THIGHS].mean(axis=0)
    to_spine = quaternion.rotate(turns[:, 0], body.offsets[_SPINE] - middle)
    to_chest = places[:, _CHEST] - places[:, _THIGHS].mean(axis=1)
    own = np.linalg.norm(body.offsets[_SPINE] + body.offsets[_CHEST] - middle)
    share = own / np.linalg.norm(to_chest, axis=-1).mean()
    leaned = turns.copy()
    leaned[:, _SPINE] = _aim(turns[:, _SPINE], body.offsets[_CHEST], share * to_chest - to_spine)
    return leaned


def _chain(body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """World places (F, J, 3) of the body turned by ``turns`` with its hip joints' middle at the captured one.

    The hip joints hold the legs: anchoring these keeps the knees as bent as they were, wherever a capture puts
    its root.
    """
    local = local_rotations(body, turns)
    middle = quaternion.rotate(turns[:, 0], body.offsets[_THIGHS].mean(axis=0))
    return forward(body, places[:, _THIGHS].mean(axis=1) - middle, local)[0]


def _people(clips: Sequence[Clip]) -> list[list[Clip]]:
    """The clips of each person, in their order."""
    people: dict[bytes, list[Clip]] = {}
    for clip in clips:
        people.setdefault(_person(clip.skeleton), []).append(clip)
    return list(people.values())


def _person(skeleton: Skeleton) -> bytes:
    """What tells one person from another: names and offsets to a tenth of a millimetre, root's place aside."""
    return "\n".join(skeleton.names).encode() + np.round(skeleton.offsets[1:], 4).tobytes()


def _person_offsets(clips: Sequence[Clip], table: NameTable) -> NDArray[np.float64]:
    """Place of each common joint in its parent's frame on one person, mean over all frames.  # (J, 3)"""
    poses = [source_pose(clip, table) for clip in clips]
    places = np.concatenate([pose[0] for pose in poses])
    turns = _aimed(default_body(), places, np.concatenate([pose[1] for pose in poses]))
    bones = places[:, 1:] - places[:, PARENTS[1:]]
    own = quaternion.rotate(quaternion.conjugate(turns[:, PARENTS[1:]]), bones).mean(axis=0)
    return np.concatenate([np.zeros((1, 3)), own])


def _symmetric(offsets: NDArray[np.float64]) -> NDArray[np.float64]:
    """``offsets`` (J, 3) made the same on both sides; the trunk comes to lie in the middle."""
    others = [name.replace("left", "LEFT").replace("right", "left").replace("LEFT", "right") for name in NAMES]
    mirrored = offsets[[NAMES.index(name) for name in others]] * [-1.0, 1.0, 1.0]
    return 0.5 * (offsets + mirrored)


def _body_with(offsets: NDArray[np.float64]) -> Skeleton:
    """The common body with these offsets; heads, hands and toes, which few captures measure, grow with the legs."""
    template = default_body()
    legs = np.concatenate([_SHANKS, _ANKLES])
    growth = np.linalg.norm(offsets[legs], axis=-1).sum() / np.linalg.norm(template.offsets[legs], axis=-1).sum()
    return replace(template, offsets=offsets, ends=template.ends * growth)
