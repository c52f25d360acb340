"""The names of the metrics, apart from the metrics so that they can be told without loading these."""

NAMES = ("uniform", "dynamics", "torso", "joints")
