"""The last measurements."""

import numpy as np

from footwork.runtime.ring import Ring


def test_percentiles_are_those_of_the_last_ones_kept():
    ring = Ring(size=100)
    for value in range(250):
        ring.add(value)
    kept = np.arange(150, 250)
    assert ring.count == 250
    for share in (0, 50, 99, 100):
        assert ring.percentile(share) == np.percentile(kept, share)


def test_an_empty_ring_says_zero_and_a_half_full_one_ignores_the_rest():
    ring = Ring(size=10)
    assert ring.percentile(99) == 0.0
    ring.add(5.0)
    assert ring.percentile(0) == 5.0
