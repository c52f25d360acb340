"""Runs a server through exchanges with a raw peer, each of which holds it to a rule of SPEC.md."""

from collections.abc import Callable
from dataclasses import dataclass

from footwork.protocol.compliance import (
    bundle_checks,
    character_checks,
    fight_checks,
    refusal_checks,
    session_checks,
)
from footwork.protocol.compliance.peer import Dial, Failed, Line, Peer, SocketLine

__all__ = ["CHECKS", "Dial", "Failed", "Line", "Outcome", "Peer", "SocketLine", "run"]

CHECKS: dict[str, Callable[[Dial], None]] = {
    name: check
    for checks in (session_checks, bundle_checks, character_checks, fight_checks, refusal_checks)
    for name, check in vars(checks).items()
    if getattr(check, "__module__", "") == checks.__name__ and not name.startswith("_")
}
"""By name; the docstring of each says which rule."""


@dataclass(frozen=True)
class Outcome:
    """What came of a check.

    Args:
        name: the check's, a key of ``CHECKS``.
        problem: one line on what was wrong, empty where nothing was.
    """

    name: str
    problem: str


def run(dial: Dial, names: tuple[str, ...] = tuple(CHECKS)) -> list[Outcome]:
    """Run checks one after the other.

    Args:
        dial: makes a new line to the server.
        names: of the checks.
    """
    return [Outcome(name, _problem_of(CHECKS[name], dial)) for name in names]


def _problem_of(check: Callable[[Dial], None], dial: Dial) -> str:
    try:
        check(dial)
    except Failed as failed:
        return str(failed)
    return ""
