"""What steering looks things up in, as one tuple that kernels take whole."""

from typing import NamedTuple

from numpy.typing import NDArray

from footwork.motion.actions import Actions
from footwork.motion.coded_values import CodedValues
from footwork.motion.requests import Requests


class Policy(NamedTuple):
    """All that ``steer`` looks things up in; none of it changes.

    Args:
        actions: of the graph and the task.
        coded: PolicyTable.coded.
        shortlist: PolicyTable.shortlist.
        requests: SteeringTask.requests.
        onward: ``onward_edges``.  # (N,)
        segment_ticks: SteeringTask.segment_ticks.
        exact: whether turns may lie between the levels.
        pivot: what characters turn about on arriving at each node.  # (N, 2)
        displacement: of the graph, and so is ``natural``.  # (E, 3)
        natural: which edges the capture goes along.  # (E,)
    """

    actions: Actions
    coded: CodedValues
    shortlist: NDArray
    requests: Requests
    onward: NDArray
    segment_ticks: int
    exact: bool
    pivot: NDArray
    displacement: NDArray
    natural: NDArray
