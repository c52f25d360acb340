"""Shadowing written out as matrices over all states, in float64: what solver and controller are held against."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.annotation import Annotation
from footwork.motion.graph import MotionGraph
from footwork.motion.shadowing_task import ShadowingTask
from footwork.motion.state_machine import State, StateMachine
from footwork.training.annotated_recipe import annotated
from toy_graphs import graph_of, homogeneous, wandering_clip

MOVING = StateMachine((State("move", ("walk",), ("move",)),))


def wandering_segments(seed: int) -> tuple[MotionGraph, Annotation]:
    """Two clips of one state, with ways to branch off every few frames."""
    random = np.random.default_rng(seed)
    jumps = [(i, int(j)) for i in (3, 6, 11, 14, 19, 23) for j in random.integers(0, 22, 2) if j != 11]
    graph = graph_of(
        [wandering_clip(seed, 12), wandering_clip(seed + 1, 12)], [*dict.fromkeys(jumps), (11, 0), (23, 12)]
    )
    return graph, annotated(graph, MOVING, np.zeros(graph.node_count, dtype=np.int16))


class ExactShadowing:
    """Hops as costs and rows of transition matrices; states are (segment, distance, bearing), flat."""

    def __init__(self, graph: MotionGraph, notes: Annotation, task: ShadowingTask) -> None:
        self.graph, self.notes, self.task = graph, notes, task
        self.shape = notes.segment_count, task.distance_bins, task.bearing_bins
        self.hops = [edge for edge in range(graph.edge_count) if graph.source[edge] in notes.last]

    def after(self, edge: int, point: NDArray) -> tuple[float, float, NDArray]:
        """Cost of the ticks from an edge to its segment's end, the discount there, and the opponent's place then."""
        cost, worth = 0.0, 1.0
        while True:
            point = np.linalg.inv(homogeneous(self.graph.displacement[edge].astype(np.float64))) @ point
            cost += worth * self.cost(point)
            worth *= self.task.discount
            node = self.graph.target[edge]
            if node in self.notes.last:
                return cost, worth, point
            edge = int(self.graph.edge_start[node])

    def cost(self, point: NDArray) -> float:
        """Of a tick that ends with the opponent there (4,)."""
        apart = abs(np.linalg.norm(point[[0, 2]]) - self.task.distance) / self.task.distance_scale
        return apart + abs(np.angle(point[2] + 1j * point[0])) / self.task.facing_scale

    def corners(self, segment: int, point: NDArray) -> dict[int, float]:
        """The states that a place of the opponent lies between, with their weights."""
        _, distances, bearings = self.shape
        far = min(np.linalg.norm(point[[0, 2]]) / self.task.farthest, 1.0) * (distances - 1)
        round_ = (np.angle(point[2] + 1j * point[0]) + np.pi) / (2 * np.pi) * bearings
        weights: dict[int, float] = {}
        for d in range(distances):
            for p in range(bearings):
                around = min(abs(round_ - p), bearings - abs(round_ - p))
                weight = float(max(0.0, 1 - abs(far - d)) * max(0.0, 1 - around))
                if weight:
                    weights[int(np.ravel_multi_index((segment, d, p), self.shape))] = weight
        return weights

    def point(self, state: tuple[int, int, int]) -> NDArray:
        """Where the opponent is in a state."""
        distance = self.task.farthest * state[1] / (self.shape[1] - 1)
        bearing = 2 * np.pi * state[2] / self.shape[2] - np.pi
        return np.array([distance * np.sin(bearing), 0.0, distance * np.cos(bearing), 1.0])

    def choices(self, segment: int) -> list[int]:
        """The edges that may be taken at its end."""
        return [edge for edge in self.hops if self.graph.source[edge] == self.notes.last[segment]]

    def row(self, edge: int, point: NDArray) -> tuple[float, NDArray]:
        """The cost of a hop and its discounted weights of states."""
        cost, worth, then = self.after(edge, point)
        weights = np.zeros(int(np.prod(self.shape)))
        for state, weight in self.corners(int(self.notes.segment[self.graph.target[edge]]), then).items():
            weights[state] = worth * weight
        return cost, weights

    def worths(self, values: NDArray, segment: int, point: NDArray) -> NDArray:
        """The cost to come of each choice at a segment's end."""
        rows = [self.row(edge, point) for edge in self.choices(segment)]
        return np.array([cost + weights @ values.ravel() for cost, weights in rows])

    def solved(self) -> NDArray:
        """The values, by policy iteration with dense solves.  # (R, D, P)"""
        states = list(np.ndindex(*self.shape))
        rows = [[self.row(edge, self.point(state)) for edge in self.choices(state[0])] for state in states]
        policy = np.zeros(len(states), dtype=int)
        while True:
            costs = np.array([row[choice][0] for row, choice in zip(rows, policy, strict=True)])
            matrix = np.array([row[choice][1] for row, choice in zip(rows, policy, strict=True)])
            values = np.linalg.solve(np.eye(len(states)) - matrix, costs)
            better = np.array([np.argmin([cost + weights @ values for cost, weights in row]) for row in rows])
            gained = [rows[s][policy[s]][0] + rows[s][policy[s]][1] @ values for s in range(len(states))]
            best = [rows[s][better[s]][0] + rows[s][better[s]][1] @ values for s in range(len(states))]
            if np.allclose(gained, best, atol=1e-10):
                return values.reshape(self.shape)
            policy = better
