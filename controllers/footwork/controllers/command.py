"""Commands: from held keys, or heading and behaviour outright, to what a controller is asked for."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from footwork.errors import InputError
from footwork.motion.keys import behaviour_of_keys, heading_of_keys
from footwork.motion.requests import ANY_SPEED
from footwork.motion.task import ONE_SHOT

NONE = -1


class UnknownSpeed(InputError):  # noqa: N818  (it reads as what happened)
    """A speed was asked for of a behaviour that takes none; the message lists those that do."""


class UnknownBehaviour(InputError):  # noqa: N818  (it reads as what happened)
    """A behaviour was asked for that the bundle lacks; the message lists those it has."""


@dataclass(frozen=True, slots=True)
class Command:
    """What a character shall do from now on.

    Args:
        heading: wanted yaw in the world, radians.
        behaviour: index of the behaviour to go on with, -1 to go on as before.
        one_shot: index of a behaviour to do once, such as a jump, -1 for none.
        speed: that of the behaviour to go on with, m/s, None where any will do.
    """

    heading: float
    behaviour: int
    one_shot: int = NONE
    speed: float | None = None

    @property
    def asked_speed(self) -> float:
        """The speed as arrays hold it."""
        return ANY_SPEED if self.speed is None else self.speed


class Vocabulary:
    """Reads commands for one bundle.

    Args:
        behaviours: all that commands number, in order (``MotionGraph.behaviours``).
        present: those that some frame shows (``SteeringController.present``).
        speeds: the slowest and the fastest, m/s, of those that take a speed (``SteeringController.speeds``).
        one_shot: those that are done once when they are asked for (``SteeringController.one_shot``).
        rest: what held keys ask for where they would ask for one that no frame shows; refused where empty.
    """

    def __init__(
        self,
        behaviours: tuple[str, ...],
        present: Collection[str],
        speeds: Mapping[str, tuple[float, float]] = MappingProxyType({}),
        *,
        one_shot: Sequence[str] = ONE_SHOT,
        rest: str = "",
    ) -> None:
        self._one_shot, self._rest = frozenset(one_shot), rest
        self.present = tuple(name for name in behaviours if name in present)
        self.with_speed = tuple(name for name in self.present if name in speeds)
        self._usual = {name: 0.5 * sum(speeds[name]) for name in self.with_speed}
        self._index = {name: index for index, name in enumerate(behaviours) if name in present}
        self._numbers = {NONE, *self._index.values()}

    def index(self, behaviour: str) -> int:
        """The number of a behaviour.

        Raises:
            UnknownBehaviour: for one that no frame shows.
        """
        try:
            return self._index[behaviour]
        except KeyError:
            raise UnknownBehaviour(f"no behaviour {behaviour!r}, it has {', '.join(self.present)}", "command") from None

    def require(self, command: Command) -> None:
        """Refuse a command that the bundle cannot follow.

        Raises:
            UnknownBehaviour: for a behaviour that no frame shows.
            InputError: for a heading that is not finite, or a speed that is below 0 or not finite.
        """
        if command.behaviour not in self._numbers or command.one_shot not in self._numbers:
            problem = f"behaviours {command.behaviour} and {command.one_shot}, expected among {sorted(self._numbers)}"
            raise UnknownBehaviour(problem, "command")
        _require_finite(command.heading, "heading")
        if command.speed is not None:
            _require_speed(command.speed)

    def of_keys(self, view_yaw: float, forward: float, strafe: float, run: bool, one_shot: str = "") -> Command:
        """The command of held keys; ``one_shot`` names the behaviour whose key is held, such as jump.

        Behaviours that take a speed are asked for at the middle of theirs.

        Raises:
            UnknownBehaviour: for a behaviour that no frame shows.
            InputError: for a view yaw that is not finite.
        """
        _require_finite(view_yaw, "view_yaw")
        once = self.index(one_shot) if one_shot else NONE
        lasting = behaviour_of_keys(forward, strafe, run, self.present)
        lasting = lasting if lasting in self._index else self._rest or lasting
        heading = float(heading_of_keys(view_yaw, forward, strafe))
        return Command(heading, self.index(lasting), once, self._usual.get(lasting))

    def outright(self, heading: float, behaviour: str, speed: float | None = None) -> Command:
        """The command for a heading and a behaviour, at a speed in m/s where one is given.

        One-shot behaviours leave the lasting one as it is. Speeds beyond those that can be asked for come to the
        nearest one that can.

        Raises:
            UnknownBehaviour: for a behaviour that no frame shows.
            UnknownSpeed: for a speed of a behaviour that takes none.
            InputError: for a heading that is not finite, or a speed that is below 0 or not finite.
        """
        _require_finite(heading, "heading")
        index = self.index(behaviour)
        if speed is not None:
            self._check_speed(behaviour, speed)
        return Command(heading, NONE, index) if behaviour in self._one_shot else Command(heading, index, speed=speed)

    def _check_speed(self, behaviour: str, speed: float) -> None:
        _require_speed(speed)
        if behaviour not in self.with_speed:
            takers = ", ".join(self.with_speed) or "none"
            raise UnknownSpeed(f"{behaviour!r} takes no speed, of its behaviours {takers} do", "command")


def _require_finite(value: float, name: str) -> None:
    if not math.isfinite(value):
        raise InputError(f"{name} is {value}, expected a finite number of radians", "command")


def _require_speed(speed: float) -> None:
    if not 0.0 <= speed < math.inf:
        raise InputError(f"speed is {speed}, expected a finite number of m/s from 0 on", "command")
