import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.errors import InputError
from footwork.motion.metrics import NAMES, metric_of
from footwork.training.knee import APART, _broken_stick, distinct, knee, threshold_at_knee
from footwork.training.transitions import Minima, local_minima
from shared_data import MOTIONS, needs_motions


def bent(corner: int, ranks: int, steep: float = 1.0, flat: float = 0.05) -> np.ndarray:
    """Costs that rise by ``steep`` a rank up to a corner and by ``flat`` after it."""
    rise = np.where(np.arange(1, ranks) < corner, steep, flat)
    return np.concatenate([[1.0], 1.0 + np.cumsum(rise)])


def minima_of(costs, frames: int) -> Minima:
    """Minima of a clip of so many frames, far apart from each other, with these costs."""
    half, number = frames // 2, np.arange(len(costs))
    across = half // 8
    assert len(costs) <= across**2
    return Minima(8 * (number // across), half + 8 * (number % across), np.asarray(costs, float))


@pytest.mark.parametrize(("corner", "ranks"), [(3, 40), (10, 100), (67, 414), (30, 372), (200, 272)])
def test_both_methods_find_a_sharp_corner(corner, ranks):
    found = knee(bent(corner, ranks))
    assert (found.kneedle, found.broken_stick, found.rank) == (corner, corner, corner)
    assert found.agree
    assert found.warning is None
    costs = found.costs
    assert costs[corner - 1] < found.threshold < costs[corner]
    assert np.sum(costs < found.threshold) == corner


def test_noise_moves_the_knee_little():
    noise = np.random.default_rng(0).normal(0.0, 0.3, 300)
    found = knee(np.sort(bent(60, 300) + noise))
    assert 55 <= found.rank <= 65
    assert found.agree


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), ranks=st.integers(5, 60), power=st.floats(0.2, 0.8))
def test_the_broken_stick_is_the_least_squares_fit(seed, ranks, power):
    y, x = np.sort(np.random.default_rng(seed).random(ranks)) ** power, np.arange(ranks)
    squares = {}
    for knot in range(1, ranks - 1):
        columns = np.stack([np.ones(ranks), x, np.maximum(x - knot, 0)], axis=1)
        fitted = np.linalg.lstsq(columns, y, rcond=None)[0]
        if fitted[2] < 0.0:
            squares[knot] = np.sum((columns @ fitted - y) ** 2)
    found = _broken_stick(y)
    assert (found is None) == (not squares)
    if found is not None:
        assert squares[found] == pytest.approx(min(squares.values()), abs=1e-12)


def test_the_knee_does_not_depend_on_the_unit_but_its_curve_is_in_medians():
    small, large = knee(bent(20, 90), 4.0), knee(1000.0 * bent(20, 90), 4000.0)
    assert (small.rank, large.rank) == (20, 20)
    assert large.threshold == pytest.approx(1000.0 * small.threshold)
    np.testing.assert_allclose(small.curve, bent(20, 90) / 4.0)
    np.testing.assert_allclose(large.curve, small.curve)


def test_methods_that_differ_take_the_smaller_rank_and_warn():
    costs = np.concatenate([np.linspace(0.0, 5.0, 10), np.linspace(5.1, 9.0, 60), np.linspace(9.0, 9.3, 60)])
    found = knee(costs)
    assert found.kneedle is not None
    assert found.broken_stick is not None
    assert not found.agree
    assert found.rank == min(found.kneedle, found.broken_stick)
    assert f"takes the best {found.rank}" in str(found.warning)


def test_repeats_within_a_quarter_of_a_second_are_dropped_inside_their_clips_only():
    assert APART == 7
    i = np.array([100, 107, 108, 100, 100, 298, 303])
    j = np.array([400, 407, 400, 409, 396, 400, 400])
    minima = Minima(i, j, np.array([1.0, 2.0, 3.0, 4.0, 0.5, 6.0, 7.0]))
    kept = distinct(minima, [300, 200], 99)
    # (100, 396) is best: (100, 400) repeats it, but (107, 407) is 11 away; (108, 400) then repeats that one, and
    # (100, 409) too; 298 and 303 lie in two clips
    assert list(zip(kept.i.tolist(), kept.j.tolist(), strict=True)) == [(100, 396), (107, 407), (298, 400), (303, 400)]
    assert kept.cost.tolist() == [0.5, 2.0, 6.0, 7.0]
    assert len(distinct(minima, [300, 200], 2).cost) == 2


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_dropping_repeats_equals_comparing_with_all_kept(seed):
    rng = np.random.default_rng(seed)
    lengths = (40, 30, 50)
    i, j = np.sort(rng.integers(0, sum(lengths), (2, 150)), axis=0)
    minima = Minima(i, j, rng.random(150))
    clip = np.repeat(np.arange(3), lengths)
    kept: list[int] = []
    for number in np.argsort(minima.cost):
        near = [
            k
            for k in kept
            if clip[i[k]] == clip[i[number]]
            and clip[j[k]] == clip[j[number]]
            and abs(i[k] - i[number]) <= APART
            and abs(j[k] - j[number]) <= APART
        ]
        if not near:
            kept.append(int(number))
    np.testing.assert_array_equal(distinct(minima, lengths, 999).cost, minima.cost[kept])


