"""The fight map: all that look-ahead needs to know of a state-annotated graph, computed once.

Where a fighter stands at the contact of a strike or the end of an evasion is a look-up and one planar transform then.
Tables are arrays of records, which compiled code takes as one argument each; all whole numbers in them are of one width
and so are all others, for every mix of widths would be compiled anew. A place or a transform is x, z and yaw.
"""

from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ACTIVITIES, ATTACK
from footwork.errors import InputError
from footwork.motion.annotation import NO_WAY, Annotation
from footwork.motion.bundle import Bundle
from footwork.motion.fighting_points import points_of
from footwork.motion.graph import MotionGraph
from footwork.motion.planar import after, between, put, triple
from footwork.motion.stretch_places import natural_steps, stretch_places
from footwork.motion.strikes import Strikes
from footwork.motion.turn_warp import turn_warp

Records = Any
"""An array of records: a type checker does not know their fields."""
NONE = -1
WIND_UP = 4
"""Ticks: strikes whose contact comes sooner after an action's first frame do not count as that action's."""
SHORTEST_EVADE = 9
"""Ticks of the shortest stretch that counts as getting out of the way."""

NODES = np.dtype(
    [
        ("segment", "i8"),
        ("ends", "?"),  # whether it is the last of its segment
        ("edge_start", "i8"),  # its edges
        ("edge_end", "i8"),
        ("limb", "i8"),  # which strikes there, NONE for none
        ("speed", "f8"),  # of that limb, m/s
        ("to_contact", "i8"),  # ticks to the next strike of its action, NONE for none
        ("x", "f8"),  # its place in its stretch of capture
        ("z", "f8"),
        ("yaw", "f8"),
        ("pivot_x", "f8"),  # what a fighter that is turned turns about, in its planar frame
        ("pivot_z", "f8"),
    ],
    align=True,
)
EDGES = np.dtype([("target", "i8"), ("natural", "?"), ("x", "f8"), ("z", "f8"), ("yaw", "f8")], align=True)
SEGMENTS = np.dtype(
    [
        ("first", "i8"),
        ("last", "i8"),
        ("state", "i8"),  # 0 for that in which fighters shadow
        ("onward", "i8"),  # the edge of those who choose none at its end
        ("action_end", "i8"),  # the last node of the action that begins with it
        ("contact", "i8"),  # the first strike of that action, NONE for none
        ("attack_row", "i8"),  # its row and column in the ways to attacks, NONE for none
        ("attack_column", "i8"),
        ("evade_row", "i8"),
        ("evade_column", "i8"),
    ],
    align=True,
)
WAYS = np.dtype(
    [
        ("edge", "i8"),  # the next to take
        ("ticks", "i8"),  # from the last node of a segment to the first of the action, NONE for no way
        ("when", "i8"),  # ticks until what counts of the action: a strike's contact, an evasion's end; NONE for no way
        ("x", "f8"),  # where the action begins, seen from that last node
        ("z", "f8"),
        ("yaw", "f8"),
        ("hips_x", "f8"),  # where it has the hips when it counts
        ("hips_z", "f8"),
        ("limb_x", "f8"),  # and the limb that strikes, 0 for evasions
        ("limb_y", "f8"),
        ("limb_z", "f8"),
    ],
    align=True,
)


class FightMap(NamedTuple):
    """A graph of N nodes, E edges and G segments as fighters see it. Metres, radians, ticks.

    Args:
        nodes: NODES.  # (N,)
        edges: EDGES.  # (E,)
        segments: SEGMENTS.  # (G,)
        points: what strikes and what may be struck, in each node's planar frame.  # (N, 7, 3)
        attack_goals: segments that attacks begin with, ascending.  # (T,)
        attacks: WAYS from segments of footwork and attacks to these.  # (R, T)
        evade_goals: the same of evasions.
        evades: likewise.
    """

    nodes: Records
    edges: Records
    segments: Records
    points: NDArray[np.float64]
    attack_goals: NDArray[np.int64]
    attacks: Records
    evade_goals: NDArray[np.int64]
    evades: Records


