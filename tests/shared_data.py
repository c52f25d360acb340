"""Where real capture and real players' traces lie beside the checkout, and the marks of tests that need them."""

from pathlib import Path

import pytest

SHARED = Path(__file__).resolve().parents[2] / "shared"
MOTIONS = SHARED / "motions"
TRACES = SHARED / "traces"

needs_motions = pytest.mark.skipif(not MOTIONS.is_dir(), reason=f"no motion capture at {MOTIONS}")
needs_traces = pytest.mark.skipif(not TRACES.is_dir(), reason=f"no recorded traces at {TRACES}")
