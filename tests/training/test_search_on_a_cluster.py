"""The real search for transitions finds the same on two workers, one of which is killed on the way, as in process."""

import numpy as np
import pytest

from footwork.training.backend import backend
from footwork.training.interpolation import interpolated
from footwork.training.transition_search import search
from local_cluster import LocalCluster, local_cluster, needs_dask
from motion_samples import sample_clips

THRESHOLD = 0.5


@pytest.fixture(scope="module")
def chains():
    return interpolated(sample_clips(2, 80), ("stop", "walk"), 9)[0]


def kill_a_worker(cluster: LocalCluster) -> None:
    cluster.processes[1].kill()
    cluster.processes[1].wait()


@needs_dask
@pytest.mark.timeout(400)  # kernels may have to be compiled first
def test_the_transitions_are_the_same_though_a_worker_is_killed(chains, tmp_path):
    here = search(chains, THRESHOLD)
    shares: list[float] = []

    def told(share: float) -> None:
        if len(shares) == 2:
            kill_a_worker(cluster)
        shares.append(share)

    with local_cluster(tmp_path) as cluster, backend("dask", scheduler=cluster.address):
        there = search(chains, THRESHOLD, progress=told)
        assert cluster.processes[1].poll() is not None
        assert cluster.processes[2].poll() is None
    assert len(shares) > 10
    assert shares[-1] == 1.0
    assert len(here.i) > 100
    for name in ("i", "j", "cost"):
        np.testing.assert_array_equal(getattr(there, name), getattr(here, name))
