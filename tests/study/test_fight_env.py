"""The environment for agents that learn: PettingZoo's own tests, and what its numbers mean."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pettingzoo.test import parallel_api_test, parallel_seed_test

from footwork.cli.motions import embedded_dataset
from footwork.controllers.activity import ACTIVITIES
from footwork.motion.state_machine import StateMachine, read_state_machine
from footwork.runtime.match import fight_ground
from footwork.runtime.match_rules import MatchRules
from footwork.study.fight_env import FIGHTERS, OBSERVED, WON, FightEnv
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

PUBLISHED = read_state_machine(Path(__file__).resolve().parents[2] / "examples" / "fighting.toml")
MACHINE = StateMachine(tuple(replace(state, shadowing=False) for state in PUBLISHED.states))
SHADOW, ATTACK, EVADE = range(len(ACTIVITIES))


@pytest.fixture(scope="module")
def ground():
    options = GraphOptions(graph="annotated")
    return fight_ground(build_bundle(embedded_dataset("fighting"), options, machine=MACHINE)[0])


def test_pettingzoos_own_test_passes(ground):
    parallel_api_test(FightEnv(ground), num_cycles=400)


def test_pettingzoos_seed_test_passes(ground):
    parallel_seed_test(lambda: FightEnv(ground), num_cycles=60)


def played(env, actions, steps=1000):
    """Rewards and observations until the round is over."""
    rewards, seen = [], []
    for _ in range(steps):
        observations, reward, beaten, timed_out, _ = env.step(dict(zip(FIGHTERS, actions, strict=True)))
        rewards.append([reward[name] for name in FIGHTERS])
        seen.append(observations[FIGHTERS[0]])
        if not env.agents:
            return np.array(rewards), np.array(seen), beaten[FIGHTERS[0]], timed_out[FIGHTERS[0]]
    raise AssertionError("the round does not end")


def test_who_attacks_one_that_does_not_wins_and_is_rewarded_for_it(ground):
    env = FightEnv(ground)
    env.reset(seed=4)
    rewards, seen, beaten, timed_out = played(env, (ATTACK, SHADOW))
    assert (beaten, timed_out) == (True, False)
    np.testing.assert_allclose(rewards.sum(axis=1), 0.0, atol=1e-9)
    assert rewards[:, 0].sum() == pytest.approx(1.0 + WON, abs=0.15)  # all of its health, a blow beyond it perhaps
    assert seen[:-1, OBSERVED.index("opponent_health")].min() < 0.5
    assert (seen[:, OBSERVED.index("own_attack")] == 1.0).any()
    assert (seen[:, OBSERVED.index("opponent_shadow")] == 1.0).all()


def test_a_round_that_nobody_wins_is_cut_off_when_its_time_is_up(ground):
    env = FightEnv(ground, rules=MatchRules(round_seconds=2.0), ticks=7)
    env.reset(seed=1)
    rewards, seen, beaten, timed_out = played(env, (SHADOW, SHADOW))
    assert (beaten, timed_out, len(rewards)) == (False, True, 9)
    assert not rewards.any()
    assert (np.diff(seen[:, OBSERVED.index("time_left")]) < 0.0).all()
    assert env.step({}) == ({}, {}, {}, {}, {})


def test_each_sees_the_other(ground):
    env = FightEnv(ground)
    observations, _ = env.reset(seed=2)
    first, second = (dict(zip(OBSERVED, observations[name], strict=True)) for name in FIGHTERS)
    assert first["distance"] == second["distance"] == pytest.approx(0.2)
    for own in (first, second):  # face to face
        assert own["bearing_cosine"] == pytest.approx(1.0, abs=1e-5)
        assert own["facing_cosine"] == pytest.approx(-1.0, abs=1e-5)
        assert own["time_left"] == own["health"] == own["opponent_stamina"] == 1.0


def test_rounds_differ_unless_they_have_a_seed(ground):
    env = FightEnv(ground)
    ends = []
    for seed in (7, None, 7, None):
        env.reset(seed=seed)
        steps = [env.step(dict.fromkeys(FIGHTERS, SHADOW))[0] for _ in range(10)]
        ends.append(steps[-1][FIGHTERS[0]])
    np.testing.assert_array_equal(ends[0], ends[2])
    np.testing.assert_array_equal(ends[1], ends[3])
    assert (ends[0] != ends[1]).any()


def test_an_action_holds_for_a_tick_at_least(ground):
    with pytest.raises(ValueError, match="0 ticks, expected 1 or more"):
        FightEnv(ground, ticks=0)
