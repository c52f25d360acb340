"""Replaying a recorded player through a character: the same controller and the same world as under the server."""

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.task import BEHAVIOURS
from footwork.motion.tick import TICK_RATE
from footwork.motion.trace import SteeringCommands, Trace, steering_commands
from footwork.runtime.world import World
from footwork.study.foot_slide import Slide, shown_soles, slide_of_frames
from footwork.study.measures import TASK, Followed


@dataclass(frozen=True, eq=False)
class Replay:
    """What came of one trace.

    Args:
        name: of the trace.
        followed: what was asked and shown.
        slide: of the shown poses' feet.
        tick_us: decision, step and show of each tick, microseconds.  # (K,)
    """

    name: str
    followed: Followed
    slide: Slide
    tick_us: NDArray[np.float64]


def replay(
    graph: MotionGraph,
    trace: Trace,
    controller: Controller,
    *,
    inertialise: bool = True,
    most_ticks: int | None = None,
    sigma: float = TASK.smoothness_sigma,
) -> Replay:
    """Let a character follow a trace, from a frame that stands, facing along the view.

    A behaviour that no frame shows cannot be asked of a controller: it is asked to walk in place of run, and at
    any other such tick to go on with what it was last asked for. The score still holds it against the trace.

    Args:
        graph: where the character lives.
        trace: the player.
        controller: what chooses edges.
        inertialise: whether transitions are smoothed.
        most_ticks: stop after so many ticks.
        sigma: what the graph's smoothness was made with.

    Raises:
        InputError: for a graph without a frame of any behaviour.
    """
    if not controller.present:
        raise InputError("no frame shows any behaviour, expected at least one", graph.where)
    commands = steering_commands(trace, 0.0, controller.present).first(most_ticks)
    asked = _askable(commands.behaviour, graph.behaviours, controller.present)
    world = World(graph, 1, inertialise=inertialise)
    start = "stop" if "stop" in controller.present else controller.present[0]
    controller.begin(world.spawn(controller.start_node(start), 0.0, 0.0, 0.0))
    ran = _run(world, controller, commands.heading, asked)
    return Replay(trace.name, _followed(graph, commands, ran, sigma), _slide(graph, ran), ran.nanoseconds / 1e3)


@dataclass(frozen=True, eq=False)
class _Run:
    """What the world went through: edges, facings, poses and times of K ticks."""

    edge: NDArray[np.int32]
    facing: NDArray[np.float64]
    root: NDArray[np.float32]
    rotations: NDArray[np.float32]
    nanoseconds: NDArray[np.int64]


def _run(world: World, controller: Controller, heading: NDArray, asked: NDArray) -> _Run:
    ticks, joints = len(heading), world.graph.skeleton.joint_count
    run = _Run(
        np.empty(ticks, np.int32),
        np.empty(ticks),
        np.empty((ticks, 3), np.float32),
        np.empty((ticks, joints, 4), np.float32),
        np.empty(ticks, np.int64),
    )
    moves, slots, clock = no_moves(1), np.zeros(1, np.intp), time.perf_counter_ns
    for tick in range(ticks):
        wanted, behaviour = heading[tick : tick + 1], asked[tick : tick + 1]
        began = clock()
        controller.choose(Situations(slots, world.node, world.place, wanted, behaviour), moves)
        world.step(moves)
        root, rotations = world.show(1.0)
        run.nanoseconds[tick] = clock() - began
        run.edge[tick], run.facing[tick] = world.edge[0], world.place[0, 2]
        run.root[tick], run.rotations[tick] = root[0], rotations[0]
    return run


def _askable(behaviour: NDArray, numbered: tuple[str, ...], present: tuple[str, ...]) -> NDArray[np.int32]:
    """What to ask of the controller: an index into ``numbered`` for each tick."""
    asked = np.array([numbered.index(name) if name in present else -1 for name in BEHAVIOURS])[behaviour]
    first = numbered.index("stop" if "stop" in present else present[0])
    known = np.maximum.accumulate(np.where(asked >= 0, np.arange(1, len(asked) + 1), 0))
    return np.concatenate([[first], asked])[known].astype(np.int32)


def _followed(graph: MotionGraph, commands: SteeringCommands, run: _Run, sigma: float) -> Followed:
    names = [BEHAVIOURS.index(name) if name in BEHAVIOURS else -1 for name in graph.behaviours]
    return Followed(
        heading=commands.heading,
        behaviour=commands.behaviour,
        jump=commands.jump,
        facing=run.facing,
        shown=np.array([*names, -1], np.int32)[graph.behaviour[graph.target[run.edge]]],
        cost=_uniform_costs(graph, run.edge, sigma),
        natural=graph.natural[run.edge],
    )


def _uniform_costs(graph: MotionGraph, edges: NDArray, sigma: float) -> NDArray[np.float64]:
    """s by the uniform metric, which smoothness is judged by whichever metric built the graph.  # (E,)"""
    smoothness = np.maximum(graph.smoothness[edges].astype(np.float64), np.finfo(np.float32).tiny)
    return -sigma * np.log(smoothness)


def _slide(graph: MotionGraph, run: _Run) -> Slide:
    points = shown_soles(graph, run.root, run.rotations)
    return slide_of_frames(points, graph.contacts[graph.target[run.edge]], TICK_RATE)
