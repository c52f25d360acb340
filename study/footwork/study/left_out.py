"""Honest scores: a policy is not tried on the players that its player model learned from."""

from collections.abc import Callable, Mapping, Sequence

from footwork.controllers.controller import present_behaviours
from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.player_model import PlayerModel
from footwork.motion.table import PolicyTable
from footwork.motion.trace import Trace
from footwork.training.player_model import learned
from footwork.training.value_iteration import solve


def require_unseen(table: PolicyTable, traces: Sequence[Trace]) -> None:
    """Nothing, where the table's player model learned from none of the traces.

    Raises:
        InputError: naming the first trace that it learned from, and its digest.
    """
    seen = _digests(table.player)
    for trace in traces:
        if trace.digest in seen:
            problem = f"the player model learned from it (SHA-256 {trace.digest}); expected other traces, or that each"
            raise InputError(f"{problem} is left out in turn (--leave-one-out)", trace.name)


def tables_without(
    graph: MotionGraph,
    table: PolicyTable,
    traces: Sequence[Trace],
    progress: Callable[[str, float], None] | None = None,
) -> Mapping[str, PolicyTable]:
    """For each trace, by its digest, the table of a player model that learned from all the others.

    A trace that the model did not learn from has the table as it is.

    Args:
        graph: that the table was solved on.
        table: the policy, with the player model.
        traces: those to score, among them all that the model learned from.
        progress: told what is being solved and the share that is done.

    Raises:
        InputError: for a table without a learned player model, a trace that the model learned from and that is not
            there, and where nothing is left to learn from.
    """
    seen = _digests(table.player)
    if not seen:
        raise InputError("no player model learned from traces, so there is none to leave out", "--leave-one-out")
    known = {trace.digest: trace for trace in traces if trace.digest in seen}
    _require_all(table.player, known)
    tables = {trace.digest: table for trace in traces}
    for done, digest in enumerate(known):
        others = [trace for trace in known.values() if trace.digest != digest]
        if not others:
            raise InputError(
                "the player model learned from it alone, so nothing is left without it", known[digest].name
            )
        player = learned(others, table.task, present_behaviours(graph))
        tell = _telling(progress, f"without {known[digest].name}", done, len(known))
        solved = solve(graph, table.task, player=player, start=table.values, progress=tell)
        tables[digest] = solved.require_converged().compact
    return tables


def _telling(
    progress: Callable[[str, float], None] | None, what: str, done: int, count: int
) -> Callable[[float], None] | None:
    return (lambda share: progress(what, (done + share) / count)) if progress else None


def _digests(player: PlayerModel | None) -> set[str]:
    return {file.digest for file in player.learned_from} if player else set()


def _require_all(player: PlayerModel | None, known: Mapping[str, Trace]) -> None:
    """Raise InputError, naming the first, unless every trace that was learned from is there."""
    for file in player.learned_from if player else ():
        if file.digest not in known:
            problem = "the player model learned from it, but it is not among the traces to score; expected all of them"
            raise InputError(problem, f"{file.name} (SHA-256 {file.digest})")
