"""The single fighting sequence at the rate of its capture, as the paper compared its frames."""

from footwork.motion.frame_tables import read_ranges, rows_of_set
from footwork.motion.metrics import metric_of
from footwork.study.full_rate import FullRate, full_rate_of, full_rate_ranking, phases_of
from footwork.study.reproduction.compared_metrics import MOST, SEQUENCE, sets_of
from footwork.study.reproduction.workbench import Workbench
from footwork.study.transition_picks import Ranking
from footwork.study.transition_slide import TransitionSlide, slide_of_picks

COMPARED = ("uniform", "torso", "dynamics")


def full_rate(bench: Workbench) -> FullRate | None:
    """The sequence's clips; None in a quick run, and where it is not there as one stretch above 30 Hz."""
    if bench.quick or not sets_of(bench, [SEQUENCE]):
        return None
    parts = rows_of_set(read_ranges(bench.motions.ranges), SEQUENCE.folder)
    phases = phases_of(float(bench.dataset(SEQUENCE.folder).files[0]["source_fps"]))
    if len(parts) != 1 or phases == 1:
        return None
    folder = bench.motions.folder / SEQUENCE.folder
    return bench.once("full rate", lambda: full_rate_of(folder, parts[0], phases))


def at_full_rate(bench: Workbench, capture: FullRate, name: str) -> tuple[Ranking, TransitionSlide]:
    """A metric's ranking over all captured frames, and the slide of as many picks as the paper takes."""

    def rank() -> tuple[Ranking, TransitionSlide]:
        bench.tell(f"{SEQUENCE.name} at full rate: {name} metric", 0.0)
        metric = metric_of(name, capture.clips)
        ranking = full_rate_ranking(metric.all_pairs(), capture, MOST)
        return ranking, slide_of_picks(capture.clips, ranking.first(SEQUENCE.count), metric)

    return bench.once(("at full rate", name), rank)
