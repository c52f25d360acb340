"""Characters of both kinds of graph against motion matching, and against knowing what the player will do."""

import math
import time
from dataclasses import replace
from typing import Any

from footwork.controllers.steering import SteeringController
from footwork.motion.bundle import Bundle
from footwork.motion.trace import SOURCE_HZ
from footwork.study.contender import Contender
from footwork.study.foresight import Foresight
from footwork.study.greedy import greedy
from footwork.study.intervals import scored_gain
from footwork.study.motion_matching.forms import FORMS, motion_matching
from footwork.study.oracle import Oracle
from footwork.study.replay import Stage, replay
from footwork.study.reproduction import beyond
from footwork.study.reproduction.character_tables import (
    Scores,
    characters_table,
    control_chart,
    heading_chart,
    interval_words,
    shares_table,
)
from footwork.study.reproduction.players import (
    NO_TRACES,
    QUICK_SET,
    STANDARD,
    WELL_CONNECTED,
    Setting,
    beginning,
    bundle_of,
    motions_of,
    score_of,
    unseen,
)
from footwork.study.reproduction.row import Cause, Figure, Judgement, Result, Row, judged, unjudged
from footwork.study.reproduction.workbench import LARGE, Workbench
from footwork.study.showing import Showing
from footwork.training.dataset import Dataset
from footwork.training.value_iteration import solve

WARP = 6.0
AIM = {"reward": "sum", "weight": 0.75}
THRESHOLDS, QUICK_THRESHOLDS = (0.2, 1.0, 5.0, 10.0), (1.0,)
BRIDGES, BRIDGED_AT = 8, 1.0
"""Chosen on the players that policies learn from, each left out in turn, and so were AIM and turns of all frames."""
_OPTIONS = ("plain", "warped", "mirrored, warped", "warped, bridged", "mirrored, warped, bridged")
FORESIGHTS = (0.25, 0.5, 1.0)
KNOWN_SECONDS = 10.0
CLAIMS = (
    f"The best character reaches a Total of {beyond.CONTROL:g}.",
    "Its Total is above that of the strong form of motion matching.",
    f"Its feet slide at most {beyond.SLIDE:g} times what its clips slide.",
    "It decides in a tenth of motion matching's time.",
    "Well-connected at 0.2 is above every standard graph under the same options.",
)


def run(bench: Workbench) -> Result:
    """Build every character, let each follow the players, and then the best one by other controllers."""
    if not bench.has_traces:
        return Result(judgements=[unjudged(claim, NO_TRACES) for claim in CLAIMS])
    motions = motions_of(bench, LARGE)
    made = {_words(setting): _made(bench, motions, setting) for setting in _settings(bench)}
    bundles = {name: bundle for name, (bundle, _) in made.items() if bundle}
    graphs: Scores = {name: score for name, (_, score) in made.items()}
    there = {name: score for name, score in graphs.items() if score}
    if not there:
        return Result(judgements=[unjudged(claim, "No graph could be walked without end.") for claim in CLAIMS])
    best = max(there, key=lambda name: there[name]["total"])
    bundle = bundles[best]
    rivals = {form: motion_matching(motions.clips, form) for form in FORMS}
    others = {f"motion matching, {form}": score_of(bench, bundle, rival) for form, rival in rivals.items()}
    others |= {name: score_of(bench, bundle, one) for name, one in _simpler(bundle).items()}
    known = _known(bench, bundle)
    return Result(
        judgements=_judgements(there, best, others),
        tables=[
            characters_table("Graphs, each with a policy that learned how players change their mind", graphs),
            characters_table(f"Other controllers, beside {best}", {best: there[best]} | others),
            characters_table(f"{best}: what each part is worth", _switches(bench, bundle)),
            shares_table(f"{best} over the first {KNOWN_SECONDS:g} s of each trace: knowing what will come", known),
        ],
        figures=[_chart(there, others), _headings(bench, bundle, rivals["strong"])],
        numbers={"graphs": graphs, "others": others, "known": known, "best": best},
        notes=[
            f"Of {LARGE}: walk, run, jump and stop. There is no well-connected graph of mirrored clips: its search "
            "takes sixteen times as long. Every policy has the same reward, a sum of control and smoothness. Warped is "
            f"by up to {WARP:g}° a tick, whatever a frame shows; bridged, with {BRIDGES} ways to each other behaviour. "
            "Scored are players whom no policy learned from and no form of motion matching was tuned on. "
            "Decision is the time of a choice for each of 256 characters at once; made in is what graph, policy and "
            "score took, a well-connected graph being built for the first of its characters.",
            *([f"A quick run: {QUICK_SET} in place of {LARGE}, and few seconds of two players."] * bench.quick),
        ],
    )


