"""The numbers that the paper on state-annotated motion graphs prints, and its state machine."""

from footwork.motion.state_machine import State, StateMachine
from footwork.study.reproduction.row import Paper

PAPER = Paper("A", "B. Chiu, V. B. Zordan and C.-C. Wu", 2007, "State-annotated motion graphs")
MOVING = "locomotion"
MACHINE = StateMachine(
    (
        State(MOVING, (MOVING,), (MOVING, "attack", "evade"), ("attack", "evade")),
        State("attack", ("attack",), (MOVING,)),
        State("evade", ("evade",), (MOVING,)),
    )
)
# nodes are our segments; delays are from locomotion
STATES = {
    "attack": {"nodes": 76, "mean_s": 2.57, "delay_s": 0.04},
    "evade": {"nodes": 54, "mean_s": 1.30, "delay_s": 0.05},
    MOVING: {"nodes": 702, "mean_s": 0.19, "delay_s": None},
}
