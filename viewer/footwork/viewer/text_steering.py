"""Steering where a key's going up is not told: a key sets what goes on until another one changes it."""

import math

from footwork.protocol import messages as m

HELP = "w walk  s stop  a/d turn left/right  r run on/off  space jump  1-9 states  q end"
FIGHT_HELP = "w step nearer  s stand  a/d turn the way to step left/right  j attack  k evade  q end"
_FIGHT_KEYS = {"j": "attack", "k": "evade"}
_TURN = math.radians(30.0)
_KEYED = ("stop", "walk", "run")


class TextSteering:
    """What the player asked for so far.

    Attributes:
        ended: whether the player has had enough.
    """

    def __init__(self) -> None:
        self.ended = False
        self._yaw = 0.0
        self._moving = self._running = self._jump = False
        self._state = ""

    def take(self, typed: str, welcome: m.Welcome) -> bool:
        """Take typed keys; whether they change what is asked for."""
        self._jump, self._state = False, ""
        for key in typed.lower():
            self._take_key(key, welcome)
        return bool(typed)

    def _take_key(self, key: str, welcome: m.Welcome) -> None:
        states = [name for name in welcome.behaviours if name not in _KEYED]
        if key in "ws":
            self._moving = key == "w"
        elif key in "ad":
            self._yaw += _TURN if key == "a" else -_TURN
        elif key == "r":
            self._running = not self._running
        elif key == " ":
            self._jump = True
        elif key in "123456789" and int(key) <= len(states):
            self._state = states[int(key) - 1]
        elif key in _FIGHT_KEYS and welcome.opponent:
            self._state = _FIGHT_KEYS[key]
        elif key == "q":
            self.ended = True

    def wanted(self, ahead: float = 0.0) -> m.Keys | tuple[float, str]:
        """Held keys, or a heading and a state, of one who began looking along the yaw ``ahead``."""
        yaw = ahead + self._yaw
        if self._state:
            return yaw, self._state
        return m.Keys(view_yaw=yaw, forward=int(self._moving), run=self._running, jump=self._jump)
