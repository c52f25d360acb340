"""Microseconds per character and tick of choose, step and show, beside a plain gather of the same poses.

    python benchmarks/world.py [--counts 1,10,100] [--repeats 15]

Prints one JSON object. The graph is made up at random in the size of a real one: 2,721 nodes of 21 joints, 4 edges a
node. Characters take a transition at one tick in ``TRANSITION_EVERY``, so most carry offsets. Each foot stands at three
nodes in five, and poses are so unlike that locks break and nearly every leg is bent at every frame: the dearest case.
The baseline copies the node poses out of the graph with ``numpy.take``, the floor that memory sets.
"""

import argparse
import json
import platform
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from footwork.controllers.controller import Situations
from footwork.controllers.steering import SteeringController
from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.coded_values import exact
from footwork.motion.graph import MotionGraph, captured
from footwork.motion.moves import along_edges, no_moves
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.runtime.warm import warm_kernels
from footwork.runtime.world import World

NODES, EDGES_A_NODE, TRANSITION_EVERY = 2721, 4, 10
STANCE = 6  # nodes


def made_up_graph(random: np.random.Generator) -> MotionGraph:
    """Random poses; the first edge of each node is natural."""
    body = default_body()
    edges = NODES * EDGES_A_NODE
    target = random.integers(0, NODES, edges)
    target[::EDGES_A_NODE] = (np.arange(NODES) + 1) % NODES
    natural = np.arange(edges) % EDGES_A_NODE == 0
    arrays: dict[str, Any] = captured(np.zeros(NODES), np.arange(NODES))
    arrays |= {
        "label": np.zeros(NODES),
        "behaviour": random.integers(0, 4, NODES),
        "contacts": (np.arange(NODES)[:, None] // STANCE + np.arange(len(body.feet))) % 5 < 3,
        "root_position": random.normal(0.9, 0.05, (NODES, 3)) * [0.0, 1.0, 0.0],
        "rotations": quaternion.from_rotation_vector(random.normal(0.0, 0.4, (NODES, body.joint_count, 3))),
        "root_velocity": random.normal(0.0, 1.0, (NODES, 3)),
        "angular_velocity": random.normal(0.0, 1.5, (NODES, body.joint_count, 3)),
        "edge_start": np.arange(NODES + 1) * EDGES_A_NODE,
        "target": target,
        "cost": np.where(natural, 0.0, 0.5),
        "smoothness": np.where(natural, 1.0, 0.6),
        "displacement": random.normal(0.0, 0.03, (edges, 3)),
        "natural": natural,
    }
    task = SteeringTask()
    return MotionGraph(skeleton=body, clips=("made up",), labels=("walk",), behaviours=task.behaviours, **arrays)


def made_up_table(graph: MotionGraph, random: np.random.Generator) -> PolicyTable:
    """Random values: what is looked up costs the same whatever it holds."""
    task = SteeringTask()
    values = random.uniform(0.0, 50.0, (graph.node_count, len(task.behaviours), task.heading_bins))
    return PolicyTable(task, exact(values), 0.0, 1, True)


def wandering_edges(world: World, random: np.random.Generator) -> np.ndarray:
    """The natural edge of each node, or now and then one of its transitions."""
    jumps = random.random(world.capacity) < 1.0 / TRANSITION_EVERY
    other = random.integers(1, EDGES_A_NODE, world.capacity)
    return (world.graph.edge_start[world.node] + np.where(jumps, other, 0)).astype(np.int32)


def timings(work: Callable[[], Any], count: int, repeats: int, before: Callable[[], Any] = lambda: None) -> dict:
    """Median and 10th and 90th percentile over repeats of the time of ``work`` per character, microseconds."""
    inner = max(1, 300 // count)
    times = []
    for _ in range(repeats):
        spent = 0
        for _ in range(inner):
            before()
            start = time.perf_counter_ns()
            work()
            spent += time.perf_counter_ns() - start
        times.append(spent / (1000.0 * inner * count))
    low, middle, high = np.percentile(times, [10, 50, 90])
    return {"p10": round(low, 4), "median": round(middle, 4), "p90": round(high, 4)}


def measure(graph: MotionGraph, table: PolicyTable, count: int, repeats: int) -> dict:
    """All timings with ``count`` characters."""
    random = np.random.default_rng(count)
    world, controller = World(graph, count), SteeringController(graph, table)
    loose = World(graph, count, foot_lock=False)
    for _ in range(count):
        start, place = int(random.integers(0, NODES)), random.uniform(-3.0, 3.0, 3)
        for each in (world, loose):
            each.spawn(start, *place)
    heading, asked = random.uniform(-3.0, 3.0, count), random.integers(0, 4, count).astype(np.int32)
    chosen, moves = no_moves(count), no_moves(count)
    situations = Situations(np.arange(count), world.node, world.place, heading, asked)

    def decide() -> None:
        along_edges(graph, wandering_edges(world, random), moves)

    def move() -> None:
        decide()
        world.step(moves)
        loose.step(moves)

    def others_first(stepped: World) -> Callable[[], None]:
        """The moves of a step, and the step of the world that is not timed: both stay on the same nodes."""
        other = loose if stepped is world else world

        def before() -> None:
            decide()
            other.step(moves)

        return before

    for _ in range(2 * TRANSITION_EVERY):
        move()
    poses = np.zeros((count, *graph.rotations.shape[1:]), dtype=np.float32)
    return {
        "choose": timings(lambda: controller.choose(situations, chosen), count, repeats, move),
        "step": timings(lambda: world.step(moves), count, repeats, others_first(world)),
        "step_without_foot_lock": timings(lambda: loose.step(moves), count, repeats, others_first(loose)),
        "show_at_node": timings(lambda: world.show(1.0), count, repeats, move),
        "show_between": timings(lambda: world.show(0.5), count, repeats, move),
        "show_between_without_foot_lock": timings(lambda: loose.show(0.5), count, repeats, move),
        "gather_baseline": timings(
            lambda: graph.rotations.take(world.node, axis=0, out=poses, mode="clip"), count, repeats, move
        ),
    }


def bytes_a_character(joints: int) -> dict[str, int]:
    """Bytes of arrays that are read and written for one character, by kernel."""
    pose, vectors, root = joints * 16, joints * 12, 48
    return {
        "show_between": pose + vectors + 2 * vectors + root + 24 + pose + 12,
        "step_natural": 4 * vectors + 2 * root + 60,
        "gather_baseline": 2 * pose,
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--counts", default="1,10,100,1000,10000")
    parser.add_argument("--repeats", type=int, default=15)
    options = parser.parse_args()
    random = np.random.default_rng(0)
    graph = made_up_graph(random)
    table = made_up_table(graph, random)
    start = time.perf_counter()
    warm_kernels(SteeringController(graph, table))
    report = {
        "unit": "us per character and tick",
        "processor": platform.processor() or platform.machine(),
        "warm_kernels_s": round(time.perf_counter() - start, 3),
        "bytes_a_character": bytes_a_character(graph.skeleton.joint_count),
        "characters": {
            count: measure(graph, table, count, options.repeats) for count in map(int, options.counts.split(","))
        },
    }
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
