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
        waiting: room for a queue of nodes.  # (N + 1,)
        stands: which nodes are in ``waiting``: none, and so again at the end.  # (N,)
    """
    label, budget, into, source = paths.label, paths.budget, edges.into, edges.source
    looked = 0
    for node in nodes:
        looked += into[node + 1] - into[node]
        for at in range(into[node], into[node + 1]):
            if edges.kept[source[at]]:
                label[node] = min(label[node], label[source[at]] + edges.cost[at])
    first = last = 0
    for node in nodes:
        wanted = label[node] - shift
        if wanted > budget[node]:
            # between kept nodes searches go freely, so that only nodes not kept need to be allowed to lead here
            last = _allow_before(node, int(wanted), False, edges, paths, shift, waiting, stands, last)
            looked += into[node + 1] - into[node]
    # first come, first served: budgets that rise again would rise far more often the other way round
    while first != last:
        node = waiting[first]
        first, stands[node] = (first + 1) % len(waiting), 0
        last = _allow_before(node, int(budget[node]), True, edges, paths, shift, waiting, stands, last)
        looked += into[node + 1] - into[node]
    return int(looked)


@numba.njit(cache=True, nogil=True)
def _allow_before(
    node: int,
    wanted: int,
    leave: bool,
    edges: KeptEdges,
    paths: Paths,
    shift: int,
    waiting: NDArray,
    stands: NDArray,
    last: int,
) -> int:
    """Raise the budgets of the nodes before one; with ``leave`` those of kept nodes, too. Where the queue ends now."""
    label, budget, unknown = paths.label, paths.budget, paths.unknown[0]
    for at in range(edges.into[node], edges.into[node + 1]):
        before = edges.source[at]
        if edges.kept[before] and not leave:
            continue
        # what no path is known to reach has no bound, nor has what leads there: so that none rises twice
        room = unknown if wanted > unknown // 2 else wanted - edges.far[edges.cost[at]]
        if label[before] < unknown:
            room = min(room, label[before] - shift)  # no budget needs to be above its node's label
        if room <= budget[before]:
            continue
        budget[before] = room
        if not edges.kept[before] and not stands[before]:
            waiting[last], stands[before] = before, 1
            last = (last + 1) % len(waiting)
    return last
