from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.dynamics_metric import DynamicsMetric
from footwork.motion.metric import PointCloudMetric
from footwork.motion.metrics import NAMES, fixed_cloud, metric_of
from footwork.motion.pair_weights import dynamics_weights
from footwork.training.chains import CONTEXT, chains_of_clips
from footwork.training.row_metric import contacts_of_rows, row_metric, window_rows
from motion_samples import EVERY_WAY, sample_clips, stepping

BEHAVIOURS = ("stop", "walk", "run", "jump")


def with_context(chains):
    """The last chain's outer rows made its context."""
    start, end = chains.first_node[-1], chains.node_count
    kept = np.r_[0:start, start + CONTEXT : end - CONTEXT]
    length, context = chains.length.copy(), chains.context.copy()
    length[-1], context[-1] = length[-1] - 2 * CONTEXT, CONTEXT
    names = ("clip", "frame", "other_clip", "other_frame", "label", "behaviour", "contacts")
    return replace(chains, length=length, context=context, **{name: getattr(chains, name)[kept] for name in names})


@pytest.fixture(scope="module")
def clips():
    return [stepping(clip, 7, EVERY_WAY) for clip in sample_clips(3, 60)]


@pytest.mark.parametrize("name", NAMES)
def test_rows_of_clips_cost_what_their_frames_do(name, clips):
    chains, metric = chains_of_clips(clips, BEHAVIOURS), metric_of(name, clips)
    i, j = np.random.default_rng(0).integers(0, chains.row_count, (2, 400))
    rows = row_metric(name, chains)
    np.testing.assert_allclose(rows.costs(i, j), metric.pair_costs(i, j), atol=1e-9)
    there, want = rows.align(i, j), metric.align(i, j)
    np.testing.assert_allclose(np.stack(there[1:3]), np.stack(want[1:3]), atol=1e-6)
    assert rows.costs(i[:0], j[:0]).shape == (0,)


def test_context_rows_stand_as_the_nearest_frame_of_their_chain(clips):
    whole = chains_of_clips(clips, BEHAVIOURS)
    chains = with_context(whole)
    contacts = contacts_of_rows(chains, np.arange(chains.row_count))
    first, last = chains.first_row[-1] + CONTEXT, chains.row_count - 1 - CONTEXT
    expected = whole.contacts.copy()
    expected[first - CONTEXT : first], expected[last + 1 :] = expected[first], expected[last]
    np.testing.assert_array_equal(contacts, expected)
    assert (contacts != whole.contacts).any()


def test_dynamics_over_chains_with_context_is_that_of_their_rows(clips):
    chains = with_context(chains_of_clips(clips, BEHAVIOURS))
    starts = chains.first_row[1:]
    contacts = np.split(contacts_of_rows(chains, np.arange(chains.row_count)), starts)
    costs = DynamicsMetric(np.split(chains.places, starts), contacts, dynamics_weights(chains.skeleton)).all_pairs()
    i, j = np.random.default_rng(1).integers(0, chains.row_count, (2, 500))
    np.testing.assert_allclose(row_metric("dynamics", chains).costs(i, j), costs[i, j], atol=1e-8)


@pytest.mark.parametrize("name", NAMES)
def test_fixed_weights_bound_every_metric_from_below(name, clips):
    chains = with_context(chains_of_clips(clips, BEHAVIOURS))
    rows = row_metric(name, chains)
    assert rows.weights.sum() == pytest.approx(1.0)
    points = np.split(rows.points, chains.first_row[1:])
    bound = PointCloudMetric(points, rows.weights).all_pairs()
    i, j = np.random.default_rng(2).integers(0, chains.row_count, (2, 500))
    if name == "dynamics":
        assert (rows.costs(i, j) >= bound[i, j] - 1e-9).all()
    else:
        np.testing.assert_allclose(rows.costs(i, j), bound[i, j], atol=1e-9)


def test_places_are_shared_where_the_points_are_the_joints(clips):
    chains = chains_of_clips(clips, BEHAVIOURS)
    assert row_metric("uniform", chains).points is chains.places
    assert row_metric("torso", chains).points is chains.places
    np.testing.assert_array_equal(
        row_metric("joints", chains).points, fixed_cloud("joints", chains.skeleton).points(chains.places)
    )


def test_windows_are_held_at_the_ends_of_their_chains(clips):
    chains = with_context(chains_of_clips(clips, BEHAVIOURS))
    np.testing.assert_array_equal(window_rows(chains, np.array([2, 59, 60, 179]))[:, ::5], [
        [0, 2, 7], [54, 59, 59], [60, 60, 65], [174, 179, 179],
    ])  # fmt: skip


def test_an_unknown_metric_is_refused(clips):
    with pytest.raises(InputError, match="expected one of uniform"):
        row_metric("torsion", chains_of_clips(clips, BEHAVIOURS))
