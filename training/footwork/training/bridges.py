"""Bridges: from every frame a way at once to every other behaviour, however unlike the frames are.

A threshold leaves a character waiting for a good moment to do what it is told. A rare poor transition costs one tick of
smoothness and may win a second of control (McCann and Pollard 2007 found that leaving them out lowers the total), so
each frame gets edges to the least unlike captured frames of the other behaviours; the policy decides which to take.
"""

from collections.abc import Callable
from dataclasses import replace

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.graph_windows import NONE, GraphWindows, composed
from footwork.motion.metric import UNIT, align_windows
from footwork.motion.task import ONE_SHOT
from footwork.motion.window import RADIUS, window_weights
from footwork.training.standard_graph import moved, relative
from footwork.training.transitions import MIN_GAP

STAY = 9
"""A bridge leads to frames whose motion goes on in their behaviour for so many ticks, 0.3 s (convention)."""
NEAR_GROUND = 5
"""A jump is entered so many ticks before it takes off at most, left so many before it lands at most (convention)."""
_ROWS = 256  # nodes whose costs to all candidates are held at once
_PAIRS = 512


def bridged(graph: MotionGraph, ways: int, sigma: float, tell: Callable[[float], None] | None = None) -> MotionGraph:
    """The graph with up to ``ways`` edges from every node to each other behaviour.

    They lead to the frame after the one that is least unlike by the uniform metric: of the captured frames of a
    behaviour, the lowest costs among their neighbours in the capture. Their cost is that s, whichever metric built
    the graph. A one-shot behaviour, such as a jump, is entered from the ground shortly before it takes off, and not
    left in the air until shortly before it lands.

    Args:
        graph: a graph that can be walked without end.
        ways: edges to each behaviour from each node, at least 1.
        sigma: the task's smoothness_sigma.
        tell: told the share that is done.
    """
    windows = GraphWindows(graph)
    similar = _candidates(graph, windows)
    if not similar.size:
        return graph
    source, target = _chosen(graph, windows, similar, ways, tell or (lambda share: None))
    new = ~np.isin(_key(graph, source, target), _key(graph, graph.source, graph.target))
    return _with_edges(graph, windows, source[new], target[new], sigma)


def _candidates(graph: MotionGraph, windows: GraphWindows) -> NDArray[np.intp]:
    """Captured frames that one comes after which stays in its behaviour, in the order of the capture.  # (M,)

    A one-shot behaviour has to take off within the first of those frames.
    """
    after = windows.after
    here = np.where(after == NONE, 0, after)
    behaviour, at = graph.behaviour[here], here.copy()
    aloft = _aloft(graph)
    stays = (after != NONE) & graph.original & (behaviour >= 0) & ~aloft[here]
    for _ in range(STAY - 1):
        stays &= (after[at] != NONE) & (graph.behaviour[after[at]] == behaviour)
        at = np.where(stays, after[at], 0)
    found = np.flatnonzero(stays & (~_is_once(graph) | _soon(windows, aloft))[here])
    return found[np.lexsort((graph.frame[found], graph.clip[found]))]


