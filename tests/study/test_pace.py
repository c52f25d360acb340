import numpy as np

from footwork.controllers.controller import Situations
from footwork.controllers.steering import SteeringController
from footwork.motion.moves import Moves
from footwork.study.pace import pace
from made_traces import trace
from toy_bundle import toy_bundle


class Watched(SteeringController):
    """Notes what it is asked."""

    def __init__(self) -> None:
        bundle = toy_bundle()
        super().__init__(bundle.graph, bundle.table("steering"))
        self.headings: list[np.ndarray] = []

    def choose(self, situations: Situations, moves: Moves) -> None:
        self.headings.append(situations.heading.copy())
        super().choose(situations, moves)


def test_each_of_many_characters_is_somewhere_else_in_the_traces():
    watched = Watched()
    report = pace([trace(turn=0.02), trace(turn=-0.01)], watched, characters=8, ticks=4)
    assert report["characters"] == 8
    assert np.unique(watched.headings[0]).size == 8
    assert 0.0 < report["decision_us"]["p50"] <= report["tick_us"]["p50"]
