"""The tick: time inside the runtime, the graph and the scores is a whole number of them."""

TICK_RATE = 30
"""Ticks a second."""

TICK = 1.0 / TICK_RATE
"""Seconds of one tick."""
