"""The policy table: the worth of every node under every command, looked ahead from at run time."""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_shape
from footwork.motion.coded_values import CodedValues, quantised
from footwork.motion.player_model import PlayerModel
from footwork.motion.task import SteeringTask

SHORTLIST_KINDS = np.uint8, np.uint16


@dataclass(frozen=True, eq=False)
class PolicyTable:
    """Values of a steering task over (node, request, relative heading), and how they were found.

    They are of commands asked for now, when it is not known yet what the next tick asks for: W = P V, where V is the
    worth of a node under a command and P the player model. For a player who never changes their mind W is V.

    Args:
        task: the axes, the reward, the actions and the discount.
        coded: discounted reward to come, as it is or in sixteen bits.  # (N, Q, H)
        residual: the largest change of any of these values by one more backup, or a bound of it.
        sweeps: how many sweeps were made.
        converged: whether the residual came under the tolerance before values were rounded to sixteen bits.
        player: how commands were taken to change from tick to tick; None for never.
        shortlist: the number of every state's best action (``lookahead.best_action``); empty where controllers shall
            look at all.  # (N, Q, H) or (N, Q, 0)

    Raises:
        InputError: for values of the wrong shape or that are not finite, a shortlist of the wrong shape or kind, or a
            player model of other axes.
    """

    task: SteeringTask
    coded: CodedValues
    residual: float
    sweeps: int
    converged: bool
    player: PlayerModel | None = None
    shortlist: NDArray[np.unsignedinteger] = field(default_factory=lambda: np.zeros((0, 0, 0), np.uint8))
    where: str = "policy table"

    def __post_init__(self) -> None:
        checked = self.coded.checked(len(self.task.requests.behaviour), self.task.heading_bins, self.where)
        object.__setattr__(self, "coded", checked)
        object.__setattr__(self, "shortlist", self._checked_shortlist())
        if self.player is not None:
            require_axes(self.player, self.task)

    def _checked_shortlist(self) -> NDArray[np.unsignedinteger]:
        listed, states = self.shortlist, self.coded.codes.shape
        if listed.dtype not in SHORTLIST_KINDS:
            kinds = ", ".join(str(np.dtype(kind)) for kind in SHORTLIST_KINDS)
            raise InputError(f"the shortlist holds {listed.dtype}, expected one of {kinds}", self.where)
        if not listed.size:
            return frozen(np.zeros((*states[:2], 0), listed.dtype), listed.dtype)
        require_shape(listed, states, "shortlist", self.where)
        return frozen(listed, listed.dtype)

    @property
    def unlisted(self) -> "PolicyTable":
        """The same values without a shortlist."""
        return replace(self, shortlist=self.shortlist[..., :0])

    @property
    def nbytes(self) -> int:
        """What values and shortlist take."""
        return self.coded.nbytes + self.shortlist.nbytes

    @property
    def values(self) -> NDArray[np.float32]:
        """Discounted reward to come; made anew each time where it is kept in sixteen bits.  # (N, Q, H)"""
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


def shortlisted(best: NDArray[np.integer]) -> NDArray[np.unsignedinteger]:
    """Best actions (N, Q, H) in as few bits as hold them, and none (N, Q, 0) where a shortlist cannot."""
    kind = next((kind for kind in SHORTLIST_KINDS if best.max(initial=0) <= np.iinfo(kind).max), None)
    return best[..., :0].astype(np.uint8) if kind is None else best.astype(kind)
