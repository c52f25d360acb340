"""The page: every row with its claim, verdict, tables and pictures, in one HTML file that needs nothing else."""

import base64
from collections.abc import Mapping, Sequence
from html import escape
from itertools import groupby
from typing import Any

from footwork.study.reproduction.outcome import Outcome, Status
from footwork.study.reproduction.row import PUBLISHED, Cell, Column, Figure, Judgement, Table, Verdict
from footwork.study.web_page import web_page

_CLASS = {Verdict.HOLDS: "holds", Verdict.FAILS: "fails", Verdict.OPEN: "open"}


def page_of(outcomes: Sequence[Outcome], about: Mapping[str, Any]) -> str:
    """The page of a run; ``about`` is what the JSON file says of the run as a whole (``run.about``)."""
    body = "\n".join([_head(about), _overview(outcomes), *map(_paper, _by_paper(outcomes)), _foot(about)])
    return web_page("The papers, reproduced", body)


def _head(about: Mapping[str, Any]) -> str:
    state = (
        "" if about["complete"] else " <strong>This run is not complete: rows that it has not reached say so.</strong>"
    )
    return (
        "<h1>The papers, reproduced</h1>\n"
        '<p class="lead">Each row is a table, a figure or a statement of a paper, made again from motion capture by '
        f"footwork {escape(about['version'])} and put beside the published numbers (shaded columns, dashed lines). "
        "The capture is not that of the papers: it is chosen to be of the same kinds and sizes, so what should agree "
        f"is which graph is ahead, and how things grow.{state}</p>"
    )


def _overview(outcomes: Sequence[Outcome]) -> str:
    lines = [
        f'<tr><td><a href="#{escape(outcome.row.name)}">{escape(outcome.row.name)}</a></td>'
        f"<td>{escape(outcome.row.title)}</td><td>{_badges(outcome)}</td></tr>"
        for outcome in outcomes
    ]
    head = "<thead><tr><th>row</th><th>what it is about</th><th>its claims</th></tr></thead>"
    return f'<table class="overview">{head}<tbody>\n' + "\n".join(lines) + "\n</tbody></table>"


def _badges(outcome: Outcome) -> str:
    if outcome.status is not Status.DONE:
        return _badge(outcome.status.value, "failed" if outcome.status is Status.FAILED else "context")
    verdicts = [judgement.verdict for judgement in outcome.result.judgements]
    if not verdicts:
        return _badge("context", "context")
    counts = [(verdict, verdicts.count(verdict)) for verdict in Verdict if verdict in verdicts]
    several = len(verdicts) > 1
    return " ".join(
        _badge(f"{count} × {verdict}" if several else verdict, _CLASS[verdict]) for verdict, count in counts
    )


def _badge(words: str, kind: str) -> str:
    return f'<span class="badge {kind}">{escape(words)}</span>'


def _by_paper(outcomes: Sequence[Outcome]) -> list[list[Outcome]]:
    return [list(group) for _, group in groupby(outcomes, key=lambda outcome: outcome.row.paper)]


def _paper(outcomes: Sequence[Outcome]) -> str:
    paper = outcomes[0].row.paper
    title = f"<h2>{escape(paper.authors)} ({paper.year}): {escape(paper.title)}</h2>"
    return "\n".join([title, *map(_row, outcomes)])


def _row(outcome: Outcome) -> str:
    row, result = outcome.row, outcome.result
    parts = [
        f'<section class="row" id="{escape(row.name)}">',
        f'<header><span class="name">{escape(row.name)}</span><h3>{escape(row.title)}</h3>'
        f'<span class="place">{escape(row.place)} · {_duration(outcome)}</span></header>',
        f'<p class="claim">{escape(row.claim)}</p>',
        _judgements(outcome),
        f'<div class="tables">{"".join(map(_table, result.tables))}</div>',
        *map(_figure, result.figures),
    ]
    if result.notes:
        parts.append('<ul class="notes">' + "".join(f"<li>{escape(note)}</li>" for note in result.notes) + "</ul>")
    return "\n".join([*parts, "</section>"])


def _duration(outcome: Outcome) -> str:
    return f"{outcome.seconds:.1f} s" if outcome.status is not Status.WAITING else Status.WAITING.value


