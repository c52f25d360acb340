"""Budgets of one stream of searches after another stream has kept nodes.

A node kept since is one more that best paths may want to reach, and edges to it are cheaper. A stream's own searches
find only nodes within their budgets, which therefore stay bounds; another's may lie beyond them. For these every node
before them is allowed the label with which it could still be on a best path to them, and so on backwards as far as
budgets rise.
"""

import numba
from numpy.typing import NDArray

from footwork.training.best_paths import Paths
from footwork.training.kept_edges import KeptEdges


@numba.njit(cache=True, nogil=True)
def allow(nodes: NDArray, edges: KeptEdges, paths: Paths, shift: int, waiting: NDArray, stands: NDArray) -> int:
    """Raise budgets so that they bound those of the next search; returns how many edges were looked at.

    Labels of nodes kept by another stream are bounded over kept nodes; the path that the other stream found to them is
    one such way, from a node kept before.

    Args:
        nodes: those that the other stream found, kept by now, each behind the ones before it on its path.
        edges: the graph.
        paths: labels of this stream's last search, and budgets; both are changed.
        shift: that search's.
        waiting: room for nodes.  # (N,)
        stands: which nodes are in ``waiting``: none, and so again at the end.  # (N,)
    """
    label, budget, into, source = paths.label, paths.budget, edges.into, edges.source
    looked = 0
    for node in nodes:
        looked += into[node + 1] - into[node]
        for at in range(into[node], into[node + 1]):
            if edges.kept[source[at]]:
                label[node] = min(label[node], label[source[at]] + edges.cost[at])
    for node in nodes:
        wanted = label[node] - shift
        if wanted <= budget[node]:
            continue
        # between kept nodes searches go freely, so that only nodes not kept need to be allowed to lead here
        count = _allow_before(node, int(wanted), False, edges, label, budget, shift, waiting, stands, 0)
        looked += into[node + 1] - into[node]
        while count > 0:
            count -= 1
            behind = waiting[count]
            stands[behind] = 0
            count = _allow_before(behind, int(budget[behind]), True, edges, label, budget, shift, waiting, stands, count)
            looked += into[behind + 1] - into[behind]
    return int(looked)


@numba.njit(cache=True, nogil=True)
def _allow_before(
    node: int,
    wanted: int,
    leave: bool,
    edges: KeptEdges,
    label: NDArray,
    budget: NDArray,
    shift: int,
    waiting: NDArray,
    stands: NDArray,
    count: int,
) -> int:
    """Raise the budgets of the nodes before one; with ``leave`` those of kept nodes, too. How many wait now."""
    for at in range(edges.into[node], edges.into[node + 1]):
        before = edges.source[at]
        if edges.kept[before] and not leave:
            continue
        # no budget needs to be above its node's label
        room = min(wanted - edges.far[edges.cost[at]], label[before] - shift)
        if room <= budget[before]:
            continue
        budget[before] = room
        if not edges.kept[before] and not stands[before]:
            waiting[count], stands[before] = before, 1
            count += 1
    return count
