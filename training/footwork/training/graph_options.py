"""What kind of motion graph is to be built, and how."""

import math
from dataclasses import asdict, dataclass, fields
from typing import Literal

from footwork.errors import InputError
from footwork.motion.metric_names import NAMES

GRAPHS = ("standard", "well-connected", "annotated")
PAIRINGS = ("plain", "ratio", "neighbours")
ORDERS = ("frames", "reverse", "random")
USUAL_THRESHOLD = 1.0
MAX_WEIGHTS = 99
MAX_BRIDGES = 64
AUTO_WEIGHTS = 9  # as many at most where they are chosen by need
# what only the well-connected graph has
_WELL_CONNECTED = ("mu", "weights", "pairing", "order")


@dataclass(frozen=True)
class GraphOptions:
    """How a motion graph is built.

    Args:
        graph: The kind of motion graph: standard, well-connected, or annotated with the states of a machine.
        threshold: Transitions must cost less than this (1 is a root mean square distance of 5.6 cm): a number, or auto
            for the knee of the captured frames' costs. Without one it is 1, and in an annotated graph the knee where
            that is higher.
        metric: What tells how unlike two frames are: uniform, dynamics, torso or joints.
        mirror: Play every clip with left and right exchanged, too: twice the frames, and a turn to one side serves for
            the other.
        bridges: How many ways from every frame lead at once to each other behaviour, however unlike the frames are; the
            policy decides which are worth it.
        mu: Paths of a well-connected graph may cost this many times the best one's; more makes it smaller.
        weights: How many motions lie between the two of each pair in a well-connected graph: a number, or auto for as
            many, up to nine, as single hops under the threshold need.
        pairing: Which stretches of motion are interpolated: plain (all with the same feet on the ground), ratio (of
            durations at most 2) or neighbours (of like stretches before and after, too).
        order: The order in which a well-connected graph takes the frames that paths begin at: frames, reverse, random.

    Raises:
        InputError: for an unknown name, a number out of range, or an option that this kind of graph does not have.
    """

    graph: str = "standard"
    threshold: float | Literal["auto"] | None = None
    metric: str = "uniform"
    mirror: bool = False
    bridges: int = 0
    mu: float = 5.0
    weights: int | Literal["auto"] = "auto"
    pairing: str = "ratio"
    order: str = "frames"

    def __post_init__(self) -> None:
        _require_name(self.graph, GRAPHS, "graph")
        _require_name(self.metric, NAMES, "metric")
        _require_name(self.pairing, PAIRINGS, "pairing")
        _require_name(self.order, ORDERS, "order")
        if self.threshold is None and self.graph != "annotated":
            object.__setattr__(self, "threshold", USUAL_THRESHOLD)
        if self.threshold not in ("auto", None) and not (math.isfinite(self.threshold) and self.threshold > 0.0):
            raise InputError(f"{self.threshold} is no threshold, expected a positive number or auto", "--threshold")
        if not (math.isfinite(self.mu) and self.mu >= 1.0):
            raise InputError(f"{self.mu}, expected a number from 1 up", "--mu")
        if not 0 <= self.bridges <= MAX_BRIDGES:
            raise InputError(f"{self.bridges}, expected 0 to {MAX_BRIDGES}", "--bridges")
        if self.weights != "auto" and not 1 <= self.weights <= MAX_WEIGHTS:
            raise InputError(f"{self.weights}, expected auto or 1 to {MAX_WEIGHTS}", "--weights")
        if self.graph != "well-connected":
            self._require_unused()

    def _require_unused(self) -> None:
        """Refuse what this kind of graph would pass over without a word."""
        usual = {field.name: field.default for field in fields(self)}
        given = [f"--{name}" for name in _WELL_CONNECTED if getattr(self, name) != usual[name]]
        if given:
            kind = "an annotated" if self.graph == "annotated" else f"a {self.graph}"
            problem = f"{kind} graph has no such option, expected it with --graph well-connected"
            raise InputError(problem, ", ".join(given))

    @property
    def number(self) -> float:
        """The threshold, once it is a number.

        Raises:
            ValueError: where it is still to be chosen.
        """
        if self.threshold is None:
            raise ValueError("a threshold that is still to be chosen")
        return float(self.threshold)

    def record(self) -> dict[str, str | float | int]:
        """Those that matter for this kind of graph, by name."""
        unused = () if self.graph == "well-connected" else _WELL_CONNECTED
        return {name: value for name, value in asdict(self).items() if name not in unused}


def require_machine(options: GraphOptions, given: bool) -> None:
    """Raise InputError unless a state machine is given just where the kind of graph has one."""
    if given == (options.graph == "annotated"):
        return
    if given:
        raise InputError(f"a {options.graph} graph has no states, expected it with --graph annotated", "--machine")
    raise InputError("an annotated graph needs a state machine (TOML), such as examples/fighting.toml", "--machine")


def _require_name(name: str, known: tuple[str, ...], option: str) -> None:
    if name not in known:
        raise InputError(f"no {option} {name!r}, expected one of {', '.join(known)}", f"--{option}")