def _soon(windows: GraphWindows, holds: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """At which frames something holds, or will after NEAR_GROUND ticks or fewer of the capture.  # (N,)"""
    at, soon = np.arange(len(holds)), holds.copy()
    for _ in range(NEAR_GROUND):
        at = np.where(windows.after[at] == NONE, at, windows.after[at])
        soon |= holds[at]
    return soon


def _aloft(graph: MotionGraph) -> NDArray[np.bool_]:
    """Which frames are in the air within a one-shot behaviour.  # (N,)"""
    return _is_once(graph) & ~graph.contacts.any(axis=1)


def _is_once(graph: MotionGraph) -> NDArray[np.bool_]:
    """Which frames show a one-shot behaviour.  # (N,)"""
    return np.isin(graph.behaviour, [index for index, name in enumerate(graph.behaviours) if name in ONE_SHOT])


def _chosen(
    graph: MotionGraph, windows: GraphWindows, similar: NDArray, ways: int, tell: Callable[[float], None]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Source and target of the bridges."""
    there = windows.after[similar]
    adjoining = np.append(there[:-1] == similar[1:], False)
    grounded = np.flatnonzero(_soon(windows, ~_aloft(graph)))
    ground, height, energy = _factors(windows, similar)
    sources, targets = [], []
    for first in range(0, len(grounded), _ROWS):
        nodes = grounded[first : first + _ROWS]
        a, b, e = _factors(windows, nodes)
        costs = e[:, None] + energy - 2.0 * (b @ height.T) - 2.0 * np.abs(a @ ground.conj().T)
        chosen = np.full((len(nodes), len(graph.behaviours), ways), NONE, dtype=np.int64)
        asked = graph.behaviour[nodes], graph.original[nodes], graph.clip[nodes], graph.frame[nodes]
        frames = graph.behaviour[there], graph.clip[similar], graph.frame[similar]
        _lowest(costs, adjoining, *asked, *frames, chosen)
        row, _, _ = found = np.nonzero(chosen != NONE)
        sources.append(nodes[row])
        targets.append(there[chosen[found]])
        tell((first + len(nodes)) / len(grounded))
    return np.concatenate(sources), np.concatenate(targets)


def _factors(windows: GraphWindows, nodes: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """x + iz and y of windows about their mean, rooted weights folded in, and their energy: s is a matter of products.

    Single precision, which is enough to choose by; the edges' own costs are computed anew.

    Returns:
        (n, P) complex64, (n, P) float32, (n,) float32.
    """
    held = windows.held(windows.nodes(nodes))
    points = np.concatenate([windows.points(held[at : at + _PAIRS]) for at in range(0, len(held), _PAIRS)])
    weights = np.repeat(window_weights() / points.shape[2], points.shape[2])
    flat = points.reshape(len(nodes), -1, 3)
    flat = flat - (weights @ flat)[:, None] * [1.0, 0.0, 1.0]
    flat *= np.sqrt(weights)[:, None]
    energy = (flat**2).sum(axis=(1, 2))
    ground = (flat[..., 0] + 1j * flat[..., 2]).astype(np.complex64)
    return ground, np.ascontiguousarray(flat[..., 1], dtype=np.float32), energy.astype(np.float32)


@numba.njit(cache=True, nogil=True)
def _lowest(
    costs: NDArray,
    adjoining: NDArray,
    own: NDArray,
    original: NDArray,
    clip: NDArray,
    frame: NDArray,
    shown: NDArray,
    their_clip: NDArray,
    their_frame: NDArray,
    chosen: NDArray,
) -> None:
    """Write the candidates of the lowest minima along each row, by behaviour, into ``chosen`` (n, B, ways).

    ``adjoining`` tells candidates that the next one follows in the capture. A frame has no bridge to its own behaviour,
    nor to frames of its own clip nearer than half a second.
    """
    last = costs.shape[1] - 1
    for row in range(costs.shape[0]):
        for at in range(last + 1):
            kind = shown[at]
            if kind == own[row]:
                continue
            near = abs(frame[row] - their_frame[at]) < MIN_GAP
            if near and original[row] and clip[row] == their_clip[at]:
                continue
            here = costs[row, at]
            lower_before = at > 0 and adjoining[at - 1] and shown[at - 1] == kind and costs[row, at - 1] <= here
            if lower_before or (at < last and adjoining[at] and shown[at + 1] == kind and costs[row, at + 1] < here):
                continue
            _put(chosen[row, kind], costs[row], at)


@numba.njit(cache=True, nogil=True)
def _put(lowest: NDArray, costs: NDArray, at: int) -> None:
    """Put a candidate among the lowest so far, in order of cost, if it is one of them."""
    place = len(lowest)
    while place > 0 and (lowest[place - 1] == NONE or costs[at] < costs[lowest[place - 1]]):
        if place < len(lowest):
            lowest[place] = lowest[place - 1]
        place -= 1
    if place < len(lowest):
        lowest[place] = at


def _key(graph: MotionGraph, source: NDArray, target: NDArray) -> NDArray[np.int64]:
    """One number for each pair of nodes."""
    return source.astype(np.int64) * graph.node_count + target


def _with_edges(
    graph: MotionGraph, windows: GraphWindows, source: NDArray, target: NDArray, sigma: float
) -> MotionGraph:
    """The graph with further transitions, sorted by source; a node's natural edge first, then others by target."""
    cost, displacement = _laid(windows, source, target)
    new = {
        "target": target,
        "cost": cost,
        "smoothness": np.exp(-cost / sigma),
        "displacement": displacement,
        "natural": np.zeros(len(source), dtype=bool),
    }
    arrays = {name: np.concatenate([getattr(graph, name), values]) for name, values in new.items()}
    starts = np.concatenate([graph.source, source])
    order = np.lexsort((arrays["target"], ~arrays["natural"], starts))
    start = np.searchsorted(starts[order], np.arange(graph.node_count + 1)).astype(np.int32)
    return replace(graph, edge_start=start, **{name: values[order] for name, values in arrays.items()})


def _laid(windows: GraphWindows, source: NDArray, target: NDArray) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """s of each bridge, and the planar place of its target seen from its source.  # (E,), (E, 3)"""
    costs, places = np.empty(len(source)), np.empty((len(source), 3))
    for first in range(0, len(source), _PAIRS):
        part = slice(first, first + _PAIRS)
        before = windows.before[target[part]]
        held = [windows.held(windows.nodes(nodes)) for nodes in (source[part], before)]
        found = align_windows(*(windows.points(each) for each in held))
        here, similar = (windows.places(each)[:, RADIUS] for each in held)
        costs[part] = found.square / UNIT**2
        places[part] = relative(here, moved(composed(similar, windows.step[before]), found))
    return np.maximum(costs, 0.0), places
