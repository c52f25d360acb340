"""The numbers that Zhao and Safonova (2008) print, by table and figure; "MG" standard, "wcMG" well-connected graph."""

from footwork.study.reproduction.row import Paper

PAPER = Paper("Z", "L. Zhao and A. Safonova", 2008, "Achieving good connectivity in motion graphs")

SIZES = {"dataset1": 194, "dataset2": 264, "dataset3": 2721}  # frames at 30 Hz

# share of the original frames in the largest strongly connected part, %, by threshold
CONNECTIVITY = {
    "dataset1": {
        "wcMG": {0.2: 42, 0.4: 70, 0.6: 77, 0.8: 81, 1.0: 84, 2.0: 91, 5.0: 92, 6.0: 96},
        "MG": {0.2: 1, 0.4: 19, 0.6: 24, 0.8: 40, 1.0: 59, 2.0: 64, 5.0: 80, 6.0: 92},
    },
    "dataset2": {
        "wcMG": {0.2: 84, 0.4: 91, 0.6: 94, 0.8: 95, 1.0: 96, 2.0: 96, 5.0: 97, 6.0: 98},
        "MG": {0.2: 21, 0.4: 21, 0.6: 21, 0.8: 21, 1.0: 21, 2.0: 81, 5.0: 92, 6.0: 92},
    },
    "dataset3": {
        "wcMG": {0.2: 96, 0.4: 98, 0.6: 99, 0.8: 99, 1.0: 99},
        "MG": {0.2: 7, 0.4: 10, 0.6: 64, 0.8: 86, 1.0: 92},
    },
}
# how many times the well-connected graph's threshold the standard graph needs for 90 % of the frames
RATIO_FOR_90 = {"dataset1": 3.0, "dataset2": 12.5, "dataset3": 5.0}

CLOSURE_THRESHOLD = 0.4

# the threshold at which the standard graph is as quick as the well-connected one at 0.2
TRANSITION_TIME_EQUAL = {"wcMG": 0.2, "MG": 1.4, "ratio": 7.0}

# local maneuverability, seconds, by threshold, and the nodes of the standard graphs' largest part
MANEUVERABILITY = {
    "MG": {0.8: 1.33, 1.0: 0.98, 1.2: 0.88, 1.4: 0.79},
    "wcMG": {0.2: 0.79, 0.4: 0.54, 0.6: 0.49, 0.8: 0.45},
}
MANEUVERABILITY_NODES = {0.8: 2334, 1.0: 2516, 1.2: 2617, 1.4: 2645}
MANEUVERABILITY_GAIN = 2.96  # at 0.8

# behaviour to behaviour at 0.8, seconds
BEHAVIOUR_TIMES = {
    "run to idle": {"wcMG": 1.60, "MG": 2.70},
    "mean off the diagonal": {"wcMG": 0.30, "MG": 0.77},
}
RUN_TO_DUCK = 3.6  # seconds, in earlier work

# nodes and edges for each original frame after reduction
GROWTH = {"nodes_per_frame": 15.4, "edges_per_frame": 19.3, "slope_before": 2.0, "slope_after": 1.0}

# by the suboptimality scalar: nodes, local maneuverability (s), memory (MB); threshold 0.2
SUBOPTIMALITY = {
    1.0: (97201, 0.79, 190),
    1.1: (71013, 0.79, 135),
    1.3: (52967, 0.80, 98),
    1.5: (44879, 0.80, 81),
    1.7: (40419, 0.81, 73),
    2.0: (36085, 0.82, 65),
    3.0: (28646, 0.85, 51),
    5.0: (16098, 0.97, 28),
    10.0: (6950, 1.24, 11),
    20.0: (4989, 1.56, 8),
    50.0: (3940, 1.88, 6),
    100.0: (3789, 2.07, 6),
}
STANDARD_SIZE = {"nodes": 2721, "MB": 4}

# control, transition, their product, and frames in the largest part, by graph and threshold
CONTROL = {
    ("wcMG", 0.2): (0.74, 0.95, 0.70, 561),
    ("MG", 0.2): (0.22, 0.99, 0.22, 36),
    ("MG", 1.0): (0.24, 0.92, 0.22, 244),
    ("MG", 5.0): (0.50, 0.84, 0.42, 524),
    ("MG", 10.0): (0.51, 0.87, 0.44, 552),
}

# from, to
BUILD_SECONDS = {"interpolation": (7.0, 7.0), "transitions": (16200.0, 16200.0), "reduction": (1800.0, 3600.0)}
SMOOTH_UNDER = 0.6  # no discontinuity is seen under this threshold
