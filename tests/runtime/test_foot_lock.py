"""Feet that stand stay where they are, in what is shown."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from footwork.motion import quaternion
from footwork.motion.angle import wrapped
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import forward
from footwork.motion.moves import Moves, moves_along, no_moves
from footwork.motion.skeleton import Skeleton
from footwork.motion.turn_warp import turn_warp, turned
from footwork.runtime.foot_lock import LOW, MOST_TURNED, STEP_TICKS, legs_of
from footwork.runtime.held_feet import DEEPEST
from footwork.runtime.world import World
from toy_graphs import edge_between, graph_of, homogeneous

BODY = default_body()
FRAMES = 40
FRACTIONS = (0.1, 0.6, 1.0)


def swaying_clip(seed: int) -> Clip:
    """A body on bent legs that sways and drifts a little, so that its feet slide if nobody holds them."""
    random, time = np.random.default_rng(seed), np.arange(FRAMES)[:, None, None] / 30.0
    shape = (1, BODY.joint_count, 3)
    waves = random.normal(0.0, 0.03, shape) * np.sin(random.uniform(2, 6, shape) * time + random.uniform(0, 6, shape))
    for side in ("left", "right"):
        for part, angle in (("thigh", -0.4), ("shank", 0.8), ("foot", -0.4)):
            waves[:, BODY.index(f"{side}_{part}"), 0] += angle
    root = np.tile([0.0, 0.87, 0.0], (FRAMES, 1))
    root[:, 2] += 0.1 * time[:, 0, 0]
    return Clip(f"sway{seed}", BODY, 30.0, root, quaternion.from_rotation_vector(waves))


def standing_graph(contacts=None) -> MotionGraph:
    """Two clips with jumps between them; both feet stand but for a spell in each clip."""
    graph = graph_of([swaying_clip(1), swaying_clip(2)], [(12, FRAMES + 5), (FRAMES + 30, 3), (20, 2)])
    if contacts is None:
        contacts = np.ones((2 * FRAMES, 2), dtype=bool)
        contacts[8:11, 0] = contacts[FRAMES + 15 : FRAMES + 20, 1] = False
    return replace(graph, contacts=contacts)


GRAPH = standing_graph()
PATH = [*range(4, 13), *range(FRAMES + 6, FRAMES + 31), *range(4, 21), *range(3, 12)]


def along(path: list[int], random: np.random.Generator | None = None, graph: MotionGraph = GRAPH) -> list[Moves]:
    """The moves along a path, with turns of up to 3 degrees about standing feet where a generator is given."""
    warp, every = turn_warp(graph), []
    for source, target in pairwise(path):
        moves = moves_along(graph, np.array([edge_between(graph, source, target)]))
        if random is not None:
            moves.adjustment[0] = turned(warp.pivot[target], random.uniform(-0.05, 0.05))
        every.append(moves)
    return every


def spawned(graph: MotionGraph = GRAPH, node: int = PATH[0], **options) -> World:
    world = World(graph, 1, **options)
    world.spawn(node, 1.0, -2.0, 0.7)
    return world


def places(world: World, fraction: float) -> np.ndarray:
    root, rotations = world.show(fraction)
    return forward(BODY, root[0].astype(float), rotations[0].astype(float))[0]


def feet(world: World, fraction: float) -> np.ndarray:
    """Ball x, z and yaw of each foot.  # (feet, 3)"""
    joints = places(world, fraction)
    ankle, ball = joints[BODY.feet[:, 0]], joints[BODY.feet[:, 1]]
    along = ball - ankle
    return np.stack([ball[:, 0], ball[:, 2], np.arctan2(along[:, 0], along[:, 2])], axis=-1)


def test_a_foot_that_stands_stays_while_the_body_goes_on_jumps_and_turns():
    world, loose = spawned(), spawned(foot_lock=False)
    held, moved = 0, []
    for moves in along(PATH, np.random.default_rng(1)):
        before, was_at, free = world.node[0], feet(world, 1.0), feet(loose, 1.0)
        world.step(moves)
        loose.step(moves)
        stand = GRAPH.contacts[before] & GRAPH.contacts[world.node[0]]
        held += int(stand.sum())
        for fraction in FRACTIONS:
            np.testing.assert_allclose(feet(world, fraction)[stand], was_at[stand], atol=2e-5)
        moved.append(np.abs(feet(loose, 1.0) - free).max())
    assert held > len(PATH)
    assert np.median(moved) > 0.01


def test_the_pose_shown_is_continuous_through_locks_jumps_turns_and_releases():
    world = spawned()
    for moves in along(PATH, np.random.default_rng(2)):
        before = places(world, 1.0)
        world.step(moves)
        np.testing.assert_allclose(places(world, 1e-6), before, atol=2e-5)


