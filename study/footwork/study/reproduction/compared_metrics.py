"""What the rows on metrics share: the sets of motion, each metric's ranking and the slide of its picks."""

from collections.abc import Sequence
from dataclasses import dataclass

from footwork.motion.clip import Clip
from footwork.motion.frame_tables import read_ranges, rows_of_set
from footwork.motion.metric import Metric
from footwork.motion.metrics import NAMES, metric_of
from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.row import Cause, Result, unjudged
from footwork.study.reproduction.workbench import Workbench
from footwork.study.transition_picks import Ranking, ranked_by
from footwork.study.transition_slide import TransitionSlide, slide_of_picks

METRICS = NAMES
RIVALS = ("uniform", "torso")  # the paper's two heuristics, as ours are called
MOST = 200  # places kept of each ranking
RESAMPLED = (
    "Captures of 120 Hz are taken at 30 Hz by keeping every fourth frame, so windows and blends of a third of a second "
    "have 11 frames; contacts are found at 30 Hz."
)
ALIGNED = (
    "Blends: a third of a second, the metric's own window, laid by the metric's own alignment, in both directions; "
    "places within 8 frames of a clip's end have no room for one and are left out before ranking."
)
INTERVALS = "In brackets: 95 % intervals by drawing the picks again 4,000 times."


@dataclass(frozen=True)
class MetricSet:
    """A set of motion for metrics.

    Args:
        name: what to call it.
        folder: where its files lie.
        whole: whether all of each file counts, or its core ranges.
        count: how many transitions are compared between metrics: as many as the paper takes from the set like it.
        like: that set of the paper, "" for none.
        ending: of the files that count.
        large: whether a quick run does without it.
    """

    name: str
    folder: str
    whole: bool
    count: int
    like: str = ""
    ending: str = ""
    large: bool = False


_FIGHTING, _REACTION = matsunaga_zordan.FIGHTING, matsunaga_zordan.REACTION
SEQUENCE = MetricSet("fighting, one sequence", "fighting", False, matsunaga_zordan.KNEES[_FIGHTING], _FIGHTING)
REACTIONS = MetricSet("reactions", "reactions", True, matsunaga_zordan.KNEES[_REACTION], _REACTION)
FIGHTS = MetricSet("fighting, all files", "fighting", True, matsunaga_zordan.KNEES[_FIGHTING], _FIGHTING, large=True)
ONE_SOURCE = MetricSet(
    "reactions, one source", "reactions", True, matsunaga_zordan.KNEES[_REACTION], _REACTION, ending=".amc"
)
WALKING = MetricSet("walking", "dataset1", True, matsunaga_zordan.KNEES[_REACTION])
MAIN = (SEQUENCE, REACTIONS)


def sets_of(bench: Workbench, wanted: Sequence[MetricSet] = (*MAIN, FIGHTS)) -> list[MetricSet]:
    """Those of some sets that the motions have; without large ones in a quick run."""
    return [one for one in wanted if _is_there(bench, one) and not (bench.quick and one.large)]


def _is_there(bench: Workbench, one: MetricSet) -> bool:
    folder = bench.motions.folder / one.folder
    if not folder.is_dir() or not any(path.name.endswith(one.ending) for path in folder.iterdir()):
        return False
    return one.whole or bool(rows_of_set(read_ranges(bench.motions.ranges), one.folder))


def none_there(*claims: str) -> Result:
    """What a row says where there are none of its sets."""
    reason = "The motions have neither a folder fighting with a core range nor one reactions."
    return Result([unjudged(claim, reason, Cause.DATA) for claim in claims])


def clips_of(bench: Workbench, one: MetricSet) -> Sequence[Clip]:
    """The clips of a set."""
    return [clip for clip in bench.dataset(one.folder, whole=one.whole).clips if clip.name.endswith(one.ending)]


def lengths_of(bench: Workbench, one: MetricSet) -> list[int]:
    """Frames of each of them."""
    return [clip.frame_count for clip in clips_of(bench, one)]


def metric_for(bench: Workbench, one: MetricSet, name: str) -> Metric:
    """A metric over a set."""
    return bench.once(("metric", one, name), lambda: metric_of(name, clips_of(bench, one)))


def ranking_of(bench: Workbench, one: MetricSet, name: str) -> Ranking:
    """A metric's ranking of the places for transitions in a set."""

    def rank() -> Ranking:
        bench.tell(f"{one.name}: {name} metric", 0.0)
        return ranked_by(metric_for(bench, one, name), lengths_of(bench, one), MOST)

    return bench.once(("ranking", one, name), rank)


def slide_of(
    bench: Workbench, one: MetricSet, name: str, count: int | None = None, laid_by: str | None = None
) -> TransitionSlide:
    """The slide of a metric's picks: up to its knee or so many, laid by its own alignment or another metric's."""
    ranked = ranking_of(bench, one, name)
    count = count or ranked.knee_rank
    metric = metric_for(bench, one, laid_by or name)

    def measure() -> TransitionSlide:
        return slide_of_picks(clips_of(bench, one), ranked.first(count), metric)

    return bench.once(("slide", one, name, count, laid_by or name), measure)