def fight_map(bundle: Bundle) -> FightMap:
    """The map of a bundle.

    Raises:
        InputError: for a bundle without states or without those called attack and evade, to be reached at once from
            the first state; and for one in which no attack strikes or nothing gets out of the way.
    """
    graph, notes = bundle.graph, bundle.annotation
    if notes is None:
        raise InputError("no states, expected a bundle built with --graph annotated and a machine", graph.where)
    attack, evade = (_number(notes, name) for name in ACTIVITIES[1:])
    action_end = _action_ends(graph, notes)
    nodes, points = _nodes(graph, notes, bundle.strikes, action_end), points_of(graph)
    contact = _contacts(notes, action_end, nodes["limb"])
    evaded = np.where(action_end - notes.first[:-1] + 1 >= SHORTEST_EVADE, action_end, NONE)
    segments = _segments(graph, notes, action_end, contact)
    edges = _edges(graph)
    into = graph, notes, nodes, edges, points
    attack_goals, attacks = _ways(*into, attack, contact, segments["attack_row"], segments["attack_column"])
    evade_goals, evades = _ways(*into, evade, evaded, segments["evade_row"], segments["evade_column"])
    parts = nodes, edges, segments, points, attack_goals, attacks, evade_goals, evades
    return FightMap(*map(_read_only, parts))


def _number(notes: Annotation, name: str) -> int:
    """A state that is to be reached at once from the first, by its name."""
    names = notes.machine.names
    if name not in names:
        raise InputError(f"no state {name!r}, expected one (there are {', '.join(names)})", notes.where)
    if (0, names.index(name)) not in notes.machine.at_once:
        raise InputError(f"{name!r} is not reached at once, add it to 'at_once'", notes.machine.place(0))
    return names.index(name)


def _action_ends(graph: MotionGraph, notes: Annotation) -> NDArray[np.int64]:
    """The node up to which the capture goes on in the state of each segment; its last, for the first state.  # (G,)"""
    follows = natural_steps(graph)[0]
    state = notes.state[notes.segment]
    goes_on = np.append((state[1:] == state[:-1]) & (state[1:] != 0) & follows[1:], False)
    stops = np.flatnonzero(~goes_on)
    return np.where(notes.state == 0, notes.last, stops[np.searchsorted(stops, notes.first[:-1])])


def _nodes(graph: MotionGraph, notes: Annotation, strikes: Strikes | None, action_end: NDArray) -> NDArray[np.void]:
    nodes = np.zeros(graph.node_count, dtype=NODES)
    nodes["segment"] = notes.segment
    nodes["ends"][notes.last] = True
    nodes["edge_start"], nodes["edge_end"] = graph.edge_start[:-1], graph.edge_start[1:]
    nodes["limb"] = NONE
    if strikes is not None:
        nodes["limb"][strikes.node], nodes["speed"][strikes.node] = strikes.limb, strikes.speed
    following = _next_strike(nodes["limb"], np.arange(len(nodes)))
    pending = following <= action_end[notes.segment]
    nodes["to_contact"] = np.where(pending, following - np.arange(len(nodes)), NONE)
    nodes["x"], nodes["z"], nodes["yaw"] = stretch_places(graph).T
    nodes["pivot_x"], nodes["pivot_z"] = turn_warp(graph).pivot.T
    return nodes


def _next_strike(limb: NDArray, nodes: NDArray) -> NDArray[np.int64]:
    """The first node from each of some on at which a limb strikes, beyond all nodes for none."""
    struck = np.append(np.flatnonzero(limb != NONE), np.iinfo(np.int32).max)
    return struck[np.searchsorted(struck, nodes)]


def _contacts(notes: Annotation, action_end: NDArray, limb: NDArray) -> NDArray[np.int64]:
    """The first strike of the action that begins with each segment.  # (G,)"""
    first = _next_strike(limb, notes.first[:-1] + WIND_UP)
    return np.where((notes.state != 0) & (first <= action_end), first, NONE)


def _segments(graph: MotionGraph, notes: Annotation, action_end: NDArray, contact: NDArray) -> NDArray[np.void]:
    segments = np.zeros(notes.segment_count, dtype=SEGMENTS)
    segments["first"], segments["last"], segments["state"] = notes.first[:-1], notes.last, notes.state
    segments["onward"] = _onward(graph, notes)
    segments["action_end"], segments["contact"] = action_end, contact
    for name in ("attack_row", "attack_column", "evade_row", "evade_column"):
        segments[name] = NONE
    return segments


def _onward(graph: MotionGraph, notes: Annotation) -> list[int]:
    """For each segment the edge at its end that stays with the capture, or else the one of the least cost."""
    dearer = graph.cost + np.where(graph.natural, 0.0, 1e6)
    starts, ends = graph.edge_start[notes.last], graph.edge_start[notes.last + 1]
    return [start + dearer[start:end].argmin() for start, end in zip(starts, ends, strict=True)]


