"""A crowd's groups tick in turn, and what each shows is what it would show alone."""

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.runtime.crowd import Crowd
from footwork.runtime.simulation import Simulation
from footwork.runtime.world_errors import WorldFull
from toy_bundle import lively_bundle

BUNDLE = lively_bundle()
PLACES = [(1.0, -2.0, 0.5), (0.0, 3.0, -1.0), (4.0, 0.0, 2.0)]


def full_crowd(frames: int) -> Crowd:
    crowd = Crowd(BUNDLE, len(PLACES), frames=frames)
    for place in PLACES:
        crowd.spawn(*place, "walk")
    return crowd


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_every_frame_is_the_tick_of_one_group_and_each_makes_one_in_as_many_frames(frames):
    crowd = full_crowd(frames)
    for made in range(1, 3 * frames + 1):
        before = [group.tick for group in crowd.groups]
        crowd.advance()
        assert sum(group.tick for group in crowd.groups) == made
        assert crowd.groups[(made - 1) % frames].tick == before[(made - 1) % frames] + 1
    assert [group.tick for group in crowd.groups] == [3] * frames


@pytest.mark.parametrize("frames", [2, 3])
def test_each_group_shows_what_it_would_alone_as_many_frames_later(frames):
    crowd = full_crowd(frames)
    alone = []
    for group in crowd.groups:
        same = Simulation(BUNDLE, group.world.capacity)
        for slot in group.world.slots:
            x, z, yaw = group.world.place[slot].tolist()
            same.spawn(x, z, yaw, "walk")
        alone.append(same)
    for frame in range(6 * frames):
        crowd.advance()
        shown = crowd.show()
        for turn, same in enumerate(alone):
            since = frame - turn
            if since >= 0:
                if since % frames == 0:
                    same.step()
                expected = same.show((since % frames + 1) / frames)
                np.testing.assert_array_equal(shown[turn].root, expected.root)
                np.testing.assert_array_equal(shown[turn].rotations, expected.rotations)


def test_before_its_first_tick_a_group_stands_where_it_was_put():
    crowd = full_crowd(2)
    crowd.advance()
    shown, waiting = crowd.show()[1], crowd.groups[1]
    np.testing.assert_array_equal(shown.root, waiting.world.show(1.0)[0])
    np.testing.assert_array_equal(waiting.world.place[0], PLACES[1])


def test_characters_are_spread_evenly_and_take_places_that_become_free():
    crowd = Crowd(BUNDLE, 5, frames=2)
    groups = [crowd.spawn(0.0, 0.0, 0.0)[0] for _ in range(5)]
    assert [groups.count(group) for group in crowd.groups] == [3, 2]
    with pytest.raises(WorldFull):
        crowd.spawn(0.0, 0.0, 0.0)
    crowd.groups[1].remove(0)
    assert crowd.spawn(0.0, 0.0, 0.0) == (crowd.groups[1], 0)


def test_what_characters_move_on_is_shared():
    crowd = full_crowd(3)
    assert all(group.world.motion is crowd.groups[0].world.motion for group in crowd.groups)


@pytest.mark.parametrize("frames", [0, 4])
def test_groups_that_would_be_empty_are_refused(frames):
    with pytest.raises(InputError, match="expected 1 to 3"):
        Crowd(BUNDLE, 3, frames=frames)
