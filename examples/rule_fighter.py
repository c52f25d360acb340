"""An agent with three rules against one that chooses at random: python examples/rule_fighter.py BUNDLE [ROUNDS]

Near by it attacks while it has the breath for it, and evades attacks from close by while it has not; else it shadows.
See random_fighters.py for what it needs.
"""

import sys
from collections.abc import Mapping

import numpy as np

from footwork.controllers.activity import ACTIVITIES
from footwork.motion.bundle import read_bundle
from footwork.runtime.match import fight_ground
from footwork.study.fight_env import FAR, FIGHTERS, OBSERVED, FightEnv

NEAR, CLOSE = 1.6, 0.7  # metres
BREATH = 0.2
SHADOW, ATTACK, EVADE = map(ACTIVITIES.index, ("shadow", "attack", "evade"))


def by_rules(observation: np.ndarray) -> int:
    seen = dict(zip(OBSERVED, observation.tolist(), strict=True))
    distance = seen["distance"] * FAR
    if distance < NEAR and seen["stamina"] > BREATH:
        return ATTACK
    return EVADE if distance < CLOSE and seen["opponent_attack"] else SHADOW


def play(env: FightEnv, seed: int, random: np.random.Generator) -> Mapping[str, float]:
    """The rewards of a round."""
    observations, _ = env.reset(seed=seed)
    total: dict[str, float] = dict.fromkeys(FIGHTERS, 0.0)
    while env.agents:
        actions = {FIGHTERS[0]: by_rules(observations[FIGHTERS[0]]), FIGHTERS[1]: int(random.integers(len(ACTIVITIES)))}
        observations, rewards, *_ = env.step(actions)
        total = {agent: total[agent] + rewards[agent] for agent in FIGHTERS}
    return total


def main(bundle: str, rounds: int = 20) -> None:
    env, random = FightEnv(fight_ground(read_bundle(bundle))), np.random.default_rng(0)
    mine = [play(env, seed, random)[FIGHTERS[0]] for seed in range(rounds)]
    print(f"won {sum(reward > 0.0 for reward in mine)} of {rounds} rounds, {np.mean(mine):+.2f} a round")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:3]))
