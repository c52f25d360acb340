from dataclasses import dataclass
from typing import Any

from footwork.motion.window_costs import window_costs
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions
from footwork.training.transitions import _find
from footwork.training.value_iteration import _sweep
from footwork.training.warm import start_warming, warm
from motion_samples import sample_clips


@dataclass
class Motions:
    clips: Any
    files: tuple[dict[str, str], ...] = ()
    attribution: tuple[str, ...] = ()


def test_after_warming_a_build_compiles_nothing_more():
    warm()
    kernels = (window_costs, _find, _sweep)
    before = [len(kernel.signatures) for kernel in kernels]
    assert all(before)
    motions = Motions(sample_clips(3, 70))
    build_bundle(motions, GraphOptions(threshold=1.0))
    assert [len(kernel.signatures) for kernel in kernels] == before


def test_warming_and_building_go_on_side_by_side():
    thread = start_warming()
    motions = Motions(sample_clips(2, 70))
    assert build_bundle(motions, GraphOptions(threshold=1.0))[1]["scc_nodes"] > 0
    thread.join(60)
    assert not thread.is_alive()
