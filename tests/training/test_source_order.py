import numpy as np

from footwork.training.edge_order import starts
from footwork.training.path_cost import UNIT
from footwork.training.source_order import dealt, runs_of_originals


def runs(*lengths: int) -> list[np.ndarray]:
    ends = np.cumsum(lengths)
    return [np.arange(end - length, end) for length, end in zip(lengths, ends, strict=True)]


def test_clips_are_runs_of_originals_that_natural_edges_join_each_from_its_last_frame():
    # 0-1-2 is a clip, 3 leads on to 4 dearer than a natural edge does, 4-5 is a clip, 6 is interpolated
    source, target = np.array([0, 1, 3, 4, 5]), np.array([1, 2, 4, 5, 6])
    base = np.array([UNIT, UNIT, UNIT + 1, UNIT, UNIT])
    found = runs_of_originals(6, starts(7, source), target, base, "frames", 0)
    assert [run.tolist() for run in found] == [[2, 1, 0], [3], [5, 4]]


def test_streams_get_about_as_many_frames_and_keep_the_order_of_clips():
    own = dealt(runs(5, 9, 2, 8, 3), 2)
    assert [[len(run) for run in mine] for mine in own] == [[9, 2, 3], [5, 8]]


def test_a_stream_may_stay_empty():
    assert [len(mine) for mine in dealt(runs(4), 3)] == [1, 0, 0]
