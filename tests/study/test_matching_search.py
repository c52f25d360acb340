import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.study.motion_matching.search import (
    LARGE,
    NOWHERE,
    SMALL,
    nearest,
    nearest_by_brute_force,
    search_sets,
)


def made_up(seed: int, frames: int):
    """Features that wander, as those of motion do, and the frames of three sets of them."""
    random = np.random.default_rng(seed)
    values = np.cumsum(random.normal(0.0, 0.3, (frames, 27)), axis=0).astype(np.float32)
    some = np.flatnonzero(random.random(frames) < 0.3)
    return random, values, [np.arange(frames), some if some.size else np.array([0]), np.array([frames - 1])]


def plain(query, values, members, skipped, cost):
    allowed = members[(members < skipped[0]) | (members >= skipped[1])]
    costs = np.cumsum((query - values[allowed]) ** 2, axis=1, dtype=np.float32)[:, -1]
    if not costs.size or not costs.min() < np.float32(cost):
        return NOWHERE, np.float32(cost)
    return allowed[int(np.argmin(costs))], costs.min()


@given(st.integers(0, 2**31), st.integers(1, 400))
@settings(max_examples=60, deadline=None)
def test_boxes_find_what_brute_force_and_a_plain_loop_find(seed, frames):
    random, values, members = made_up(seed, frames)
    sets, scratch = search_sets(values, members), np.empty(frames, np.float32)
    for number, own in enumerate(members):
        near = int(random.integers(frames))
        query = (values[near] + random.uniform(0.1, 3.0) * random.normal(size=27)).astype(np.float32)
        for skipped in ((near - 10, near + 11), (NOWHERE, NOWHERE)):
            for cost in (np.inf, float(random.uniform(0.0, 20.0))):
                asked = query, sets, number, skipped, cost, scratch
                assert nearest(*asked) == nearest_by_brute_force(*asked) == plain(query, values, own, skipped, cost)


def test_no_box_is_left_out_that_may_hold_the_nearest():
    """Queries far from everything, as those of a player who turns at once: their distances differ by little."""
    random, values, members = made_up(8, 3000)
    sets, scratch = search_sets(values, members), np.empty(3000, np.float32)
    for _ in range(200):
        query = (random.choice(values) + random.choice([1.0, 4.0]) * random.normal(size=27)).astype(np.float32)
        asked = query, sets, 0, (NOWHERE, NOWHERE), np.inf, scratch
        assert nearest(*asked) == nearest_by_brute_force(*asked)


def test_of_equals_the_first_frame_is_found():
    values = np.tile(np.random.default_rng(0).normal(size=(7, 27)), (60, 1)).astype(np.float32)
    sets, scratch = search_sets(values, [np.arange(len(values))]), np.empty(len(values), np.float32)
    for frame in range(7):
        assert nearest(values[frame], sets, 0, (NOWHERE, NOWHERE), np.inf, scratch) == (frame, 0.0)
        assert nearest(values[frame], sets, 0, (frame, frame + 1), np.inf, scratch) == (frame + 7, 0.0)


def test_boxes_hold_their_frames():
    _, values, members = made_up(3, 300)
    sets = search_sets(values, members)
    for size, low, high in ((SMALL, *sets.small), (LARGE, *sets.large.transpose(0, 2, 1))):
        for box in range(len(low)):
            inside = sets.frames[size * box : size * (box + 1)]
            rows = values[inside[inside != NOWHERE]]
            assert (rows >= low[box]).all()
            assert (rows <= high[box]).all()
            assert not rows.size or (rows.min(axis=0) == low[box]).all()
    for own, first, end in zip(members, sets.start, sets.start[1:], strict=False):
        frames = sets.frames[LARGE * first : LARGE * end]
        np.testing.assert_array_equal(np.sort(frames[frames != NOWHERE]), own)


def test_frames_that_are_alike_share_a_box():
    """Four heaps of frames, shuffled: no large box holds frames of two."""
    random = np.random.default_rng(5)
    heap = random.permutation(np.repeat(np.arange(4), LARGE))
    values = (100.0 * heap[:, None] + random.normal(size=(len(heap), 27))).astype(np.float32)
    boxes = heap[search_sets(values, [np.arange(len(heap))]).frames].reshape(-1, LARGE)
    np.testing.assert_array_equal(boxes.min(axis=1), boxes.max(axis=1))
