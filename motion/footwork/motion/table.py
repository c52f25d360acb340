"""The policy table: the worth of every node under every command, looked ahead from at run time."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.coded_values import CodedValues, quantised
from footwork.motion.player_model import PlayerModel
from footwork.motion.task import SteeringTask


@dataclass(frozen=True, eq=False)
class PolicyTable:
    """Values of a steering task over (node, behaviour, relative heading), and how they were found.

    They are of commands asked for now, when it is not known yet what the next tick asks for: W = P V, where V is the
    worth of a node under a command and P the player model. For a player who never changes their mind W is V.

    Args:
        task: the axes, the reward, the actions and the discount.
        coded: discounted reward to come, as it is or in sixteen bits.  # (N, B, H)
        residual: the largest change of any of these values by one more backup, or a bound of it.
        sweeps: how many sweeps were made.
        converged: whether the residual came under the tolerance before values were rounded to sixteen bits.
        player: how commands were taken to change from tick to tick; None for never.

    Raises:
        InputError: for values of the wrong shape or that are not finite, or a player model of other axes.
    """

    task: SteeringTask
    coded: CodedValues
    residual: float
    sweeps: int
    converged: bool
    player: PlayerModel | None = None
    where: str = "policy table"

    def __post_init__(self) -> None:
        checked = self.coded.checked(len(self.task.behaviours), self.task.heading_bins, self.where)
        object.__setattr__(self, "coded", checked)
        if self.player is not None:
            require_axes(self.player, self.task)

    @property
    def values(self) -> NDArray[np.float32]:
        """Discounted reward to come; made anew each time where it is kept in sixteen bits.  # (N, B, H)"""
        return self.coded.values

    @property
    def compact(self) -> "PolicyTable":
        """The same policy in sixteen bits; a backup doubles an error at most, so that bounds the residual."""
        coded = quantised(self.values)
        return replace(self, coded=coded, residual=self.residual + float(coded.step.max(initial=0.0)))

    @property
    def error_bound(self) -> float:
        """How far from the true values any of these can be: residual / (1 - discount)."""
        return self.residual / (1.0 - self.task.discount)

    def require_converged(self) -> "PolicyTable":
        """The table itself.

        Raises:
            InputError: for a table whose solver stopped before it converged.
        """
        if not self.converged:
            raise InputError(f"not converged: residual {self.residual:g} after {self.sweeps} sweeps", self.where)
        return self


def require_axes(player: PlayerModel, task: SteeringTask) -> None:
    """Raise InputError unless a player model has the behaviours and headings of a task."""
    if player.behaviours != task.behaviours:
        problem = f"behaviours {', '.join(player.behaviours)}, the task has {', '.join(task.behaviours)}"
        raise InputError(problem, player.where)
    if player.heading_bins != task.heading_bins:
        raise InputError(f"{player.heading_bins} heading bins, the task has {task.heading_bins}", player.where)
