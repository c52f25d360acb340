"""The pose message of one character of what is shown."""

from msgspec.structs import replace

from footwork.protocol.messages import Pose
from footwork.protocol.pose_arrays import packed
from footwork.runtime.simulation import PoseFrames


def pose_message(shown: PoseFrames, slot: int, *, tick: int, frame: int, number: int, acknowledged: int = 0) -> Pose:
    """What ``shown`` has of a slot, at shown frame ``frame`` of ``tick``, for whom the character has ``number``."""
    pose = Pose(
        tick=tick,
        frame=frame,
        character=number,
        acknowledged=acknowledged,
        facing=shown.facing.item(slot),
        behaviour=shown.behaviour.item(slot),
        clip=shown.clip.item(slot),
        source_frame=shown.source_frame.item(slot),
        transition=shown.transition.item(slot),
        root=packed(shown.root[slot]),
        rotations=packed(shown.rotations[slot]),
    )
    if shown.health is None or shown.stamina is None:
        return pose
    return replace(pose, health=shown.health.item(slot), stamina=shown.stamina.item(slot))
