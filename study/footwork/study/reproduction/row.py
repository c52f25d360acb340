"""What a row of the reproduction is: a claim of a paper, how to make it again, and what came of it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from footwork.study.reproduction.workbench import Workbench

Cell = str | int | float | None
OURS, PUBLISHED = "ours", "published"


class Verdict(StrEnum):
    """Whether a claim holds on the motions at hand."""

    HOLDS = "holds"
    FAILS = "does not hold"
    OPEN = "cannot be judged"


class Cause(StrEnum):
    """Why a claim does not hold, or cannot be judged."""

    DATA = "the data are of another kind"
    CONVENTION = "a convention that the paper leaves open"
    CLAIM = "the claim itself"


@dataclass(frozen=True)
class Judgement:
    """One claim, whether it holds, and the numbers that say so, each in a line."""

    claim: str
    verdict: Verdict
    reason: str
    cause: Cause | None = None


def judged(claim: str, holds: bool, reason: str, cause: Cause | None = None) -> Judgement:
    """A claim that holds or, because of ``cause``, does not."""
    return Judgement(claim, Verdict.HOLDS, reason) if holds else Judgement(claim, Verdict.FAILS, reason, cause)


def unjudged(claim: str, reason: str, cause: Cause | None = None) -> Judgement:
    """A claim that cannot be judged."""
    return Judgement(claim, Verdict.OPEN, reason, cause)


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Args:
        name: its heading, without the unit.
        unit: "" where there is none.
        group: what the column belongs to: OURS, PUBLISHED, or "" for what names the line.
        digits: shown after the point.
    """

    name: str
    unit: str = ""
    group: str = ""
    digits: int = 2


@dataclass(frozen=True)
class Table:
    """A table: a line of cells for each row, one for each column; None shows as a dash."""

    caption: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell]]


@dataclass(frozen=True)
class Figure:
    """A picture: an inline SVG (``charts``) or the bytes of a PNG, with a caption and words for who cannot see it."""

    caption: str
    alt: str
    svg: str = ""
    png: bytes = b""


@dataclass(frozen=True)
class Result:
    """What came of a row.

    Args:
        judgements: each claim of the row; none for what is context only.
        tables: with the published numbers beside ours.
        figures: pictures.
        numbers: JSON-able: our numbers by name.
        notes: what differs from the paper's experiment and what was left out, a sentence each.
    """

    judgements: Sequence[Judgement] = ()
    tables: Sequence[Table] = ()
    figures: Sequence[Figure] = ()
    numbers: Mapping[Any, Any] = field(default_factory=dict)
    notes: Sequence[str] = ()


@dataclass(frozen=True)
class Paper:
    """A paper: the letter that its rows' names begin with, and how to cite it."""

    letter: str
    authors: str
    year: int
    title: str


@dataclass(frozen=True)
class Row:
    """A table, figure or statement of a paper.

    Args:
        name: such as ``Z-T2``: the paper's letter, then the table or figure.
        order: where it stands among the paper's rows.
        paper: the paper.
        place: where in the paper, such as ``Table 2``.
        title: what it is about.
        claim: what the paper says, in a sentence.
        published: JSON-able: the paper's own numbers.
        run: makes it again.
    """

    name: str
    order: int
    paper: Paper
    place: str
    title: str
    claim: str
    published: Mapping[Any, Any]
    run: "Callable[[Workbench], Result]"
