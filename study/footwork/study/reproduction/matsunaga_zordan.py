"""The numbers that Matsunaga and Zordan (2007) print; "dynamics" is their metric, H1 and H2 the heuristics."""

from footwork.study.reproduction.row import Paper

PAPER = Paper("M", "M. Matsunaga and V. B. Zordan", 2007, "A dynamics-based comparison metric for motion graphs")

FIGHTING, REACTION = "fighting", "reaction"
SIZES = {FIGHTING: {"frames": 4145, "seconds": 34}, REACTION: {"frames": 3720, "seconds": 31}, "degrees_of_freedom": 45}
KNEES = {FIGHTING: 67, REACTION: 30}
UNIQUE = {FIGHTING: 11, REACTION: 14}  # of those at the knee
# cm, mean over the chosen transitions
START_TO_END = {
    FIGHTING: {"dynamics": 9.0, "H1": 12.2, "H2": 12.8},
    REACTION: {"dynamics": 8.2, "H1": 16.8, "H2": 17.0},
}
ARC_LENGTH = {
    FIGHTING: {"dynamics": 10.6, "H1": 14.0, "H2": 14.2},
    REACTION: {"dynamics": 9.9, "H1": 19.8, "H2": 19.3},
}
HEURISTICS = {"uniform": "H1", "torso": "H2", "dynamics": "dynamics"}  # by our metric's name
