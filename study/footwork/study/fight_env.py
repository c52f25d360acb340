"""A match as an environment for agents that learn: PettingZoo's parallel kind, two fighters at once (extra ``rl``).

It is the very match that ``footwork fight`` plays: an agent takes the supervisor's place and lets its fighter shadow,
attack or evade; how that is done is decided by look-ahead on the motion graph as ever.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Box, Discrete, Space
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from footwork.controllers.activity import ACTIVITIES
from footwork.controllers.fighting_style import STYLES, FightingStyle
from footwork.motion.tick import TICK_RATE
from footwork.runtime.match import FightGround, Match, table_of
from footwork.runtime.match_rules import MatchRules

FIGHTERS = ("fighter_0", "fighter_1")
FAR = 10.0
"""Metres; opponents further off are observed at this distance."""
OBSERVED = (
    "distance",
    "bearing_sine",
    "bearing_cosine",
    "facing_sine",
    "facing_cosine",
    "health",
    "stamina",
    "opponent_health",
    "opponent_stamina",
    *(f"own_{name}" for name in ACTIVITIES),
    *(f"opponent_{name}" for name in ACTIVITIES),
    "time_left",
)
"""What an agent sees of the match, by place in its observation: the distance as a part of ``FAR``, the bearing
of the opponent and its facing as seen from the fighter, what both have left and are doing, and the part of the round
still to come."""
_DOES = np.eye(len(ACTIVITIES)).tolist()
WON = 1.0
"""The reward of a round won; the opponent gets as much less than none."""


class FightEnv(ParallelEnv[str, NDArray[np.float32], Any]):
    """One round of two fighters.

    Actions are activities, by number in ``ACTIVITIES``. One that cannot begin yet, as the fighter is in the middle of
    something, out of breath or has no way to, is tried again until another is chosen; it shadows meanwhile. Rewards are
    the damage dealt less the damage taken since the last step, where a full health is 1, and ``WON`` for the round.
    The same seed and actions give the same observations.

    Args:
        ground: what matches on the bundle share (``runtime.match.fight_ground``).
        ticks: that an action holds, each 1/30 s.
        rules: of the match; a round takes ``round_seconds`` at most.
        style: the numbers by which both carry their activities out.
    """

    def __init__(
        self,
        ground: FightGround,
        *,
        ticks: int = 6,
        rules: MatchRules | None = None,
        style: FightingStyle | None = None,
    ) -> None:
        if ticks < 1:
            raise ValueError(f"{ticks} ticks, expected 1 or more")
        self._ground, self._ticks = ground, ticks
        self._rules, self._style = rules or MatchRules(), style or STYLES["balanced"]
        self._shadowing, self._seeds = table_of(ground.bundle), np.random.default_rng()
        low = np.array([-1.0 if name.endswith(("sine", "cosine")) else 0.0 for name in OBSERVED], np.float32)
        self.metadata = {"name": "footwork_fight_v0", "render_modes": []}
        self.observation_spaces = {name: Box(low, np.ones_like(low)) for name in FIGHTERS}
        self.action_spaces = {name: Discrete(len(ACTIVITIES)) for name in FIGHTERS}
        self.possible_agents = list(FIGHTERS)
        self.agents: list[str] = []
        self.render_mode = None

    def observation_space(self, agent: str) -> Space[NDArray[np.float32]]:
        """Numbers of OBSERVED, each within -1..1 or 0..1."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Space[Any]:
        """An activity."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, NDArray[np.float32]], dict[str, dict[str, Any]]]:
        """Begin a round; ``seed`` says which, and which come after it."""
        if seed is not None:
            self._seeds = np.random.default_rng(seed)
        styles = self._style, self._style
        self._match = Match(
            self._ground,
            styles,
            int(self._seeds.integers(1 << 31)),
            rules=self._rules,
            shadowing=self._shadowing,
            inertialise=False,
            foot_lock=False,
        )
        self.agents = list(FIGHTERS)
        self._dealt = np.zeros(2)
        return self._observations(), {name: {} for name in FIGHTERS}

    def step(
        self, actions: dict[str, int]
    ) -> tuple[
        dict[str, NDArray[np.float32]],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        """Let both do what they are told for some ticks.

        Returns:
            Observations, rewards, whether the round was decided, whether its time was up, and nothing more, by agent.
        """
        if not self.agents:
            return {}, {}, {}, {}, {}
        for who, name in enumerate(FIGHTERS):
            self._match.choose(who, activity=ACTIVITIES[actions[name]])
        left = round(self._rules.round_seconds * TICK_RATE) - self._match.tick
        self._match.play(min(self._ticks, left))
        tally = self._match.tally
        over = int(tally.clock["rounds"][0]) > 0
        beaten = over and self._match.tick < round(self._rules.round_seconds * TICK_RATE)
        observations, rewards = self._observations(), self._rewards()
        if over:
            self.agents = []
        return (
            observations,
            rewards,
            dict.fromkeys(FIGHTERS, beaten),
            dict.fromkeys(FIGHTERS, over and not beaten),
            {name: {} for name in FIGHTERS},
        )

    def _rewards(self) -> dict[str, float]:
        """What came since they were asked for last."""
        of = self._match.tally.of
        gained = of["dealt"] - self._dealt
        won = of["rounds"].astype(np.float64) * WON
        self._dealt = of["dealt"].copy()
        each = gained + won
        return {name: float(each[who] - each[1 - who]) for who, name in enumerate(FIGHTERS)}

    def _observations(self) -> dict[str, NDArray[np.float32]]:
        match = self._match
        places, doing = match.world.place.tolist(), match.fighters["activity"].tolist()
        strength = list(zip(match.health.tolist(), match.stamina.tolist(), strict=True))
        left = _part(1.0 - match.tick / (self._rules.round_seconds * TICK_RATE))
        found = {}
        for who, name in enumerate(FIGHTERS):
            other = 1 - who
            numbers = [*_relative(places[who], places[other]), *map(_part, strength[who] + strength[other])]
            found[name] = np.array([*numbers, *_DOES[doing[who]], *_DOES[doing[other]], left], np.float32)
        return found


def _relative(own: Sequence[float], other: Sequence[float]) -> tuple[float, ...]:
    """The distance, and sine and cosine of the bearing and of the facing, of one place seen from another."""
    dx, dz, turn = other[0] - own[0], other[1] - own[1], other[2] - own[2]
    distance, bearing = math.hypot(dx, dz), math.atan2(dx, dz) - own[2]
    return min(distance / FAR, 1.0), math.sin(bearing), math.cos(bearing), math.sin(turn), math.cos(turn)


def _part(value: float) -> float:
    """Within 0..1."""
    return min(max(value, 0.0), 1.0)
