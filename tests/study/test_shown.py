import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.kinematics import forward
from footwork.study.shown import ground_of, shown, shown_report, source_report, source_skating
from motion_samples import ring_graph

GRAPH = ring_graph(12)
STANDING = type(GRAPH)(**{**vars(GRAPH), "contacts": np.ones((12, 2), dtype=bool)})


def glide(speed: np.ndarray, height: float = 0.94):
    """Poses at rest that move on at so many metres a second."""
    place = np.zeros((len(speed), 3))
    place[:, 2], place[:, 1] = np.cumsum(speed) / 30.0, height
    return place, np.tile(quaternion.IDENTITY, (len(speed), GRAPH.skeleton.joint_count, 1))


def measured(speed, switched=(), height: float = 0.94):
    speed = np.asarray(speed, dtype=float)
    hard = np.isin(np.arange(len(speed)), switched)
    return shown(STANDING, np.zeros(len(speed), int), hard, *glide(speed, height), ground_of(GRAPH))


def test_feet_that_are_dragged_slide_and_skate_and_raised_ones_skate_no_more():
    report = shown_report([measured(np.full(20, 0.8))])
    assert report["foot_slide_cm_s"] == pytest.approx(80.0)
    assert report["skating_ratio"] == 1.0
    raised = shown_report([measured(np.full(20, 0.8), height=1.2)])
    assert (raised["skating_ratio"], raised["foot_slide_cm_s"]) == (0.0, None)
    assert shown_report([measured(np.full(20, 0.3))])["skating_ratio"] == 0.0


def test_a_jump_of_velocity_counts_at_the_switch_that_made_it():
    speed = np.repeat([0.5, 0.9], 10)
    at = measured(speed, [10])
    joints = GRAPH.skeleton.joint_count
    assert len(at.switches) == 2 * joints
    assert at.switches.max() == pytest.approx(0.4)
    assert at.elsewhere.max() == pytest.approx(0.0, abs=1e-9)
    assert measured(speed, [4]).elsewhere.max() == pytest.approx(0.4)


def test_the_capture_has_its_own_figures():
    places = forward(GRAPH.skeleton, GRAPH.root_position, GRAPH.rotations)[0]
    assert ground_of(GRAPH) == pytest.approx(places[0, GRAPH.skeleton.feet[:, 1], 1].min(), abs=1e-6)
    report = source_report(STANDING)
    assert report["source_foot_slide_cm_s"] == pytest.approx(120.0, rel=1e-4)
    assert report["source_skating_ratio"] == 1.0


def test_skating_of_frames_counts_those_that_are_shown_as_often_as_they_are():
    fast = np.where(np.arange(len(GRAPH.displacement))[:, None] < 6, GRAPH.displacement, 0.0)
    fields = {name: value for name, value in vars(STANDING).items() if name in type(GRAPH).__dataclass_fields__}
    graph = type(GRAPH)(**{**fields, "displacement": fast.astype(np.float32)})
    assert source_skating(graph, np.array([1, 2])) == 1.0
    assert source_skating(graph, np.array([1, 2, 11, 11])) == 0.5
    assert source_skating(graph, np.arange(12)) == source_report(graph)["source_skating_ratio"]
    assert source_skating(graph, np.zeros(3, int)) is None, "a clip's first frame has no step"
