import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.body import NAMES, default_body
from footwork.motion.masses import SOURCES, mass_fractions, outward_sums, segment_masses


def test_outward_sums_of_winter_are_the_weights_of_the_dynamics_metric():
    body = default_body()
    sums = outward_sums(body.parents, mass_fractions(NAMES))
    expected = {
        "hips": 1.0,
        "spine": 0.536,
        "neck": 0.081,
        "head": 0.081,
        "left_clavicle": 0.050,
        "left_upper_arm": 0.050,
        "right_forearm": 0.022,
        "left_hand": 0.006,
        "left_thigh": 0.161,
        "right_shank": 0.061,
        "left_foot": 0.0145,
        "left_toes": 0.0,
    }
    for name, want in expected.items():
        assert sums[body.index(name)] == pytest.approx(want, abs=1e-12), name


@pytest.mark.parametrize("source", SOURCES)
def test_every_source_spreads_the_whole_mass_alike_on_both_sides(source):
    masses = dict(zip(NAMES, segment_masses(NAMES, 80.0, source), strict=True))
    assert sum(masses.values()) == pytest.approx(80.0)
    assert all(masses[name] == masses[name.replace("left", "right")] for name in NAMES)


def test_the_default_body_weighs_75_kg():
    assert default_body().masses.sum() == pytest.approx(75.0)


def test_men_and_women_differ():
    thigh = NAMES.index("left_thigh")
    male, female = (mass_fractions(NAMES, f"de-leva-{sex}")[thigh] for sex in ("male", "female"))
    assert (male, female) == (pytest.approx(0.1416, abs=1e-4), pytest.approx(0.1478, abs=1e-4))


def test_outward_sums_on_a_fork():
    assert outward_sums([-1, 0, 1, 1, 0], [1.0, 2.0, 4.0, 8.0, 16.0]).tolist() == [31.0, 14.0, 4.0, 8.0, 16.0]


@pytest.mark.parametrize(
    ("names", "total", "source", "message"),
    [
        (NAMES, 75.0, "dempster", "expected one of winter"),
        (("hips", "tail"), 75.0, "winter", "'tail'"),
        (NAMES, np.nan, "winter", "positive"),
        (NAMES, 0.0, "winter", "positive"),
    ],
)
def test_bad_requests_are_named(names, total, source, message):
    with pytest.raises(InputError, match=message):
        segment_masses(names, total, source)
