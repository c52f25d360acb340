"""Masses of the common body's segments, as fractions of the body's mass.

Source: conventions.md 8 (Winter; de Leva 1996 for men and women). Where a table gives one number to a part that the
common body splits, one joint carries it all: the thorax's mass includes the shoulders, the head's the neck and the
foot's the toes, so clavicles, neck and toes have none.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError

# fraction of body mass, one side
_TABLES = {
    "winter": {
        "hips": 0.142,
        "spine": 0.139,
        "chest": 0.216,
        "head": 0.081,
        "upper_arm": 0.028,
        "forearm": 0.016,
        "hand": 0.006,
        "thigh": 0.100,
        "shank": 0.0465,
        "foot": 0.0145,
    },
    "de-leva-male": {
        "hips": 0.1117,
        "spine": 0.1633,
        "chest": 0.1596,
        "head": 0.0694,
        "upper_arm": 0.0271,
        "forearm": 0.0162,
        "hand": 0.0061,
        "thigh": 0.1416,
        "shank": 0.0433,
        "foot": 0.0137,
    },
    "de-leva-female": {
        "hips": 0.1247,
        "spine": 0.1465,
        "chest": 0.1545,
        "head": 0.0668,
        "upper_arm": 0.0255,
        "forearm": 0.0138,
        "hand": 0.0056,
        "thigh": 0.1478,
        "shank": 0.0481,
        "foot": 0.0129,
    },
}
_MASSLESS = {"neck": 0.0, "clavicle": 0.0, "toes": 0.0}
SOURCES = tuple(_TABLES)


def mass_fractions(names: tuple[str, ...], source: str = "winter") -> NDArray[np.float64]:
    """Share of the body's mass in the segment of each joint of the common body; shares sum to one.  # (J,)

    De Leva's printed fractions sum to 1.0000 and 0.9999; they are divided by their sum.

    Args:
        names: joint names of the common body.
        source: ``winter``, ``de-leva-male`` or ``de-leva-female``.

    Raises:
        InputError: for an unknown source or joint.
    """
    if source not in _TABLES:
        raise InputError(f"no mass table {source!r}, expected one of {', '.join(SOURCES)}", "masses")
    table = _TABLES[source] | _MASSLESS
    parts = [name.removeprefix("left_").removeprefix("right_") for name in names]
    unknown = [name for name, part in zip(names, parts, strict=True) if part not in table]
    if unknown:
        raise InputError(f"no mass for joint {unknown[0]!r}, expected the common body's {', '.join(table)}", "masses")
    fractions = np.array([table[part] for part in parts])
    return fractions / fractions.sum()


def segment_masses(names: tuple[str, ...], total: float = 75.0, source: str = "winter") -> NDArray[np.float64]:
    """Mass in kilograms of each segment of a common body of ``total`` kilograms.  # (J,)

    Raises:
        InputError: for an unknown source or joint, or a total that is not positive and finite.
    """
    if not (np.isfinite(total) and total > 0.0):
        raise InputError(f"a body mass of {total} kg, expected a positive number", "masses")
    return total * mass_fractions(names, source)


def outward_sums(parents: ArrayLike, values: ArrayLike) -> NDArray[np.float64]:
    """Each joint's value plus those of all joints outward of it, parents before children.  # (J,) -> (J,)

    With mass fractions this is the weight w_mass of the dynamics metric (conventions.md 8).
    """
    parents = np.asarray(parents)
    sums = np.array(values, dtype=np.float64)
    for joint in range(len(sums) - 1, 0, -1):
        sums[parents[joint]] += sums[joint]
    return sums