def test_what_is_shown_between_ticks_changes_nothing():
    watched, unwatched = spawned(), spawned()
    for moves in along(PATH, np.random.default_rng(3)):
        for world in (watched, unwatched):
            world.step(moves)
        for fraction in (0.9, 0.1, 0.5):
            watched.show(fraction)
        assert watched.show(1.0)[1].tobytes() == unwatched.show(1.0)[1].tobytes()
        assert watched.show(1.0)[0].tobytes() == unwatched.show(1.0)[0].tobytes()


def test_many_characters_are_held_as_each_would_be_alone():
    together, alone = World(GRAPH, 4), [World(GRAPH, 1) for _ in range(4)]
    for slot, world in enumerate(alone):
        for each in (together, world):
            each.spawn(5 * slot, slot, -slot, 0.3 * slot)
    random = np.random.default_rng(3)
    for _ in range(60):
        first, end = GRAPH.edge_start[together.node], GRAPH.edge_start[together.node + 1]
        stuck = end == first  # at a clip's end: back to its start
        for slot in np.flatnonzero(stuck):
            for world, where in ((together, int(slot)), (alone[slot], 0)):
                world.remove(where)
                world.spawn(3, 0.0, 0.0, 0.0)
        first, end = GRAPH.edge_start[together.node], GRAPH.edge_start[together.node + 1]
        edges = random.integers(first, end).astype(np.int32)
        together.step(moves_along(GRAPH, edges))
        root, rotations = together.show(0.4)
        for slot, world in enumerate(alone):
            world.step(moves_along(GRAPH, edges[slot : slot + 1]))
            alone_root, alone_rotations = world.show(0.4)
            assert root[slot].tobytes() == alone_root.tobytes()
            assert rotations[slot].tobytes() == alone_rotations.tobytes()


def test_without_contacts_nothing_is_changed():
    graph = standing_graph(np.zeros((2 * FRAMES, 2), dtype=bool))
    clip = [*range(4, 40)]
    world, loose = spawned(graph), spawned(graph, foot_lock=False)
    for moves in along(clip, graph=graph):
        for each in (world, loose):
            each.step(moves)
        np.testing.assert_allclose(places(world, 1.0), places(loose, 1.0), atol=1e-6)


def test_what_a_lock_added_dies_away_after_contact():
    contacts = np.zeros((2 * FRAMES, 2), dtype=bool)
    contacts[:15] = True
    graph = standing_graph(contacts)
    world, loose = spawned(graph, 4), spawned(graph, 4, foot_lock=False)
    apart = []
    for moves in along([*range(4, 40)], graph=graph):
        for each in (world, loose):
            each.step(moves)
        apart.append(np.abs(feet(world, 1.0) - feet(loose, 1.0)).max())
    last = 14 - 5  # the last tick of contact
    assert apart[last] > 0.02
    assert apart[last + 5] < 0.1 * apart[last]
    assert apart[-1] < 1e-5


def test_a_foot_too_far_from_its_motion_steps_and_stands_again():
    graph = standing_graph(np.ones((2 * FRAMES, 2), dtype=bool))
    world, loose = spawned(graph, 4), spawned(graph, 4, foot_lock=False)
    step, still, errors, heights = np.deg2rad(6.0), [], [], []
    for moves in along([*range(4, 40)], graph=graph):
        moves.adjustment[0] = [0.0, 0.0, step]
        before = feet(world, 1.0)
        for each in (world, loose):
            each.step(moves)
        apart = feet(world, 1.0) - feet(loose, 1.0)
        errors.append(np.abs(wrapped(apart[:, 2])).max())
        still.append(np.abs(feet(world, 1.0) - before).max(axis=-1) < 1e-5)
        lift = [joints[BODY.feet[:, 1], 1] for joints in (places(world, 1.0), places(loose, 1.0))]
        heights.append(lift[0] - lift[1])
    still, heights = np.array(still), np.array(heights)
    assert MOST_TURNED < max(errors) < MOST_TURNED + (STEP_TICKS + 2) * step
    assert still.any(axis=1).all(), "both feet moved at once"
    starts = np.diff(still.astype(int), axis=0) == -1
    assert starts.sum() >= 3
    moving = ~still & np.roll(~still, 1, axis=0)
    assert heights[still].max() < 0.01
    assert np.median(heights[moving]) > 0.04


def test_a_foot_in_the_air_is_not_locked_before_it_comes_down():
    """A jump from a leg that is up to a frame in which it stands."""
    up, down = swaying_clip(1), swaying_clip(1)
    lifted = up.rotations.copy()
    lifted[:, BODY.index("left_thigh")] = quaternion.from_rotation_vector([-1.2, 0.0, 0.0])
    lifted[:, BODY.index("left_shank")] = quaternion.from_rotation_vector([1.5, 0.0, 0.0])
    graph = graph_of([replace(up, rotations=lifted), down], [(10, FRAMES + 10)])
    graph = replace(graph, contacts=np.ones((2 * FRAMES, 2), dtype=bool))
    floor = forward(BODY, graph.root_position, graph.rotations)[0][:, BODY.feet[:, 1], 1].min()
    world = spawned(graph, 5)
    for moves in along([*range(5, 11), *range(FRAMES + 11, FRAMES + 30)], graph=graph):
        before, height = feet(world, 1.0)[0], places(world, 1.0)[BODY.feet[0, 1], 1] - floor
        world.step(moves)
        moved = np.abs(feet(world, 1.0)[0] - before).max() > 1e-5
        assert moved == (height > LOW)


