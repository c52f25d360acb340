"""Characters that recorded players steer: bundles of one set of motion under many settings, and how each scores."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from footwork.controllers.controller import present_behaviours
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.graph import MotionGraph
from footwork.motion.mirror import mirrored
from footwork.motion.task import BEHAVIOURS, SteeringTask
from footwork.motion.trace import SOURCE_HZ, Trace, read_trace
from footwork.study.contender import Contender
from footwork.study.motion_matching.tuning import split
from footwork.study.reproduction.workbench import Workbench
from footwork.study.scoring import score
from footwork.study.showing import Showing
from footwork.training.dataset import Dataset, load_clips
from footwork.training.graph_options import GraphOptions
from footwork.training.player_model import learned
from footwork.training.stages import Stages
from footwork.training.standard_recipe import build_standard
from footwork.training.value_iteration import solve
from footwork.training.well_connected_recipe import build_well_connected

STANDARD, WELL_CONNECTED = "standard", "well-connected"
QUICK_SET, QUICK_SECONDS, QUICK_TRACES = "dataset1", 20.0, 2
WALK_JUMP_STOP = "walk_jump_stop_ranges.csv"
NO_TRACES = "The run was given no folder of recorded players (--traces)."


@dataclass(frozen=True)
class Setting:
    """How a character is made.

    Args:
        graph: STANDARD or WELL_CONNECTED.
        threshold: of its transitions.
        mirror: whether clips are played with left and right exchanged, too.
        warp: the largest extra turn of a tick, degrees, whatever a frame shows.
        bridges: ways from every frame to each other behaviour (``GraphOptions.bridges``).
        reward: of its policy (``SteeringTask.reward``).
        weight: of the transition quality, where the reward is a sum.
    """

    graph: str
    threshold: float
    mirror: bool = False
    warp: float = 0.0
    bridges: int = 0
    reward: str = "product"
    weight: float = 1.0

    @property
    def options(self) -> GraphOptions:
        """How its graph is built."""
        only: dict[str, Any] = {"mu": 5.0} if self.graph == WELL_CONNECTED else {}
        return GraphOptions(self.graph, self.threshold, mirror=self.mirror, bridges=self.bridges, **only)

    @property
    def task(self) -> SteeringTask:
        """What its policy is solved for."""
        everywhere: dict[str, float] = dict.fromkeys(BEHAVIOURS, 1.0)
        warp = math.radians(self.warp)
        return SteeringTask(reward=self.reward, weight=self.weight, warp=warp, warp_share=everywhere)

    @property
    def words(self) -> str:
        """Such as ``mirrored, warped``."""
        marks = [(self.mirror, "mirrored"), (self.warp > 0.0, "warped"), (self.bridges > 0, "bridged")]
        return ", ".join(word for holds, word in marks if holds) or "plain"


def players_of(bench: Workbench) -> list[Trace]:
    """The recorded players by name; in a quick run the first seconds of two.

    Raises:
        InputError: for a folder of fewer than two traces, or one that cannot be read.
    """

    def read() -> list[Trace]:
        paths = sorted(bench.traces.glob("*.csv"))
        if len(paths) < 2:
            problem = f"{len(paths)} CSV files in it, expected traces to learn from and others to score"
            raise InputError(problem, bench.traces)
        traces = [read_trace(path) for path in paths]
        short = round(QUICK_SECONDS * SOURCE_HZ)
        return [beginning(trace, short) for trace in traces[:QUICK_TRACES]] if bench.quick else traces

    return bench.once("players", read)


def unseen(bench: Workbench) -> list[Trace]:
    """The players that characters are scored by: no policy learned from them, and no rival was tuned on them."""
    return split(players_of(bench))[1]


def beginning(trace: Trace, ticks: int) -> Trace:
    """The first so many ticks of the recording."""
    arrays = ("forward", "strafe", "run", "yaw_delta", "attack", "use")
    return replace(trace, **{name: getattr(trace, name)[:ticks] for name in arrays})


def motions_of(bench: Workbench, name: str, ranges: str | None = None) -> Dataset:
    """A set's core ranges, or those of another table of the motions' folder; in a quick run a small set's."""
    if bench.quick:
        return bench.dataset(QUICK_SET)
    if ranges is None:
        return bench.dataset(name)
    folder = bench.motions.folder

    def read() -> Dataset:
        return load_clips(folder / name, labels=bench.motions.labels, ranges=folder / ranges)

    return bench.once(("dataset", name, ranges), read)


def bundle_of(bench: Workbench, motions: Dataset, setting: Setting) -> Bundle | None:
    """The bundle of a setting, None where its graph cannot be walked without end.

    Its policy has learned from every other player how they change their mind.
    """
    graph = graph_of(bench, motions, setting.options)
    if graph is None:
        return None

    def solved() -> Bundle:
        player = learned(split(players_of(bench))[0], setting.task, present_behaviours(graph))
        table = solve(graph, setting.task, player=player, progress=lambda share: bench.tell("policy", share))
        return Bundle(graph, {"steering": table.require_converged().compact})

    return bench.once(("bundle", id(motions), setting), solved)


def graph_of(bench: Workbench, motions: Dataset, options: GraphOptions) -> MotionGraph | None:
    """A motion graph, None where it cannot be walked without end; each is built once."""

    def build() -> MotionGraph | None:
        clips = [*motions.clips, *map(mirrored, motions.clips)] if options.mirror else motions.clips
        recipe = build_well_connected if options.graph == WELL_CONNECTED else build_standard
        try:
            return recipe(clips, options, SteeringTask(), Stages(bench.tell)).graph
        except InputError as error:
            if "without end" not in str(error):
                raise
            return None

    return bench.once(("graph", id(motions), options), build)


def score_of(
    bench: Workbench,
    bundle: Bundle,
    contender: Contender | None = None,
    showing: Showing | None = None,
    players: Sequence[Trace] = (),
) -> dict[str, Any]:
    """How a bundle's character, or another contender, follows players: the unseen ones where none are named."""
    return score(bundle, players or unseen(bench), contender, showing=showing, progress=bench.tell)
