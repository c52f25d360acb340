"""What no paper of these measures, and users want to know."""

from footwork.study.reproduction.row import Paper

PAPER = Paper("X", "Beyond the papers", 2026, "Characters that players would use today, and what limits them")
CONTROL, SLIDE = 0.55, 1.5  # what a character shall reach: Total, and foot slide as a multiple of its clips'
PACE = 0.1  # of motion matching's time a character and tick
