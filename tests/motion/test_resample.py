import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.quaternion import normalise
from footwork.motion.resample import resample, whole_steps
from footwork.motion.skeleton import Skeleton

BODY = Skeleton(
    names=("hips", "foot"),
    parents=np.array([-1, 0]),
    offsets=np.array([[0, 0, 0], [0, -0.9, 0]]),
    feet=np.array([[1, 1]]),
)


def clip_at(fps: float, frames: int, seed: int = 0) -> Clip:
    rng = np.random.default_rng(seed)
    return Clip(
        name="random",
        skeleton=BODY,
        fps=fps,
        root_position=rng.normal(size=(frames, 3)),
        rotations=normalise(rng.normal(size=(frames, 2, 4))),
        contacts=rng.random((frames, 1)) < 0.5,
        labels=rng.choice(["walk", "idle"], frames),
        translations=rng.normal(size=(frames, 2, 3)),
    )


@given(st.integers(1, 40), st.integers(1, 8))
def test_whole_ratio_gives_exact_subsamples(frames: int, ratio: int):
    clip = clip_at(30.0 * ratio, frames)
    ours = resample(clip, 30.0)
    assert ours.fps == 30.0
    for name in ("root_position", "rotations", "contacts", "labels", "translations"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(clip, name)[::ratio])


@given(st.integers(2, 40), st.sampled_from([24.0, 25.0, 29.97, 50.0, 59.94, 100.0]), st.integers(0, 99))
def test_rotations_are_those_of_scipys_slerp_and_places_lie_on_the_line(frames: int, fps: float, seed: int):
    clip = clip_at(fps, frames, seed)
    ours = resample(clip, 30.0)
    times = np.arange(ours.frame_count) / 30.0
    assert times[-1] <= clip.seconds + 1e-6 < times[-1] + 1 / 30.0 + 1e-6
    source_times = np.arange(frames) / fps
    for joint in range(2):
        wanted = Slerp(source_times, Rotation.from_quat(clip.rotations[:, joint]))(times.clip(max=source_times[-1]))
        assert (wanted.inv() * Rotation.from_quat(ours.rotations[:, joint])).magnitude().max() < 1e-6
    for axis in range(3):
        wanted = np.interp(times, source_times, clip.root_position[:, axis])
        np.testing.assert_allclose(ours.root_position[:, axis], wanted, atol=1e-6)


@given(st.integers(1, 300), st.sampled_from([24.0, 25.0, 50.0, 100.0]))
def test_labels_are_the_earlier_frames_and_contacts_the_nearest(frames: int, fps: float):
    clip = clip_at(fps, frames)
    ours = resample(clip, 30.0)
    before = np.arange(ours.frame_count) * int(fps) // 30
    np.testing.assert_array_equal(ours.labels, clip.labels[before])
    near = (2 * np.arange(ours.frame_count) * int(fps) + 30) // 60
    np.testing.assert_array_equal(ours.contacts, clip.contacts[near])


def test_own_rate_returns_the_clip_itself():
    clip = clip_at(30.0, 5)
    assert resample(clip, 30.0) is clip


@pytest.mark.parametrize("fps", [0.0, -30.0, float("nan"), float("inf"), 1e9])
def test_rates_that_are_no_rates_are_refused(fps: float):
    with pytest.raises(InputError, match="random"):
        resample(clip_at(120.0, 50), fps)


@given(st.integers(1, 60), st.sampled_from([24.0, 25.0, 100.0, 120.0]), st.integers(0, 59))
def test_a_source_frame_can_be_kept_with_what_lies_before_it(frames: int, fps: float, through: int):
    through %= frames
    clip = clip_at(fps, frames)
    whole, kept = resample(clip, 30.0, through), whole_steps(through, fps, 30.0)
    np.testing.assert_array_equal(whole.rotations[kept], clip.rotations[through])
    rest = resample(clip.cut(through, frames), 30.0)
    np.testing.assert_allclose(whole.root_position[kept:], rest.root_position, atol=1e-6)
    before = np.interp((through - np.arange(kept, 0, -1) * fps / 30.0), np.arange(frames), clip.root_position[:, 1])
    np.testing.assert_allclose(whole.root_position[:kept, 1], before, atol=1e-6)
