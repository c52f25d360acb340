from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.skeleton import Skeleton
from footwork.training.interpolation import interpolated
from motion_samples import sample_clip

BEHAVIOURS = ("stop", "walk")


def standing(frames: int) -> Clip:
    """A sample clip with both feet in contact."""
    return replace(sample_clip(0, frames), contacts=np.ones((frames, 2), bool))


@pytest.mark.parametrize("weights", [0, -1, 100, 10**12])
def test_absurd_weights_are_refused(weights):
    with pytest.raises(InputError, match=f"{weights} weights, expected 1 to 99"):
        interpolated([standing(30)], BEHAVIOURS, weights)


def test_unknown_rules_and_other_bodies_are_refused():
    clip = standing(30)
    with pytest.raises(InputError, match="no pairing rule"):
        interpolated([clip], BEHAVIOURS, 2, "best")
    body = clip.skeleton
    massless = replace(clip, skeleton=Skeleton(body.names, body.parents, body.offsets, body.ends, feet=body.feet))
    with pytest.raises(InputError, match="no masses"):
        interpolated([massless], BEHAVIOURS, 2)
    taller = Skeleton(body.names, body.parents, body.offsets * 1.1, body.ends, body.masses, body.feet)
    with pytest.raises(InputError, match="another body"):
        interpolated([clip, replace(clip, skeleton=taller)], BEHAVIOURS, 2)


def test_no_clips_are_refused():
    with pytest.raises(InputError, match="no clips"):
        interpolated([], BEHAVIOURS)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_the_shortest_clips_can_be_mixed(frames):
    chains, report = interpolated([standing(frames), standing(frames)], BEHAVIOURS, 2)
    assert report["kept"] == 2
    np.testing.assert_array_equal(chains.length, frames)
    assert np.isfinite(chains.places).all()


def test_segments_that_nothing_equals_leave_the_clips_alone():
    chains, report = interpolated([standing(20)], BEHAVIOURS, 2)
    assert (report["pairs"], report["chains"], chains.chain_count) == (0, 0, 1)
