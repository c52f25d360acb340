"""Tables of foot skate: a line for each metric, blends beside their sources, with intervals."""

from collections.abc import Mapping, Sequence

from footwork.study.bootstrap import Estimate
from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.row import OURS, PUBLISHED, Cell, Column, Table
from footwork.study.slide_figures import FIGURES

SOURCES = "their sources"
MAIN_FIGURES = FIGURES[:2]  # those that the paper prints
Figures = Mapping[str, tuple[Estimate, Estimate]]  # in the blends and in their sources, by figure


def main_table(caption: str, found: Mapping[str, Figures], counts: Mapping[str, int], like: str) -> Table:
    """The two figures of the paper's table, ours beside its own and beside the sources.

    Args:
        caption: of the table.
        found: figures by metric.
        counts: picks by metric.
        like: the paper's set; "" for none.
    """
    columns = [Column("metric"), Column("picks", "", OURS)]
    for figure in MAIN_FIGURES:
        columns += [Column(figure.name, figure.unit, PUBLISHED, 1)] if like else []
        columns += [Column(figure.name, figure.unit, OURS), Column(SOURCES, figure.unit, OURS)]
    lines: list[list[Cell]] = []
    for name, figures in found.items():
        line: list[Cell] = [name, counts[name]]
        for figure in MAIN_FIGURES:
            line += [published(name, figure.name, like)] if like else []
            line += [estimate.words() for estimate in figures[figure.name]]
        lines.append(line)
    return Table(caption, columns, lines)


def other_table(caption: str, found: Mapping[str, Figures]) -> Table:
    """The other figures: blends, then their sources."""
    figures = FIGURES[len(MAIN_FIGURES) :]
    columns = [Column("metric")]
    for figure in figures:
        columns += [Column(figure.name, figure.unit, OURS), Column(SOURCES, figure.unit, OURS)]
    lines: list[list[Cell]] = [
        [name, *(estimate.words() for figure in figures for estimate in of[figure.name])] for name, of in found.items()
    ]
    return Table(caption, columns, lines)


def gains_table(caption: str, found: Sequence[tuple[str, str, Mapping[str, Estimate]]]) -> Table:
    """How much less or more the dynamics metric's picks skate than another's: (set, other, gains)."""
    columns = [Column("set"), Column("against")] + [Column(figure.name, "%", OURS) for figure in FIGURES]
    lines: list[list[Cell]] = [
        [where, other, *(in_percent(gain[figure.name]) for figure in FIGURES)] for where, other, gain in found
    ]
    return Table(caption, columns, lines)


def in_percent(estimate: Estimate) -> str:
    """A share as a signed percentage with its interval."""
    if estimate.value is None or estimate.low is None or estimate.high is None:
        return "–"
    return f"{100 * estimate.value:+.0f} ({100 * estimate.low:+.0f} to {100 * estimate.high:+.0f})"


def published(name: str, figure: str, like: str) -> float | None:
    """The paper's number for one of our metrics, where it has one."""
    table = {"start to end": matsunaga_zordan.START_TO_END, "arc length": matsunaga_zordan.ARC_LENGTH}[figure]
    heuristic = matsunaga_zordan.HEURISTICS.get(name)
    return table[like][heuristic] if like and heuristic else None