def _edges(graph: MotionGraph) -> NDArray[np.void]:
    edges = np.zeros(graph.edge_count, dtype=EDGES)
    edges["target"], edges["natural"] = graph.target, graph.natural
    edges["x"], edges["z"], edges["yaw"] = graph.displacement.T
    return edges


def _ways(
    graph: MotionGraph,
    notes: Annotation,
    nodes: NDArray,
    edges: NDArray,
    points: NDArray,
    state: int,
    then: NDArray,
    row: NDArray,
    column: NDArray,
) -> tuple[NDArray[np.int64], NDArray[np.void]]:
    """The segments of a state whose action has a node that counts, and the ways to them.

    Args:
        graph: the graph.
        notes: its states.
        nodes: NODES.
        edges: EDGES.
        points: of the map.
        state: which.
        then: the node that counts of the action that begins with each segment, NONE for segments not meant.  # (G,)
        row: written.  # (G,)
        column: written.  # (G,)
    """
    pair = (0, state)
    hops = notes.ways[notes.machine.at_once.index(pair)]
    rows, goals = notes.between(pair), notes.of_state(state)
    meant = then[goals] != NONE
    goals, edge, delay = goals[meant], hops.edge[:, meant], hops.delay[:, meant]
    if not (edge[notes.state[rows] == 0] != NO_WAY).any():
        name = notes.machine.names[state]
        needed = "strikes (see footwork build --strikes)" if name == ACTIVITIES[ATTACK] else "is long enough"
        raise InputError(f"no {name} that {needed} can be reached", notes.machine.place(state))
    row[rows], column[goals] = np.arange(len(rows)), np.arange(len(goals))
    ways = np.zeros(edge.shape, dtype=WAYS)
    known = edge != NO_WAY
    ways["edge"], ways["ticks"] = edge, np.where(known, delay + 1, NONE)
    ways["when"] = np.where(known, delay + 1 + (then - notes.first[:-1])[goals], NONE)
    order = np.argsort(delay, axis=0, kind="stable")
    _fill_shifts(ways, order, row, goals, edges, nodes, notes.first)
    limb = np.where((nodes["limb"] != NONE)[:, None], points[np.arange(len(nodes)), nodes["limb"]], 0.0)
    _fill_ends(ways, notes.first[goals], then[goals], nodes, limb)
    return goals.astype(np.int64), ways


@numba.njit(cache=True, nogil=True)
def place_of(record):
    """Where a node, an edge or a way leads, as a triple."""
    return record.x, record.z, record.yaw


@numba.njit(cache=True, nogil=True)
def _fill_shifts(ways, order, row, goals, edges, nodes, first):
    """Where ways lead, by where their rests lead, which take less time and so come first in ``order``."""
    shift = np.zeros((*ways.shape, 3))
    for column in range(ways.shape[1]):
        for number in range(ways.shape[0]):
            at = order[number, column]
            taken = ways[at, column].edge
            if taken >= 0:
                there = nodes[edges[taken].target].segment
                x, z, yaw = place_of(edges[taken])
                if there != goals[column]:
                    along = between(place_of(nodes[first[there]]), place_of(nodes[first[there + 1] - 1]))
                    x, z, yaw = after(after((x, z, yaw), along), triple(shift[row[there]], column))
                shift[at, column, 0], shift[at, column, 1], shift[at, column, 2] = x, z, yaw
                way = ways[at, column]
                way.x, way.z, way.yaw = x, z, yaw


@numba.njit(cache=True, nogil=True)
def _fill_ends(ways, first, then, nodes, limb):
    """Where ways have hips and limb at the nodes that count, seen from where the ways begin."""
    for column in range(first.shape[0]):
        along = between(place_of(nodes[first[column]]), place_of(nodes[then[column]]))
        point = limb[then[column]]
        for row in range(ways.shape[0]):
            way = ways[row, column]
            there = after(place_of(way), along)
            way.hips_x, way.hips_z = there[0], there[1]
            x, z = put(there, point[0], point[2])
            way.limb_x, way.limb_y, way.limb_z = x, point[1], z


def _read_only(array: NDArray) -> NDArray:
    array = np.ascontiguousarray(array)
    array.flags.writeable = False
    return array
