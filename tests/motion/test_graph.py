"""What a motion graph refuses to be, and where its nodes come from."""

from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from motion_samples import ring_graph


def between_two(weight: float) -> MotionGraph:
    graph = ring_graph(4)
    share = graph.weight.copy()
    share[2] = weight
    other = graph.other_frame.copy()
    other[2] = 0
    return replace(graph, weight=share, other_frame=other)


def test_captured_frames_are_original_and_frames_between_two_are_not():
    assert ring_graph(3).original.all()
    assert between_two(0.3).original.tolist() == [True, True, False, True]


@pytest.mark.parametrize(("weight", "frame"), [(0.3, 0), (0.5, 2), (0.8, 2)])
def test_the_nearest_source_is_the_one_with_the_greater_weight(weight, frame):
    assert between_two(weight).nearest_source[1].tolist() == [0, 1, frame, 3]


@pytest.mark.parametrize("weight", [-0.1, 1.1, np.nan])
def test_a_weight_outside_0_to_1_is_refused(weight):
    with pytest.raises(InputError, match="weight"):
        between_two(weight)


def test_a_captured_frame_with_another_source_is_refused():
    with pytest.raises(InputError, match="node 2 has weight 1 and yet another source"):
        between_two(1.0)


def test_a_second_source_that_is_no_clip_is_refused():
    with pytest.raises(InputError, match="other_clip holds 0 to 7"):
        replace(between_two(0.5), other_clip=np.array([0, 0, 7, 0]))
