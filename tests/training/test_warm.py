import pytest

from footwork.motion.window_costs import window_costs
from footwork.training.blend_kernels import align_starts
from footwork.training.build import build_bundle
from footwork.training.chain_minima import minima_of_rows
from footwork.training.graph_options import GraphOptions
from footwork.training.policy_values import settle
from footwork.training.sweeps import improve
from footwork.training.transitions import _find
from footwork.training.warm import start_warming, warm
from motion_samples import SampleMotions, sample_clips, stepping


@pytest.mark.parametrize(
    ("graph", "kernels"),
    [
        ("standard", (window_costs, _find, improve, settle)),
        ("well-connected", (align_starts, minima_of_rows, improve, settle)),
    ],
)
def test_after_warming_a_build_compiles_nothing_more(graph, kernels):
    options = GraphOptions(graph=graph, threshold=1.0, weights=1 if graph == "well-connected" else "auto")
    warm(options)
    before = [len(kernel.signatures) for kernel in kernels]
    assert all(before)
    clips = [stepping(clip, 10) for clip in sample_clips(3, 70)]
    build_bundle(SampleMotions(clips), options)
    assert [len(kernel.signatures) for kernel in kernels] == before


def test_warming_and_building_go_on_side_by_side():
    thread = start_warming(GraphOptions())
    motions = SampleMotions(sample_clips(2, 70))
    assert build_bundle(motions, GraphOptions(threshold=1.0))[1]["scc_nodes"] > 0
    thread.join(60)
    assert not thread.is_alive()