def _settings(bench: Workbench) -> list[Setting]:
    thresholds = QUICK_THRESHOLDS if bench.quick else THRESHOLDS
    plain = [Setting(STANDARD, at, **AIM) for at in thresholds] + [Setting(WELL_CONNECTED, 0.2, **AIM)]
    warped = [replace(one, warp=WARP) for one in plain]
    mirrored = [replace(one, mirror=True) for one in warped if one.graph == STANDARD]
    bridged = [replace(one, bridges=BRIDGES) for one in warped + mirrored if _bridges_tell(one)]
    return [*plain, *warped, *mirrored, *bridged]


def _bridges_tell(setting: Setting) -> bool:
    """Whether bridges are of interest there: with them standard graphs of all thresholds are much alike."""
    return setting.graph == WELL_CONNECTED or setting.threshold == BRIDGED_AT


def _made(bench: Workbench, motions: Dataset, setting: Setting) -> tuple[Bundle | None, dict[str, Any] | None]:
    """The character of a setting, how it follows players, and the seconds that both took."""
    started = time.perf_counter()
    bundle = bundle_of(bench, motions, setting)
    if bundle is None:
        return None, None
    return bundle, score_of(bench, bundle) | {"made_s": time.perf_counter() - started}


def _words(setting: Setting) -> str:
    return f"{setting.graph} {setting.threshold:g}, {setting.words}"


def _simpler(bundle: Bundle) -> dict[str, Contender]:
    """Controllers on the same graph that do not expect players to change their mind."""
    graph, task = bundle.graph, bundle.table("steering").task
    lasting = SteeringController(graph, solve(graph, task).require_converged())
    return {"policy of a lasting command": lasting, "greedy": greedy(graph, task)}


def _known(bench: Workbench, bundle: Bundle) -> dict[str, float]:
    """Totals over the beginnings of the traces, by how much is known; all that is to come comes last."""
    table, task = bundle.table("steering"), bundle.table("steering").task
    contenders: dict[str, Contender] = {"policy table": SteeringController(bundle.graph, table)}
    contenders |= {f"{seconds:g} s of foresight": Foresight(bundle.graph, table, seconds) for seconds in FORESIGHTS}
    contenders["all of it: the oracle"] = Oracle(bundle.graph, task)
    begun = [beginning(trace, math.ceil(KNOWN_SECONDS * SOURCE_HZ)) for trace in unseen(bench)]
    return {name: score_of(bench, bundle, one, players=begun)["total"] for name, one in contenders.items()}


def _switches(bench: Workbench, bundle: Bundle) -> Scores:
    table = bundle.table("steering")
    coarse = SteeringController(bundle.graph, table, exact_facing=False)
    return {
        "all on": score_of(bench, bundle),
        "transitions not smoothed": score_of(bench, bundle, showing=Showing(inertialise=False)),
        "feet not locked": score_of(bench, bundle, showing=Showing(foot_lock=False)),
        "turns only as planned": score_of(bench, bundle, coarse),
    }


