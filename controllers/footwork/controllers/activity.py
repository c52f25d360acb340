"""The activities of a fighter, by number."""

SHADOW, ATTACK, EVADE = 0, 1, 2
ACTIVITIES = ("shadow", "attack", "evade")
"""Shadow is what a fighter does who does nothing else; the states of the other two are called as they are."""
