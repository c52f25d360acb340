import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion import quaternion
from footwork.runtime.rotation_kernels import log


@given(st.integers(0, 10_000), st.sampled_from([0.0, 1e-12, 1e-6, 0.01, 1.0, 3.0, 3.14159265]), st.booleans())
@settings(max_examples=100, deadline=None)
def test_the_logarithm_without_branches_is_that_of_the_array_form(seed, angle, other_sign):
    axis = quaternion.normalise(np.random.default_rng(seed).normal(size=3))
    q = quaternion.from_rotation_vector(angle * axis) * (-1.0 if other_sign else 1.0)
    assert log(tuple(q)) == pytest.approx(quaternion.to_rotation_vector(q), abs=5e-9)
