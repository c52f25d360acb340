import numpy as np
import pytest

from footwork.motion import blocks
from footwork.motion.metric import PointCloudMetric
from footwork.motion.threads import thread_count
from motion_samples import sample_clips


def test_at_least_one_thread_and_no_more_than_eight():
    assert 1 <= thread_count() <= 8


@pytest.mark.parametrize("threads", [1, 3])
def test_costs_do_not_depend_on_the_threads(monkeypatch, threads):
    metric = PointCloudMetric.of_clips(sample_clips(3, 90))
    expected = metric.all_pairs()
    monkeypatch.setattr(blocks, "THREADS", threads)
    np.testing.assert_array_equal(metric.all_pairs(), expected)