def _judgements(outcome: Outcome) -> str:
    if outcome.status is Status.FAILED:
        lines = [_line(_badge("failed", "failed"), "This row could not be made.", outcome.error)]
    else:
        lines = [_judgement(judgement) for judgement in outcome.result.judgements]
    return f'<ul class="judgements">{"".join(lines)}</ul>' if lines else ""


def _judgement(judgement: Judgement) -> str:
    cause = f" Cause: {judgement.cause.value}." if judgement.cause else ""
    badge = _badge(judgement.verdict, _CLASS[judgement.verdict])
    return _line(badge, judgement.claim, judgement.reason + cause)


def _line(badge: str, claim: str, reason: str) -> str:
    return f'<li>{badge}<div><p>{escape(claim)}</p><p class="reason">{escape(reason)}</p></div></li>'


def _table(table: Table) -> str:
    worded = [any(isinstance(row[place], str) for row in table.rows) for place in range(len(table.columns))]
    head = _groups(table.columns) + "<tr>" + "".join(map(_heading, table.columns, worded)) + "</tr>"
    lines = "\n".join(_cells(row, table.columns) for row in table.rows)
    caption = f"<caption>{escape(table.caption)}</caption>"
    return f'<div class="scroll"><table>{caption}<thead>{head}</thead><tbody>\n{lines}\n</tbody></table></div>'


def _groups(columns: Sequence[Column]) -> str:
    """A line of headings over the columns that belong together, where any do."""
    if not any(column.group for column in columns):
        return ""
    spans = [(group, len(list(members))) for group, members in groupby(column.group for column in columns)]
    cells = (f'<th colspan="{count}"{_shade(group)}>{escape(group)}</th>' for group, count in spans)
    return '<tr class="groups">' + "".join(cells) + "</tr>"


def _shade(group: str) -> str:
    return ' class="published"' if group == PUBLISHED else ""


def _heading(column: Column, worded: bool) -> str:
    unit = f' <span class="unit">{escape(column.unit)}</span>' if column.unit else ""
    return f"<th{_kinds(column, worded)}>{escape(column.name)}{unit}</th>"


def _kinds(column: Column, worded: bool) -> str:
    """The classes of a cell: shaded where published, to the left where it holds words."""
    kinds = [PUBLISHED] * (column.group == PUBLISHED) + ["words"] * worded
    return f' class="{" ".join(kinds)}"' if kinds else ""


def _cells(row: Sequence[Cell], columns: Sequence[Column]) -> str:
    cells = (_cell(cell, column) for cell, column in zip(row, columns, strict=True))
    return "<tr>" + "".join(cells) + "</tr>"


def _cell(cell: Cell, column: Column) -> str:
    return f"<td{_kinds(column, isinstance(cell, str))}>{escape(shown(cell, column.digits))}</td>"


def shown(cell: Cell, digits: int) -> str:
    """A cell as it is printed: numbers with thousands apart, a dash for what there is none of."""
    if cell is None:
        return "–"
    if isinstance(cell, float):
        return f"{cell:,.{digits}f}"
    return cell if isinstance(cell, str) else f"{cell:,}"


def _figure(figure: Figure) -> str:
    alt = escape(figure.alt)
    if figure.svg:
        picture = figure.svg.replace("<svg", f'<svg role="img" aria-label="{alt}"', 1)
    else:
        picture = f'<img alt="{alt}" src="data:image/png;base64,{base64.b64encode(figure.png).decode()}">'
    return f"<figure>{picture}<figcaption>{escape(figure.caption)}</figcaption></figure>"


def _foot(about: Mapping[str, Any]) -> str:
    thanks = "".join(f"<p>{escape(line)}</p>" for line in about["attribution"])
    return (
        f"<footer><p>Made by <code>{escape(about['command'])}</code> in {about['seconds']:.0f} s on {about['cores']} "
        f"cores, {about['peak_rss_mb']:,.0f} MB at most. The formulas and what is our own choice in them stand in "
        f"docs/conventions.md; all numbers are in <code>reproduction.json</code> beside this page.</p>{thanks}</footer>"
    )