def test_no_ball_goes_under_the_lowest_of_the_graph():
    """A body that comes down is jumped to one that stands still: what is left of its speed would carry it on down."""
    falling, still = swaying_clip(1), swaying_clip(1)
    root = falling.root_position.copy()
    root[:, 1] += 0.05 * np.arange(FRAMES)[::-1]
    graph = graph_of([replace(falling, root_position=root), still], [(FRAMES - 1, FRAMES + 10)])
    floor = forward(BODY, graph.root_position, graph.rotations)[0][:, BODY.feet[:, 1], 1].min()
    world, loose = spawned(graph, FRAMES - 5), spawned(graph, FRAMES - 5, foot_lock=False)
    low, under = [], []
    for moves in along([*range(FRAMES - 5, FRAMES), *range(FRAMES + 11, FRAMES + 25)], graph=graph):
        for each, heights in ((world, low), (loose, under)):
            each.step(moves)
            heights += [places(each, fraction)[BODY.feet[:, 1], 1].min() for fraction in FRACTIONS]
    assert min(under) < floor - 0.01
    assert min(low) > floor - 1e-5


def test_the_hips_come_down_for_a_foot_out_of_reach_and_not_for_ever():
    clip = swaying_clip(1)
    straight = clip.rotations.copy()
    straight[:, 1:] = quaternion.IDENTITY
    root = np.tile([0.0, 0.909, 0.0], (FRAMES, 1))
    root[:, 2] += 0.02 * np.arange(FRAMES)
    still = Clip("stretched", BODY, 30.0, root, straight)
    graph = replace(graph_of([still], [(38, 2)]), contacts=np.ones((FRAMES, 2), dtype=bool))
    world, drops = spawned(graph, 0), []
    for moves in along([*range(12)], graph=graph):
        before = feet(world, 1.0)
        world.step(moves)
        drops.append(0.909 - float(world.show(1.0)[0][0, 1]))
        if drops[-1] < DEEPEST - 1e-6 and len(drops) < 5:
            np.testing.assert_allclose(feet(world, 1.0), before, atol=1e-5)
    assert 0.005 < max(drops) <= DEEPEST + 1e-6
    assert np.all(np.diff(drops[:6]) > 0.0)


def test_a_teleport_takes_its_locks_along():
    world, stayed = spawned(), spawned()
    path = along(PATH, np.random.default_rng(4))
    for moves in path[:14]:
        world.step(moves)
        stayed.step(moves)
    moved = homogeneous((3.0, 4.0, 2.5)) @ np.linalg.inv(homogeneous(world.place[0]))
    world.correct(0, 3.0, 4.0, 2.5)
    for moves in path[14:30]:
        for fraction in FRACTIONS:
            expected = places(stayed, fraction) @ moved[:3, :3].T + moved[:3, 3]
            np.testing.assert_allclose(places(world, fraction), expected, atol=2e-5)
        world.step(moves)
        stayed.step(moves)


def test_a_slot_that_is_taken_again_has_no_locks():
    world, fresh = spawned(), spawned(node=20)
    for moves in along(PATH[:20], np.random.default_rng(5)):
        world.step(moves)
    world.remove(0)
    world.spawn(20, 1.0, -2.0, 0.7)
    assert world.show(0.5)[1].tobytes() == fresh.show(0.5)[1].tobytes()


def test_legs_are_those_that_hang_from_the_root():
    legs = legs_of(BODY)
    assert [[BODY.names[joint] for joint in leg] for leg in legs] == [
        [f"{side}_{part}" for part in ("thigh", "shank", "foot", "toes")] for side in ("left", "right")
    ]
    chain = Skeleton(
        ("a", "b", "c"), np.array([-1, 0, 1], np.int32), np.ones((3, 3)), feet=np.array([[1, 2]], np.int32)
    )
    assert legs_of(chain).shape == (0, 4)


def test_what_is_shown_of_a_character_is_the_same_bytes_however_many_there_are():
    count = 37  # more than are worked on at a time, and no multiple of anything
    alone, many = spawned(), World(GRAPH, count)
    for _ in range(count):
        many.spawn(PATH[0], 1.0, -2.0, 0.7)
    for moves in along(PATH, np.random.default_rng(3)):
        of_all = no_moves(count)
        of_all.put(np.arange(count), moves)
        alone.step(moves)
        many.step(of_all)
        for fraction in FRACTIONS:
            for one, all_ in zip(alone.show(fraction), many.show(fraction), strict=True):
                assert (all_ == one).all()
