"""Controllers named on the command line, to be scored against one another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from footwork.cli.motions import AS_USUAL, Reading, load_motions
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.motion.bundle import Bundle
    from footwork.motion.table import PolicyTable
    from footwork.study.contender import Contender

TABLE, GREEDY, ORACLE, MATCHING = "table", "greedy", "oracle", "motion-matching"
CONTROLLERS = (TABLE, GREEDY, ORACLE, MATCHING)
FORMS = ("reference", "strong")  # those of study.motion_matching.forms


@Parameter(name="*")
@dataclass(frozen=True)
class Choice:
    """Which controller is scored, and how it is set.

    Args:
        controller: table (the bundle's policy), greedy (the best next tick), oracle (knows the trace: no controller can
            do better) or motion-matching (the usual alternative).
        foresight: How many seconds of the trace the oracle knows; all of it where not given.
        form: Motion matching as its reference implementation does it (reference), or at its best on traces (strong).
        motions: The capture that motion matching plays, as for build; the frames of the bundle's graph where not given.
        exact_facing: Turn right onto the heading where that is within the bundle's warp; --no-exact-facing keeps to the
            turns that the policy was solved with.
        shortlist: Look only at the best actions of the nearest headings; --no-shortlist looks at all and takes longer.
        leave_one_out: Score each trace by a policy whose player model learned from all the others.
    """

    controller: str = TABLE
    foresight: float | None = None
    form: str | None = None
    motions: str | None = None
    exact_facing: bool = True
    shortlist: bool = True
    leave_one_out: Annotated[bool, Parameter(negative=())] = False

    def __post_init__(self) -> None:
        _require_name(self.controller, CONTROLLERS, "--controller")
        if self.form is not None:
            _require_name(self.form, FORMS, "--form")
        self._only(self.foresight is not None, ORACLE, "--foresight")
        self._only(self.form is not None, MATCHING, "--form")
        self._only(self.motions is not None, MATCHING, "--motions")
        self._only(not self.exact_facing, TABLE, "--no-exact-facing")
        self._only(not self.shortlist, TABLE, "--no-shortlist")
        self._only(self.leave_one_out, TABLE, "--leave-one-out")

    def _only(self, given: bool, controller: str, option: str) -> None:
        if given and self.controller != controller:
            raise InputError(f"means nothing for --controller {self.controller}, only for {controller}", option)

    @property
    def title(self) -> str:
        """The controller and what sets it apart, for a person."""
        parts = [self.controller]
        if self.foresight is not None:
            parts.append(f"with {self.foresight:g} s of foresight")
        if self.controller == MATCHING:
            parts.append(f"({self.form or FORMS[0]} form)")
        if self.leave_one_out:
            parts.append("with each trace left out in turn")
        return " ".join(parts)

    def of(self, bundle: Bundle, reading: Reading = AS_USUAL) -> Contender:
        """The controller, on a bundle's graph or on frames of its own.

        Args:
            bundle: what is scored.
            reading: how ``motions`` are read.

        Raises:
            InputError: for a bundle that lacks what the controller needs, for motions that cannot be read, and for
                options of reading where there are none.
        """
        if self.motions is None and reading != AS_USUAL:
            raise InputError("no motions to read, expected --motions", "--labels, --ranges, --table, --bvh-unit")
        makers = {TABLE: self._table, GREEDY: self._greedy, ORACLE: self._oracle}
        if self.controller in makers:
            return makers[self.controller](bundle)
        return self._matching(bundle, reading)

    def steering(self, bundle: Bundle, table: PolicyTable) -> Contender:
        """The controller that plays a policy of its own."""
        from footwork.controllers.bundle_controller import bundle_controller

        table = table if self.shortlist else table.unlisted
        return bundle_controller(bundle, table=table, exact_facing=self.exact_facing)

    def _table(self, bundle: Bundle) -> Contender:
        return self.steering(bundle, bundle.table("steering"))

    def _greedy(self, bundle: Bundle) -> Contender:
        from footwork.study.greedy import greedy

        return greedy(bundle.graph, bundle.table("steering").task)

    def _oracle(self, bundle: Bundle) -> Contender:
        table = bundle.table("steering")
        if self.foresight is None:
            from footwork.study.oracle import Oracle

            return Oracle(bundle.graph, table.task)
        from footwork.study.foresight import Foresight

        return Foresight(bundle.graph, table, self.foresight)

    def _matching(self, bundle: Bundle, reading: Reading) -> Contender:
        from footwork.study.motion_matching.controller import MotionMatchingController
        from footwork.study.motion_matching.forms import FORMS as SETTINGS
        from footwork.study.motion_matching.forms import motion_matching

        form = self.form or FORMS[0]
        if self.motions is None:
            return MotionMatchingController(bundle.graph, SETTINGS[form])
        return motion_matching(load_motions(self.motions, reading).clips, form)


def _require_name(name: str, known: tuple[str, ...], option: str) -> None:
    if name not in known:
        raise InputError(f"{name!r} is none, there is {', '.join(known)}", option)
