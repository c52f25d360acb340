"""What rows work on: the motions and what is computed from them, each made once and kept for the rows to come."""

from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any, TypeVar

from footwork.errors import InputError
from footwork.study.reproduction.flat_graph import FlatGraph
from footwork.study.reproduction.graphs import Graphs
from footwork.study.reproduction.motion_sets import MotionSets
from footwork.study.reproduction.survey import Survey, survey
from footwork.training.dataset import Dataset, load_clips

Progress = Callable[[str, float], None]
Made = TypeVar("Made")
MG, WCMG = "MG", "wcMG"  # standard and well-connected graphs, as the paper abbreviates them
LARGE = "dataset3"  # the set whose well-connected graph takes minutes
WEIGHTS = 9  # between two segments: always of the small sets, at most of the large one, which has as many as needed
BUILT_AT = 0.2  # threshold at which graphs are reduced
LARGE_UP_TO = 0.8  # threshold to which the well-connected graph of the large set is built whole
SMALL_UP_TO = 6.0  # that of the small sets: the highest in the paper's tables


class Workbench:
    """The motions of a run and what rows share.

    Args:
        motions: the three sets.
        traces: folder of recorded players' traces, None where there is none.
        quick: whether to leave out what takes minutes: the well-connected graph of the large set.
        progress: told what is being done and the share of it that is done.
    """

    def __init__(
        self, motions: MotionSets, *, traces: Path | None = None, quick: bool = False, progress: Progress | None = None
    ) -> None:
        self.motions = motions
        self.quick = quick
        self.tell: Progress = progress or (lambda what, share: None)
        self._traces = traces
        self._made: dict[Hashable, Any] = {}

    @property
    def has_traces(self) -> bool:
        """Whether the run was given a folder of recorded players' traces."""
        return self._traces is not None

    @property
    def traces(self) -> Path:
        """The folder of recorded players' traces.

        Raises:
            InputError: where the run was given none.
        """
        if self._traces is None:
            raise InputError("this row replays recorded players, expected a folder of their traces", "--traces")
        return self._traces

    @property
    def notes(self) -> list[str]:
        """What every row on well-connected graphs should say of them."""
        few = f"; those of {LARGE} have as many of them as hops under the threshold need"
        return [
            "MG is the standard graph, wcMG the well-connected one: interpolated between two segments of which neither "
            f"lasts over twice as long as the other, with {WEIGHTS} weights between them{'' if self.quick else few}.",
            *([f"A quick run: the well-connected graph of {LARGE} was left out."] if self.quick else []),
        ]

    def once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """What ``make`` makes, made the first time and kept under ``key``."""
        if key not in self._made:
            self._made[key] = make()
        return self._made[key]

    def dataset(self, name: str, *, whole: bool = False) -> Dataset:
        """A set's core ranges, or all frames of all its files, as clips on its people's common body."""

        def read() -> Dataset:
            self.tell(f"reading {name}", 0.0)
            ranges = None if whole else self.motions.ranges
            return load_clips(self.motions.folder / name, labels=self.motions.labels, ranges=ranges)

        return self.once(("dataset", name, whole), read)

    def attribution(self) -> list[str]:
        """What the licences of all motions read so far ask to have shown, a line each."""
        read = [made for made in self._made.values() if isinstance(made, Dataset)]
        return list(dict.fromkeys(line for dataset in read for line in dataset.attribution))

    def graphs(self, name: str, threshold: float = BUILT_AT) -> Graphs:
        """The graphs of a set's core ranges; those of the large set are others at each threshold."""
        hops = threshold if name == LARGE else None
        up_to = threshold if name == LARGE else SMALL_UP_TO

        def begin() -> Graphs:
            return Graphs(name, self.dataset(name).clips, WEIGHTS, self.tell, searched_to=up_to, hops=hops)

        return self.once(("graphs", name, hops), begin)

    def wanted(self, kind: str, name: str, threshold: float) -> bool:
        """Whether a graph is built whole in this run."""
        if kind == MG:
            return True
        return threshold <= self.up_to(name)

    def up_to(self, name: str) -> float:
        """The highest threshold at which a set's well-connected graph is built whole; 0 where none is."""
        if name == LARGE:
            return 0.0 if self.quick else LARGE_UP_TO
        return SMALL_UP_TO

    def survey(self, kind: str, name: str, threshold: float) -> Survey | None:
        """What is measured on a graph, None where this run does not build it."""
        if not self.wanted(kind, name, threshold):
            return None
        graphs = self.graphs(name) if kind == MG else self.graphs(name, threshold)
        make = graphs.standard if kind == MG else graphs.well_connected
        return self._surveyed(kind, graphs, threshold, make)

    def surveys(self, name: str, threshold: float) -> tuple[Survey | None, Survey | None]:
        """Those of the standard and of the well-connected graph."""
        return self.survey(MG, name, threshold), self.survey(WCMG, name, threshold)

    def share(self, kind: str, name: str, threshold: float) -> float | None:
        """Share of the captured frames in the largest connected part, None where this run cannot tell."""
        if kind == WCMG and name == LARGE and self.quick:
            return None
        found = self.survey(kind, name, threshold)
        return found.share if found else self.once(("share", name, threshold), lambda: self._share(name, threshold))

    def _share(self, name: str, threshold: float) -> float:
        graphs = self.graphs(name, LARGE_UP_TO)
        return graphs.share_beyond(graphs.well_connected(LARGE_UP_TO), threshold)

    def _surveyed(self, kind: str, graphs: Graphs, threshold: float, make: Callable[[float], FlatGraph]) -> Survey:
        def measure() -> Survey:
            with graphs.stages(f"{kind} at {threshold:g}"):
                return survey(make(threshold))

        return self.once(("survey", kind, id(graphs), threshold), measure)
