"""Pose messages made by compiled code, beside those of the codec."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footwork.protocol.codec import decode_from_server, encode
from footwork.protocol.messages import Pose
from footwork.protocol.pose_arrays import packed
from footwork.runtime.pose_frames import PoseFrames
from footwork.runtime.pose_messages import PoseMessages

CAPACITY = 6
EDGES = [edge for power in (0, 7, 8, 16, 32, 53) for edge in (2**power - 1, 2**power)][:-1]
COUNTERS = st.sampled_from(EDGES) | st.integers(0, 2**53 - 1)


def shown(joints: int, fights: bool, seed: int = 1) -> PoseFrames:
    random = np.random.default_rng(seed)
    numbers = random.choice([-1, 0, 127, 128, 255, 256, 65535, 65536, 2**31 - 1], (3, CAPACITY)).astype(np.int32)
    shares = random.uniform(-1.0, 1.0, (2, CAPACITY))
    return PoseFrames(
        random.normal(size=(CAPACITY, 3)).astype(np.float32),
        random.normal(size=(CAPACITY, joints, 4)).astype(np.float32),
        random.normal(size=(CAPACITY, 3))[:, 2],
        *numbers,
        transition=random.integers(0, 2, CAPACITY).astype(np.bool_),
        health=shares[0] if fights else None,
        stamina=shares[1] if fights else None,
    )


def as_the_codec_has_it(frames: PoseFrames, row: tuple[int, int, int, int], tick: int, frame: int) -> bytes:
    slot, number, acknowledged, lost = row
    fought = {} if frames.health is None else {"health": frames.health[slot].item()}
    fought |= {} if frames.stamina is None else {"stamina": frames.stamina[slot].item()}
    pose = Pose(
        tick=tick,
        frame=frame,
        character=number,
        acknowledged=acknowledged,
        facing=frames.facing[slot].item(),
        behaviour=frames.behaviour[slot].item(),
        clip=frames.clip[slot].item(),
        source_frame=frames.source_frame[slot].item(),
        transition=frames.transition[slot].item(),
        root=packed(frames.root[slot]),
        rotations=packed(frames.rotations[slot]),
        lost=lost,
        **fought,
    )
    return encode(pose)


FRAMES = {fights: shown(21, fights) for fights in (False, True)}
MESSAGES = {fights: PoseMessages(frames) for fights, frames in FRAMES.items()}


@given(
    st.booleans(),
    st.lists(st.tuples(st.integers(0, CAPACITY - 1), st.integers(0, 65535), COUNTERS, COUNTERS), max_size=CAPACITY),
    COUNTERS,
    st.integers(1, 1000),
)
def test_they_are_the_codecs_own_bytes(fights, rows, tick, frame):
    expected = [as_the_codec_has_it(FRAMES[fights], row, tick, frame) for row in rows]
    assert MESSAGES[fights].of(rows, tick=tick, frame=frame) == expected


@pytest.mark.parametrize("joints", [1, 15, 16, 256])
def test_any_number_of_joints_fits(joints):
    frames, most = shown(joints, fights=True), 2**53 - 1
    rows = [(slot, 65535, most, most) for slot in range(CAPACITY)]
    for data, row in zip(PoseMessages(frames).of(rows, tick=most, frame=1000), rows, strict=True):
        assert data == as_the_codec_has_it(frames, row, most, 1000)
        assert isinstance(decode_from_server(data), Pose)


def test_they_tell_what_the_arrays_hold_by_now():
    frames = shown(3, fights=False)
    messages = PoseMessages(frames)
    before = messages.of([(2, 0, 0, 0)], tick=1, frame=1)
    frames.rotations[2, 0, 0] += 1.0
    assert messages.of([(2, 0, 0, 0)], tick=1, frame=1) != before
    assert messages.of([(2, 0, 0, 0)], tick=1, frame=1) == [as_the_codec_has_it(frames, (2, 0, 0, 0), 1, 1)]
