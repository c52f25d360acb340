"""The policy table: the worth of every node under every command, looked ahead from at run time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_shape
from footwork.motion.task import SteeringTask


@dataclass(frozen=True, eq=False)
class PolicyTable:
    """Values V(node, behaviour, relative heading) of a steering task, and how they were found.

    Args:
        task: the axes, the reward and the discount.
        values: discounted reward to come.  # (N, B, H)
        residual: the largest change of any value in the last sweep.
        sweeps: how many sweeps were made.
        converged: whether the residual came under the tolerance.

    Raises:
        InputError: for values of the wrong shape or that are not finite.
    """

    task: SteeringTask
    values: NDArray[np.float32]
    residual: float
    sweeps: int
    converged: bool
    where: str = "policy table"

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", frozen(self.values, np.float32))
        require_shape(self.values, (None, len(self.task.behaviours), self.task.heading_bins), "values", self.where)
        require_finite(self.values, "values", self.where)

    def require_converged(self) -> "PolicyTable":
        """The table itself.

        Raises:
            InputError: for a table whose solver stopped before it converged.
        """
        if not self.converged:
            raise InputError(f"not converged: residual {self.residual:g} after {self.sweeps} sweeps", self.where)
        return self
