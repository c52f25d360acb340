"""Two agents that choose at random: python examples/random_fighters.py BUNDLE [ROUNDS]

BUNDLE is one that fighters can fight on, as of ``footwork build --graph annotated --machine examples/fighting.toml``.
Needs the extra ``rl``: pip install footwork[rl]
"""

import sys

from footwork.motion.bundle import read_bundle
from footwork.runtime.match import fight_ground
from footwork.study.fight_env import FightEnv


def main(bundle: str, rounds: int = 20) -> None:
    env = FightEnv(fight_ground(read_bundle(bundle)))
    for number, agent in enumerate(env.possible_agents):
        env.action_space(agent).seed(number)
    total = dict.fromkeys(env.possible_agents, 0.0)
    for number in range(rounds):
        env.reset(seed=number)
        while env.agents:
            actions = {agent: int(env.action_space(agent).sample()) for agent in env.agents}
            for agent, reward in env.step(actions)[1].items():
                total[agent] += reward
    print("rewards a round:", {agent: round(reward / rounds, 2) for agent, reward in total.items()})


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:3]))
