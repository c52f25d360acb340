import numpy as np

from footwork.motion.actions import Actions, actions_of, onward_actions, onward_edges
from footwork.motion.task import SteeringTask
from toy_bundle import toy_bundle


def writable(actions: Actions) -> list[str]:
    return [name for name, part in actions._asdict().items() if isinstance(part, np.ndarray) and part.flags.writeable]


def test_no_array_may_be_written_to_so_that_kernels_are_compiled_once():
    graph = toy_bundle().graph
    actions = actions_of(graph, SteeringTask(behaviours=graph.behaviours))
    assert writable(actions) == []
    assert writable(onward_actions(actions, onward_edges(graph))) == []
    assert writable(actions._replace(yaw=np.zeros(3, np.float32))) == ["yaw"]
