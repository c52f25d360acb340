"""What became of the rows of one run: done, failed, or not reached; and all of it as JSON-able numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any

from footwork.study.reproduction.row import Result, Row, Table, Verdict


class Status(StrEnum):
    """How far a row came."""

    WAITING = "not reached"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True)
class Outcome:
    """A row and what became of it; ``error`` says in a line why it failed."""

    row: Row
    status: Status = Status.WAITING
    result: Result = field(default_factory=Result)
    error: str = ""
    seconds: float = 0.0

    @property
    def verdict(self) -> Verdict | None:
        """Of all claims of the row together: one that fails outweighs one that is open; None without claims."""
        verdicts = {judgement.verdict for judgement in self.result.judgements}
        return next((verdict for verdict in (Verdict.FAILS, Verdict.OPEN, Verdict.HOLDS) if verdict in verdicts), None)

    def numbers(self) -> dict[str, Any]:
        """The row as JSON-able numbers, without its pictures."""
        row, result = self.row, self.result
        return {
            "name": row.name,
            "paper": f"{row.paper.authors} ({row.paper.year})",
            "place": row.place,
            "title": row.title,
            "claim": row.claim,
            "status": self.status.value,
            "verdict": self.verdict.value if self.verdict else None,
            "judgements": [asdict(judgement) for judgement in result.judgements],
            "published": _keyed(row.published),
            "ours": _keyed(result.numbers),
            "tables": [_table(table) for table in result.tables],
            "notes": list(result.notes),
            "error": self.error or None,
            "seconds": round(self.seconds, 3),
        }


def report_of(outcomes: Sequence[Outcome], about: Mapping[str, Any]) -> dict[str, Any]:
    """The whole run as one JSON-able object: what is ``about`` it, then its rows."""
    return {**about, "rows": [outcome.numbers() for outcome in outcomes]}


def _keyed(value: Any) -> Any:
    """The same with keys that are words, as JSON has them."""
    if isinstance(value, Mapping):
        return {str(key): _keyed(item) for key, item in value.items()}
    return [_keyed(item) for item in value] if isinstance(value, list | tuple) else value


def _table(table: Table) -> dict[str, Any]:
    columns = [{"name": column.name, "unit": column.unit, "of": column.group} for column in table.columns]
    return {"caption": table.caption, "columns": columns, "rows": [list(row) for row in table.rows]}