def _judgements(graphs: dict[str, Any], best: str, others: dict[str, Any]) -> list[Judgement]:
    ours, strong = graphs[best], others["motion matching, strong"]
    reached = f"{best}: {ours['total']:.3f} ({interval_words(ours)})."
    apart = (
        f"{ours['total']:.3f} ({interval_words(ours)}) against {strong['total']:.3f} ({interval_words(strong)}): "
        f"{scored_gain(ours, strong).words(3)} more on the same players."
    )
    slide, source = ours["foot_slide_cm_s"], ours["source_foot_slide_cm_s"]
    times = [one["batch"]["decision_us"]["mean"] for one in (ours, strong)]
    return [
        judged(CLAIMS[0], ours["total"] >= beyond.CONTROL, reached, Cause.DATA),
        judged(CLAIMS[1], ours["total"] > strong["total"], apart, Cause.CLAIM),
        _slid(slide, source, strong["foot_slide_cm_s"]),
        judged(
            CLAIMS[3],
            times[0] <= beyond.PACE * times[1],
            f"{times[0]:.2f} µs against {times[1]:.2f} µs a character and tick.",
            Cause.CLAIM,
        ),
        _well_connected(graphs),
    ]


def _slid(slide: float | None, source: float | None, rival: float | None) -> Judgement:
    if not slide or not source or rival is None:
        return unjudged(CLAIMS[2], "No foot stood.")
    reason = f"{slide:.1f} cm/s against {source:.1f} of the clips and {rival:.1f} of motion matching."
    return judged(CLAIMS[2], slide <= beyond.SLIDE * source, reason, Cause.CLAIM)


def _well_connected(graphs: dict[str, Any]) -> Judgement:
    """Of each set of options, the well-connected graph and the best of the standard ones."""
    pairs = []
    for words in _OPTIONS:
        well, standard = (_of(graphs, kind, words) for kind in (WELL_CONNECTED, STANDARD))
        if well and standard:
            pairs.append((words, *(max(one["total"] for one in scores) for scores in (well, standard))))
    if not pairs:
        return unjudged(CLAIMS[4], "A graph could not be walked without end.")
    reason = "; ".join(f"{words}: {ours:.3f} against {best:.3f}" for words, ours, best in pairs) + "."
    return judged(CLAIMS[4], all(ours > best for _, ours, best in pairs), reason, Cause.DATA)


def _of(graphs: dict[str, Any], kind: str, words: str) -> list[dict[str, Any]]:
    """The scores of the characters of a kind of graph with these options."""
    return [one for name, one in graphs.items() if name.startswith(kind) and name.split(", ", 1)[1] == words]


def _chart(graphs: dict[str, Any], others: dict[str, Any]) -> Figure:
    kinds = (STANDARD, "standard"), (WELL_CONNECTED, "well")
    series = {f"{kind}, {words}": (colour, _of(graphs, kind, words)) for kind, colour in kinds for words in _OPTIONS}
    marks = {"motion matching, reference": "faint", "motion matching, strong": "rival"}
    series |= {name: (marks.get(name, "ink"), [one]) for name, one in others.items()}
    return control_chart(series)


def _headings(bench: Workbench, bundle: Bundle, strong: Contender) -> Figure:
    trace = unseen(bench)[0]
    ours = SteeringController(bundle.graph, bundle.table("steering"))
    colours = {"ours": ("well", ours), "motion matching, strong": ("rival", strong)}
    followed = {
        name: (colour, replay(trace, one, Stage(one.graph)).followed) for name, (colour, one) in colours.items()
    }
    return heading_chart(followed, KNOWN_SECONDS)


ROW = Row(
    name="X-T6",
    order=10,
    paper=beyond.PAPER,
    place="Table 6, extended",
    title="Characters against motion matching and the oracle",
    claim="A graph with mirrored clips and warped turns follows players better than motion matching, with feet that do "
    "not slide and at a tenth of its time.",
    published={"total": beyond.CONTROL, "slide": beyond.SLIDE, "pace": beyond.PACE},
    run=run,
)
