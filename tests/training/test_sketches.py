"""Lower bounds of s from short sketches of windows."""

import numpy as np

from footwork.motion.task import BEHAVIOURS
from footwork.training.chains import chains_of_clips
from footwork.training.row_metric import uniform_rows
from footwork.training.sketches import GROUND, HEIGHT, SLACK, WIDTH, find_near, panels_of, sketches_of
from footwork.training.window_basis import shares_of
from footwork.training.windows import windows_of
from toy_graphs import wandering_clip


def test_who_costs_less_than_a_limit_counts_as_near_and_few_others_do():
    chains = chains_of_clips([wandering_clip(seed, 48) for seed in range(3)], BEHAVIOURS)
    metric = uniform_rows(chains)
    sketches = sketches_of(shares_of(windows_of(metric), GROUND, HEIGHT))
    rows = np.arange(chains.row_count)
    panels = panels_of(sketches.values, rows).reshape(-1, sketches.values.shape[1] * WIDTH)
    half = np.float32(0.5) * (sketches.energy * np.float32(1.0 - SLACK))

    def near(row: int, limits: np.ndarray) -> np.ndarray:
        found, wanted = np.empty(len(rows), np.float32), (half - 0.5 * limits).astype(np.float32)
        for panel, at in zip(panels, np.split(rows, len(panels)), strict=True):
            find_near(sketches.values[row], half[row : row + 1], panel, wanted[at], found[at[0] : at[-1] + 1])
        return found > 0.0

    here, there = np.triu_indices(len(rows), 1)
    costs = np.zeros((len(rows), len(rows)))
    costs[here, there] = metric.costs(here, there)
    assert all(near(row, costs[row])[row + 1 :].all() for row in range(len(rows)))
    passed = [near(row, 0.8 * costs[row])[row + 1 :] for row in range(len(rows))]
    assert np.concatenate(passed).mean() < 0.5
