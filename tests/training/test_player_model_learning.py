"""Learning a player model: from players made up with known habits, and from recorded ones."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import xlogy

from footwork.errors import InputError
from footwork.motion.angle import wrapped
from footwork.motion.player_model import PlayerModel, TraceFile
from footwork.motion.task import SteeringTask
from footwork.motion.trace import Trace, read_trace, steering_commands
from footwork.training.player_model import learned
from shared_data import TRACES, needs_traces

TASK = SteeringTask()
STOP, WALK, RUN, JUMP = range(4)
ALL = TASK.behaviours


def made_up(ticks: int = 20_000, seed: int = 0, name: str = "made up") -> Trace:
    """A player who turns the view at 60 degrees a second at times, jumps by the mouse, strafes and rarely walks."""
    rng = np.random.default_rng(seed)
    held = np.repeat(rng.random(ticks // 20) < 0.3, 20)
    yaw = np.radians(np.where(held, 60.0 / 35.0, np.where(rng.random(ticks) < 0.02, rng.uniform(-80, 80, ticks), 0.0)))
    forward = np.repeat(rng.integers(0, 2, ticks // 10), 10)
    strafe = np.repeat(rng.integers(-1, 2, ticks // 10), 10) * (forward > 0)
    run = np.repeat(rng.random(ticks // 100) < 0.9, 100)
    return trace_of(forward, strafe, run, yaw, name, f"{seed:064}")


def trace_of(forward: NDArray, strafe: NDArray, run: NDArray, yaw: NDArray, name: str, digest: str = "") -> Trace:
    none = np.zeros(len(yaw), dtype=bool)
    return Trace(name, forward.astype(np.int8), strafe.astype(np.int8), run, yaw, none, none, digest)


def walking(yaw: NDArray) -> Trace:
    """A player who walks ahead and turns the view by so much in each tick, radians."""
    ones = np.ones(len(yaw))
    return trace_of(ones, 0 * ones, ones < 0, yaw, "walking")


def changes(trace: Trace) -> tuple[NDArray, NDArray, NDArray]:
    """Behaviours before and after, and jumps of the heading, of each step of a trace."""
    commands = steering_commands(trace, 0.0, ALL)
    return commands.behaviour[:-1], commands.behaviour[1:], wrapped(np.diff(commands.heading))


def drawn(model: PlayerModel, ticks: int, seed: int = 0) -> tuple[NDArray, NDArray]:
    """Behaviours and jumps of the heading of a player who does as the model says.  # (ticks,) each"""
    bins, chance = model.heading_bins, np.random.default_rng(seed).random(ticks)
    ways = model.change.reshape(len(model.behaviours), -1).cumsum(axis=1)
    ways[:, -1] = 1.0
    behaviour, cells = STOP, np.empty(ticks, np.intp)
    for tick in range(ticks):
        cells[tick] = np.searchsorted(ways[behaviour], chance[tick], side="right")
        behaviour = cells[tick] // bins
    return cells // bins, wrapped(cells % bins * (2.0 * np.pi / bins))


def test_rows_sum_to_one_and_nothing_that_may_be_asked_is_impossible():
    model = learned([made_up()], TASK, ALL)
    np.testing.assert_allclose(model.change.sum(axis=(1, 2)), 1.0)
    assert (model.change[:JUMP, :JUMP] > 0.0).all()
    assert model.behaviours == ALL
    assert model.learned_from == (TraceFile("made up", "0" * 64),)


def test_a_player_drawn_from_the_model_turns_and_changes_as_the_one_it_was_learned_from():
    trace = made_up()
    before, after, jump = changes(trace)
    asked, turned = drawn(learned([trace], TASK, ALL), 100_000)
    assert turned.mean() == pytest.approx(jump.mean(), abs=math.radians(0.15))
    assert np.mean(np.diff(asked) != 0) == pytest.approx(np.mean(before != after), rel=0.1)
    np.testing.assert_allclose(
        np.bincount(asked, minlength=4) / 1e5, np.bincount(after, minlength=4) / len(after), atol=0.02
    )


@pytest.mark.parametrize("bins", [8, 36, 72])
def test_turns_of_less_than_a_bin_are_kept_in_the_mean(bins):
    trace = walking(np.full(3500, np.radians(60.0 / 35.0)))
    model = learned([trace], SteeringTask(heading_bins=bins), ALL)
    jumps = wrapped(np.arange(bins) * (2.0 * np.pi / bins))
    per_second = 30.0 * float((model.change[WALK].sum(axis=0) * jumps).sum())
    assert math.degrees(per_second) == pytest.approx(60.0, rel=0.01)


def test_the_hazard_is_the_share_of_ticks_that_change():
    turns = np.zeros(3500)
    turns[::7] = math.radians(45.0)  # seven source ticks are six of the controller's
    model = learned([walking(turns)], TASK, ALL)
    assert model.change[WALK, WALK, 0] == pytest.approx(5 / 6, abs=1e-3)
    np.testing.assert_allclose(model.change[WALK, WALK, [4, 5]], 1 / 12, rtol=0.01)


def test_what_is_never_asked_for_does_not_come_and_does_not_go():
    change = learned([made_up()], TASK, ALL).change
    assert change[JUMP, JUMP, 0] == 1.0
    assert not change[:JUMP, JUMP].any()


def test_a_graph_without_running_or_jumping_is_asked_to_walk():
    model = learned([made_up()], TASK, ("stop", "walk"))
    assert not model.change[:, [RUN, JUMP]][[STOP, WALK]].any()
    assert model.change[WALK, STOP].sum() > 0.0


def test_no_traces_and_no_behaviours_are_refused():
    with pytest.raises(InputError, match="no traces"):
        learned([], TASK, ALL)
    with pytest.raises(InputError, match="no frame shows any behaviour"):
        learned([made_up(100)], TASK, ())


def likelihood(model: PlayerModel, trace: Trace) -> float:
    """Mean logarithm of the probability of each step of a trace; a jump between two bins counts for both."""
    before, after, jump = changes(trace)
    place = jump * (model.heading_bins / (2.0 * np.pi))
    low = np.floor(place).astype(int)
    share = place - low
    known = model.change[before, after]
    steps = np.arange(len(jump))
    seen = (1.0 - share) * (share < 1.0 - 1e-9), share * (share > 1e-9)
    chances = known[steps, low % model.heading_bins], known[steps, (low + 1) % model.heading_bins]
    return float((xlogy(seen[0], chances[0]) + xlogy(seen[1], chances[1])).mean())


def guess(hazard: float) -> PlayerModel:
    """A player who changes so often, to anything alike: persistent for no hazard, uniform for 1."""
    cells = 4 * TASK.heading_bins
    change = np.full((4, 4, TASK.heading_bins), hazard / cells)
    change[np.arange(4), np.arange(4), 0] += 1.0 - hazard
    return PlayerModel(ALL, change)


@needs_traces
def test_a_player_left_out_is_foretold_better_than_by_a_persistent_or_a_uniform_player():
    traces = [read_trace(path) for path in sorted(TRACES.glob("*.csv"))]
    for left_out in traces:
        model = learned([trace for trace in traces if trace is not left_out], TASK, ALL)
        own = likelihood(model, left_out)
        steps = changes(left_out)
        hazard = float(np.mean((steps[0] != steps[1]) | (np.abs(steps[2]) > 1e-9)))
        # even a persistent player who is given the very hazard of the one left out foretells less
        assert own > likelihood(guess(hazard), left_out) + 0.2
        assert own > likelihood(guess(1.0), left_out) + 1.0
        assert likelihood(guess(0.0), left_out) == -math.inf
