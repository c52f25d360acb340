import numpy as np
import pytest

from footwork.errors import InputError
from footwork.training.pair_estimate import estimated_pairs, require_room_for_pairs


def made_up(chains: int, density: float, seed: int = 0):
    """Rows in chains of 15 to 40, each pair of rows a transition by chance: starts, rows, pairs by first row."""
    rng = np.random.default_rng(seed)
    lengths = rng.integers(15, 40, chains)
    rows = int(lengths.sum())
    return np.cumsum(lengths) - lengths, rows, rng.binomial(rows - 1 - np.arange(rows), density)


def test_a_few_rows_are_counted_outright():
    starts, rows, pairs = made_up(20, 0.05)
    looked = np.zeros(rows, dtype=int)

    def count(begin: int, end: int) -> int:
        looked[begin:end] += 1
        return int(pairs[begin:end].sum())

    assert estimated_pairs(count, starts, rows) == pytest.approx(pairs.sum())
    assert (looked == 1).all()


@pytest.mark.parametrize("seed", range(3))
def test_many_rows_are_estimated_from_a_small_part(seed):
    starts, rows, pairs = made_up(20_000, 1e-3, seed)
    looked = []

    def count(begin: int, end: int) -> int:
        assert begin in starts
        assert end == rows or end in starts
        looked.append(end - begin)
        return int(pairs[begin:end].sum())

    assert estimated_pairs(count, starts, rows) == pytest.approx(pairs.sum(), rel=0.05)
    assert sum(looked) < 0.05 * rows


def test_one_chain_is_one_stretch():
    assert estimated_pairs(lambda begin, end: 7 * (begin == 0 and end == 5000), [0], 5000) == pytest.approx(7)


def test_more_transitions_than_memory_has_room_for_are_refused():
    require_room_for_pairs(1000.0)
    with pytest.raises(
        InputError, match=r"threshold: about 1e\+12 transitions need about 150,000.0 GB .* a lower threshold"
    ):
        require_room_for_pairs(1e12)
