import math

import pytest

from footwork.errors import InputError
from footwork.motion.task import SteeringTask
from footwork.training.task_options import TaskOptions


def test_unless_told_otherwise_it_is_the_default_task_at_a_small_price_of_transitions():
    assert TaskOptions().task() == SteeringTask(transition_price=0.001)


def test_degrees_and_parts_become_the_tasks():
    task = TaskOptions(discount=0.95, reward="sum", weight=0.9, warp=6.0, warp_stop=0.1, warp_jump=0.2).task()
    assert (task.discount, task.reward, task.weight) == (0.95, "sum", 0.9)
    assert task.warp == pytest.approx(math.radians(6.0))
    assert task.warp_share == {"stop": 0.1, "walk": 1.0, "run": 1.0, "jump": 0.2}


def test_speeds_are_read_for_each_behaviour():
    task = TaskOptions(speeds=("walk=0.8,1.2,1.6", "run=3"), speed_sigma=0.2, speed_weight=0.5).task()
    assert task.speeds == {"walk": (0.8, 1.2, 1.6), "run": (3.0,)}
    assert (task.speed_sigma, task.speed_weight) == (0.2, 0.5)


@pytest.mark.parametrize("text", ["walk", "walk=", "walk=fast", "walk=1;2"])
def test_speeds_that_are_none_are_refused(text):
    with pytest.raises(InputError, match=r"--speeds: .* expected such as walk=0\.8,1\.2,1\.6"):
        TaskOptions(speeds=(text,)).task()


@pytest.mark.parametrize(
    "option", [{"warp": 7.0}, {"warp_stop": 2.0}, {"discount": 1.0}, {"transition_price": 1.0}, {"reward": "best"}]
)
def test_what_no_task_can_have_is_refused(option):
    with pytest.raises(InputError, match="task: "):
        TaskOptions(**option).task()
