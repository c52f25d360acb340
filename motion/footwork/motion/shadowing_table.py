"""The shadowing table: the cost to come of every segment's end, by where the opponent is seen from there."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.annotation import Annotation
from footwork.motion.arrays import frozen, require_finite, require_range, require_shape
from footwork.motion.shadowing_task import ShadowingTask


@dataclass(frozen=True, eq=False)
class ShadowingTable:
    """Discounted cost to come at the ends of the R segments of one state, and how it was found.

    Args:
        task: cost and axes.
        state: the number of the state whose transitions are chosen among.
        values: by segment of that state, ascending, distance and bearing.  # (R, D, P) float32
        residual: the largest change of any value by one more backup.
        sweeps: how many sweeps were made.
        converged: whether the residual came under the tolerance.

    Raises:
        InputError: for values of the wrong shape or that are not finite.
    """

    task: ShadowingTask
    state: int
    values: NDArray[np.float32]
    residual: float
    sweeps: int
    converged: bool
    where: str = "shadowing table"

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", frozen(self.values, np.float32))
        shape = None, self.task.distance_bins, self.task.bearing_bins
        require_shape(self.values, shape, "values", self.where)
        require_finite(self.values, "values", self.where)

    @property
    def nbytes(self) -> int:
        """What the values take."""
        return self.values.nbytes

    @property
    def error_bound(self) -> float:
        """How far from the true values any of these can be: residual / (1 - discount)."""
        return self.residual / (1.0 - self.task.discount)

    def require_converged(self) -> "ShadowingTable":
        """The table itself.

        Raises:
            InputError: for a table whose solver stopped before it converged.
        """
        if not self.converged:
            raise InputError(f"not converged: residual {self.residual:g} after {self.sweeps} sweeps", self.where)
        return self

    def require_fits(self, annotation: Annotation) -> None:
        """Raise InputError unless these are values of the segments of one of an annotation's states."""
        states = len(annotation.machine.states)
        require_range(np.array([self.state]), 0, states, "state", self.where)
        segments = len(annotation.of_state(self.state))
        if len(self.values) != segments:
            name = annotation.machine.names[self.state]
            raise InputError(f"values of {len(self.values)} segments, {name!r} has {segments}", self.where)
