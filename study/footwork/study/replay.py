"""Replaying a recorded player through a character: the same controller and the same world as under the server."""

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.motion.asked import asked_of, going_on, spawn_behaviour
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.task import BEHAVIOURS
from footwork.motion.trace import SteeringCommands, Trace
from footwork.motion.turn_warp import TurnWarp, turn_warp
from footwork.study.charges import charges
from footwork.study.contender import Contender, Foreseeing
from footwork.study.measures import TASK, Followed
from footwork.study.showing import Showing
from footwork.study.shown import Shown, ground_of, shown


class Stage:
    """What replays on one graph share: the prices of its turns and the height of its ground.

    Args:
        graph: where characters live.
        showing: what is done to poses.
        sigma: what the graph's smoothness was made with.
    """

    def __init__(
        self, graph: MotionGraph, showing: Showing | None = None, sigma: float = TASK.smoothness_sigma
    ) -> None:
        self.graph, self.showing, self.sigma = graph, showing or Showing(), sigma
        self.warp: TurnWarp = turn_warp(graph)
        self.ground = ground_of(graph)


@dataclass(frozen=True, eq=False)
class Replay:
    """What came of one trace.

    Args:
        name: of the trace.
        followed: what was asked and shown.
        shown: measures of the poses.
        decision_us: the controller's choice at each tick, microseconds.  # (K,)
        tick_us: choice, step and show, microseconds.  # (K,)
    """

    name: str
    followed: Followed
    shown: Shown
    decision_us: NDArray[np.float64]
    tick_us: NDArray[np.float64]


def replay(trace: Trace, contender: Contender, stage: Stage, most_ticks: int | None = None) -> Replay:
    """Let a character follow a trace, from a frame that stands, facing along the view.

    A behaviour that no frame shows cannot be asked of a controller: it is asked to walk in place of run, and at
    any other such tick to go on with what it was last asked for. The score still holds it against the trace.

    Args:
        trace: the player.
        contender: what chooses moves.
        stage: of the contender's graph.
        most_ticks: stop after so many ticks.

    Raises:
        InputError: for a graph without a frame of any behaviour, and a trace that asks for none that it shows.
    """
    commands, asked = asked_of(trace, contender.graph, contender.present)
    commands, asked = commands.first(most_ticks), asked[:most_ticks]
    graph = stage.graph
    controller = contender.knowing(commands.heading, asked) if isinstance(contender, Foreseeing) else contender
    first = graph.behaviours.index(spawn_behaviour(contender.present))
    ran = _run(stage, controller, commands.heading, going_on(asked, first))
    poses = shown(graph, ran.target, ~ran.natural, ran.root, ran.rotations, stage.ground)
    return Replay(trace.name, _followed(stage, commands, ran), poses, ran.decision_ns / 1e3, ran.tick_ns / 1e3)


@dataclass(frozen=True, eq=False)
class _Run:
    """What the world went through: moves, facings, poses and times of K ticks."""

    source: NDArray[np.int32]
    edge: NDArray[np.int32]
    target: NDArray[np.int32]
    adjustment: NDArray[np.float64]
    natural: NDArray[np.bool_]
    facing: NDArray[np.float64]
    root: NDArray[np.float32]
    rotations: NDArray[np.float32]
    decision_ns: NDArray[np.int64]
    tick_ns: NDArray[np.int64]


def _run(stage: Stage, controller: Controller, heading: NDArray, asked: NDArray) -> _Run:
    graph, ticks = stage.graph, len(heading)
    run = _room(ticks, graph.skeleton.joint_count)
    world = stage.showing.world(graph, 1)
    controller.begin(world.spawn(controller.start_node(spawn_behaviour(controller.present)), 0.0, 0.0, 0.0))
    moves, slots, clock = no_moves(1), np.zeros(1, np.intp), time.perf_counter_ns
    for tick in range(ticks):
        run.source[tick] = world.node[0]
        wanted, behaviour = heading[tick : tick + 1], asked[tick : tick + 1]
        began = clock()
        controller.choose(Situations(slots, world.node, world.place, wanted, behaviour), moves)
        chosen = clock()
        world.step(moves)
        root, rotations = world.show(1.0)
        run.tick_ns[tick], run.decision_ns[tick] = clock() - began, chosen - began
        run.edge[tick], run.target[tick], run.natural[tick] = moves.edge[0], moves.target[0], moves.natural[0]
        run.adjustment[tick], run.facing[tick] = moves.adjustment[0], world.place[0, 2]
        run.root[tick], run.rotations[tick] = root[0], rotations[0]
    return run


def _room(ticks: int, joints: int) -> _Run:
    return _Run(
        source=np.empty(ticks, np.int32),
        edge=np.empty(ticks, np.int32),
        target=np.empty(ticks, np.int32),
        adjustment=np.empty((ticks, 3)),
        natural=np.empty(ticks, np.bool_),
        facing=np.empty(ticks),
        root=np.empty((ticks, 3), np.float32),
        rotations=np.empty((ticks, joints, 4), np.float32),
        decision_ns=np.empty(ticks, np.int64),
        tick_ns=np.empty(ticks, np.int64),
    )


def _followed(stage: Stage, commands: SteeringCommands, run: _Run) -> Followed:
    graph = stage.graph
    names = [BEHAVIOURS.index(name) if name in BEHAVIOURS else -1 for name in graph.behaviours]
    return Followed(
        heading=commands.heading,
        behaviour=commands.behaviour,
        jump=commands.jump,
        facing=run.facing,
        shown=np.array([*names, -1], np.int32)[graph.behaviour[run.target]],
        cost=charges(graph, stage.warp, run.source, run.edge, run.target, run.adjustment, stage.sigma),
        switched=~run.natural,
        turned=(run.adjustment != 0.0).any(axis=1),
    )