def test_only_the_first_ranks_are_looked_at():
    """A tenth of the frames: what comes after, here a second knee, changes nothing."""
    costs = np.concatenate([bent(20, 100), 1000.0 + bent(150, 300)])
    assert threshold_at_knee(minima_of(costs, 1000), [1000]).rank == 20


def test_a_head_without_a_knee_is_doubled_until_there_is_one():
    costs = np.concatenate([np.linspace(0.0, 1.0, 60) ** 3, 1.0 + 0.05 * np.linspace(0.0, 1.0, 60)])
    found = threshold_at_knee(minima_of(costs, 300), [300])
    assert len(found.costs) > 30
    assert found.agree
    assert 50 <= found.rank <= 65


def test_a_knee_that_one_method_alone_finds_comes_with_a_warning():
    """A curve that bends up all the way but for its very end."""
    costs = np.concatenate([np.linspace(0.0, 1.0, 90) ** 3, 1.0 + 0.001 * np.arange(1, 6)])
    found = knee(costs)
    assert (found.kneedle, found.broken_stick, found.rank) == (90, None, 90)
    assert not found.agree
    assert "Kneedle puts it at rank 90 and the broken stick at none" in str(found.warning)
    assert threshold_at_knee(minima_of(costs, 300), [300]).rank == 90


@pytest.mark.parametrize(
    ("costs", "median", "says"),
    [
        ([], None, "0 places for a transition, fewer than the 5"),
        ([1.0, 2.0, 3.0, 3.5], None, "4 places"),
        (np.full(50, 3.0), None, "all costs are 3"),
        (np.zeros(50), None, "all costs are 0"),
        (np.linspace(0, 1, 50), None, "do not rise steeply and then flatten"),
        (np.linspace(0, 1, 50) ** 2, None, "do not rise steeply and then flatten"),
        (bent(5, 40), 0.0, "median of the costs is 0"),
        (bent(5, 40), np.nan, "median of the costs is nan"),
        (bent(5, 40)[::-1], None, "not in ascending order"),
        ([0.0, 1.0, np.inf, np.inf, np.inf], None, "is inf"),
    ],
)
def test_costs_without_a_knee_are_refused_with_the_reason(costs, median, says):
    with pytest.raises(InputError, match=f"threshold.*{says}"):
        knee(costs, median)


@pytest.mark.parametrize("costs", [np.zeros(0), np.full(30, 2.0), np.linspace(0, 1, 40) ** 2, np.zeros(30)])
def test_minima_without_a_knee_are_refused_too(costs):
    with pytest.raises(InputError, match="no knee to choose it by"):
        threshold_at_knee(minima_of(costs, 200), [200])


def test_a_constant_cost_matrix_has_no_knee():
    minima = local_minima(np.full((90, 90), 4.0), [45, 45])
    with pytest.raises(InputError, match="no knee"):
        threshold_at_knee(minima, [45, 45], 4.0)


@needs_motions
@pytest.mark.parametrize("name", NAMES)
def test_on_capture_the_methods_agree(name):
    from footwork.training.dataset import load_clips

    clips = load_clips(MOTIONS / "dataset2", ranges=MOTIONS / "core_ranges.csv").clips
    lengths = [clip.frame_count for clip in clips]
    costs = metric_of(name, clips).all_pairs()
    found = threshold_at_knee(local_minima(costs, lengths), lengths, float(np.median(costs)))
    assert found.agree
    assert 8 <= found.rank <= 20
    assert 0.1 < found.threshold < 1.0
