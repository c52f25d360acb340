"""Lower bounds of s from short sketches of windows."""

import numpy as np

from footwork.motion.task import BEHAVIOURS
from footwork.training.chains import chains_of_clips
from footwork.training.row_metric import uniform_rows
from footwork.training.sketches import GROUND, HEIGHT, SLACK, WIDTH, least_costs, panels_of, sketches_of
from footwork.training.window_basis import shares_of
from footwork.training.windows import windows_of
from toy_graphs import wandering_clip


def test_no_bound_is_above_the_cost_and_most_come_near_it():
    chains = chains_of_clips([wandering_clip(seed, 48) for seed in range(3)], BEHAVIOURS)
    metric = uniform_rows(chains)
    sketches = sketches_of(shares_of(windows_of(metric), GROUND, HEIGHT))
    rows = np.arange(chains.row_count)
    panels = panels_of(sketches.values, rows)
    shrunk = (sketches.energy * np.float32(1.0 - SLACK)).reshape(-1, WIDTH)
    bounds = np.empty((len(rows), len(rows)), np.float32)
    for row in rows:
        for panel in range(len(panels)):
            at = bounds[row, panel * WIDTH : (panel + 1) * WIDTH]
            least_costs(sketches.values[row], panels, shrunk, panel, shrunk.ravel()[row], at)
    here, there = np.triu_indices(len(rows), 1)
    costs = metric.costs(here, there)
    assert (bounds[here, there] <= costs).all()
    assert np.median(bounds[here, there] / costs) > 0.8
