"""Steering written out as matrices over all states, in float64: what solver and controller are held against."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.node_speed import node_speeds
from footwork.motion.player_model import PlayerModel, persistent_player
from footwork.motion.requests import holding_speed
from footwork.motion.task import SteeringTask
from footwork.motion.turn_warp import adjustment_cost, turn_warp, turned
from motion_samples import ring_graph


def random_steering_graph(seed: int, nodes: int = 5, degree: int = 2) -> MotionGraph:
    """A graph whose nodes have 1 to ``degree`` edges of random turns and smoothness, some natural."""
    rng = np.random.default_rng(seed)
    counts = rng.integers(1, degree + 1, nodes)
    edges = int(counts.sum())
    ring = ring_graph(nodes)
    return replace(
        ring,
        behaviour=rng.integers(-1, 2, nodes).astype(np.int16),
        contacts=rng.random((nodes, ring.contacts.shape[1])) < 0.5,
        edge_start=np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
        target=rng.integers(0, nodes, edges).astype(np.int32),
        cost=np.zeros(edges, np.float32),
        smoothness=rng.uniform(0.3, 1.0, edges).astype(np.float32),
        displacement=np.column_stack([np.zeros((edges, 2)), rng.uniform(-3.5, 3.5, edges)]).astype(np.float32),
        natural=rng.random(edges) < 0.3,
    )


class ExactSteering:
    """All actions of a task on a graph: an edge and an extra turn each, as rewards and transition matrices.

    States are (node, request, heading bin), flat; W are values of commands expected at the next tick.
    """

    def __init__(self, graph: MotionGraph, task: SteeringTask, player: PlayerModel | None = None) -> None:
        self.graph, self.task = graph, task
        self.requests, self.speeds = task.requests, node_speeds(graph)
        self.shape = graph.node_count, len(self.requests.behaviour), task.heading_bins
        changes = holding_speed(player or persistent_player(task.behaviours, task.heading_bins), self.requests)
        self.expect = np.kron(np.eye(self.shape[0]), changes.matrix)
        self.actions = [self._action(edge, turn) for edge, turn in self.choices()]

    def choices(self) -> list[tuple[int, float]]:
        """Every edge with every turn that the task allows on arriving at its target."""
        limit = self.task.turn_limit(self.graph.behaviour[self.graph.target])
        return [(e, limit[e] * level) for e in range(self.graph.edge_count) for level in self.task.turn_levels]

    def rewards(self, edge: int, turn: float, wanted: int, heading: NDArray) -> NDArray:
        """What a tick earns under a request, at headings before it."""
        there = self.graph.target[edge]
        warp = turn_warp(self.graph)
        extra = float(adjustment_cost(warp.moments[there], turned(warp.pivot[there], turn)))
        qt = float(self.graph.smoothness[edge]) * math.exp(-extra / self.task.smoothness_sigma)
        qt *= 1.0 if self.graph.natural[edge] else 1.0 - self.task.transition_price
        after = heading - float(self.graph.displacement[edge, 2]) - turn
        shown = self.graph.behaviour[there]
        behaviour, speed = (part[wanted] for part in self.requests)
        qc = self.task.control_quality(after, np.full(len(after), behaviour), np.full(len(after), shown))
        if not math.isnan(speed):
            apart = (self.speeds[there] - speed) / (self.task.speed_sigma * max(speed, 1.0))
            qc = qc * (1.0 - self.task.speed_weight * (1.0 - math.exp(-(apart**2) / 2.0)))
        return qc + self.task.weight * (qt - 1.0) if self.task.reward == "sum" else qc * qt

    def _action(self, edge: int, turn: float) -> tuple[int, NDArray, NDArray]:
        """Its source, and rewards (Q, H) and transitions (Q, H, states) from there."""
        _, requests, headings = self.shape
        reward, follows = np.zeros((requests, headings)), np.zeros((requests, headings, *self.shape))
        after = self.task.headings - float(self.graph.displacement[edge, 2]) - turn
        place = (after + math.pi) / (2 * math.pi) * headings
        low = np.floor(place).astype(int)
        for wanted in range(requests):
            reward[wanted] = self.rewards(edge, turn, wanted, self.task.headings)
            for h in range(headings):
                row = follows[wanted, h, self.graph.target[edge], wanted]
                row[low[h] % headings] += 1.0 - (place[h] - low[h])
                row[(low[h] + 1) % headings] += place[h] - low[h]
        return int(self.graph.source[edge]), reward, follows.reshape(requests, headings, -1)

    def onward(self) -> tuple[NDArray, NDArray]:
        """Rewards (states,) and transitions (states, states) of going on while a decision holds."""
        graph, reward, follows = self.graph, np.zeros(self.shape), np.zeros((*self.shape, np.prod(self.shape)))
        for node in range(graph.node_count):
            row = range(graph.edge_start[node], graph.edge_start[node + 1])
            natural = [edge for edge in row if graph.natural[edge]]
            edge = natural[0] if natural else max(row, key=lambda edge: graph.smoothness[edge])
            _, reward[node], follows[node] = self._action(edge, 0.0)
        return reward.ravel(), follows.reshape(reward.size, -1)

    def action_values(self, values: NDArray) -> NDArray:
        """Of every action at every state, -inf where it is not to be had, by W.  # -> (actions, N, Q, H)"""
        worth = np.full((len(self.actions), *self.shape), -np.inf)
        for action, (node, reward, follows) in enumerate(self.actions):
            worth[action, node] = reward + self.task.discount * follows @ values.ravel()
        return worth

    def solved(self) -> NDArray:
        """W of the best policy, by policy iteration with dense linear solves.  # (N, Q, H)"""
        size, discount = int(np.prod(self.shape)), self.task.discount
        values, choice = np.zeros(self.shape), np.full(self.shape, -1)
        while True:
            worth = self.action_values(values)
            better = worth.max(axis=0) > np.take_along_axis(worth, np.maximum(choice, 0)[None], 0)[0] + 1e-10
            improved = np.where((choice < 0) | better, worth.argmax(axis=0), choice)
            if np.array_equal(improved, choice):
                return values
            choice = improved
            reward, follows = np.zeros(self.shape), np.zeros((*self.shape, size))
            for state in np.ndindex(*self.shape):
                _, rewards, rows = self.actions[choice[state]]
                reward[state], follows[state] = rewards[state[1:]], rows[state[1:]]
            constant, matrix = reward.ravel(), discount * follows.reshape(size, size)
            on_reward, on_follows = self.onward()
            for _ in range(self.task.segment_ticks - 1):
                step = discount * on_follows @ self.expect
                constant, matrix = on_reward + step @ constant, step @ matrix
            constant, matrix = self.expect @ constant, self.expect @ matrix
            values = np.linalg.solve(np.eye(size) - matrix, constant).reshape(self.shape)
