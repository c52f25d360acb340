import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion import kinematics, quaternion
from footwork.motion.moves import LEAP, moves_along, no_moves
from footwork.motion.turn_warp import turned
from footwork.runtime.world import NoSuchCharacter, World, WorldError, WorldFull, WrongMove
from toy_graphs import edge_between, graph_of, homogeneous, planar_places, wandering_clip

CLIPS = [wandering_clip(1), wandering_clip(2)]
FRAMES = CLIPS[0].frame_count
GRAPH = graph_of(CLIPS, [(10, FRAMES + 5), (15, 3), (FRAMES + 12, 4), (2 * FRAMES - 1, 2), (FRAMES - 1, FRAMES)])
coordinate = st.floats(-50.0, 50.0)


def steps(world: World, path: list[int], slot: int = 0) -> None:
    for source, target in itertools.pairwise(path):
        edges = np.zeros(world.capacity, dtype=np.int32)
        edges[slot] = edge_between(world.graph, source, target)
        world.step(moves_along(world.graph, edges))


def random_edges(world: World, random: np.random.Generator) -> np.ndarray:
    """Any edge out of each node; this graph has no dead ends."""
    first, end = world.graph.edge_start[world.node], world.graph.edge_start[world.node + 1]
    return random.integers(first, end).astype(np.int32)


def seen(world: World, fraction: float, slot: int = 0) -> tuple[np.ndarray, np.ndarray]:
    root, rotations = world.show(fraction)
    return root[slot].astype(float), rotations[slot].astype(float)


def angle_between(a, b) -> float:
    return float(
        np.linalg.norm(quaternion.to_rotation_vector(quaternion.multiply(a, quaternion.conjugate(b))), axis=-1).max()
    )


@given(coordinate, coordinate, st.floats(-3.1, 3.1), st.integers(0, FRAMES - 2))
@settings(max_examples=20, deadline=None)
def test_natural_edges_replay_the_clip_up_to_a_planar_transform(x, z, yaw, start):
    clip = CLIPS[1]
    world = World(GRAPH, 1)
    world.spawn(FRAMES + start, x, z, yaw)
    to_world = homogeneous((x, z, yaw)) @ np.linalg.inv(homogeneous(planar_places(clip)[start]))
    places, _ = kinematics.clip_places(clip)
    for frame in range(start, clip.frame_count):
        if frame > start:
            steps(world, [FRAMES + frame - 1, FRAMES + frame])
        expected = places[frame] @ to_world[:3, :3].T + to_world[:3, 3]
        shown, _ = kinematics.forward(clip.skeleton, *seen(world, 1.0))
        np.testing.assert_allclose(shown, expected, atol=1e-5)


def test_a_tick_starts_where_the_capture_was_a_tick_before():
    world = World(GRAPH, 1)
    world.spawn(4, 1.0, 2.0, 0.5)
    root, rotations = seen(world, 1.0)
    steps(world, [4, 5])
    root_after, rotations_after = seen(world, 1e-9)
    np.testing.assert_allclose(root_after, root, atol=1e-6)
    assert angle_between(rotations_after, rotations) < 1e-6


@given(coordinate, coordinate, st.floats(-3.1, 3.1), st.integers(0, 2**31))
@settings(max_examples=20, deadline=None)
def test_places_compose_like_homogeneous_matrices(x, z, yaw, seed):
    random, world = np.random.default_rng(seed), World(GRAPH, 1)
    world.spawn(0, x, z, yaw)
    matrix = homogeneous((x, z, yaw))
    for _ in range(30):
        edges = random_edges(world, random)
        matrix = matrix @ homogeneous(GRAPH.displacement[edges[0]].astype(float))
        world.step(moves_along(GRAPH, edges))
        np.testing.assert_allclose(homogeneous(world.place[0]), matrix, atol=1e-9)


def test_place_yaw_is_where_the_body_faces():
    world = World(GRAPH, 1, inertialise=False)
    world.spawn(3, 1.0, 2.0, 2.9)
    for source in range(3, 10):
        steps(world, [source, source + 1])
        places, _ = kinematics.forward(GRAPH.skeleton, *seen(world, 1.0))
        assert np.sin(kinematics.facing_yaw(GRAPH.skeleton, places) - world.place[0, 2]) == pytest.approx(0.0, abs=1e-5)


def test_many_characters_step_as_each_would_alone():
    together, alone = World(GRAPH, 8), [World(GRAPH, 1) for _ in range(8)]
    for slot, world in enumerate(alone):
        for each in (together, world):
            each.spawn(slot, slot, -slot, 0.3 * slot)
    random = np.random.default_rng(3)
    for _ in range(60):
        edges = random_edges(together, random)
        together.step(moves_along(GRAPH, edges))
        for slot, world in enumerate(alone):
            world.step(moves_along(GRAPH, edges[slot : slot + 1]))
        root, rotations = together.show(0.5)
        for slot, world in enumerate(alone):
            alone_root, alone_rotations = world.show(0.5)
            assert root[slot].tobytes() == alone_root.tobytes()
            assert rotations[slot].tobytes() == alone_rotations.tobytes()


def test_a_wrong_edge_is_named_and_nobody_moves():
    world = World(GRAPH, 2)
    world.spawn(0, 0.0, 0.0, 0.0)
    world.spawn(5, 0.0, 0.0, 0.0)
    with pytest.raises(WrongMove, match="character 1 at node 5 was given edge 0, expected 5 to 5"):
        world.step(moves_along(GRAPH, np.zeros(2, dtype=np.int32)))
    assert world.node.tolist() == [0, 5]
    with pytest.raises(WrongMove, match="character 0 at node 0 was given edge 1, expected 0 to 0"):
        world.step(moves_along(GRAPH, np.array([1, 5], dtype=np.int32)))


def test_a_move_to_nowhere_is_refused_and_nobody_moves():
    world, moves = World(GRAPH, 1), moves_along(GRAPH, np.zeros(1, dtype=np.int32))
    world.spawn(0, 0.0, 0.0, 0.0)
    moves.target[0] = 2
    with pytest.raises(WrongMove, match="character 0 at node 0 was sent to node 2, expected 1"):
        world.step(moves)
    moves.edge[0], moves.target[0] = LEAP, 2 * FRAMES
    with pytest.raises(WrongMove, match=f"sent to node {2 * FRAMES}, expected 0 to {2 * FRAMES - 1}"):
        world.step(moves)
    moves.target[0], moves.adjustment[0, 2] = 3, np.nan
    with pytest.raises(WrongMove, match="a place that is not finite"):
        world.step(moves)
    assert (world.node[0], world.place[0].tolist()) == (0, [0.0, 0.0, 0.0])


@given(coordinate, coordinate, st.floats(-3.1, 3.1), st.integers(0, 2**31))
@settings(max_examples=20, deadline=None)
def test_a_leap_ends_where_its_displacement_and_adjustment_lead(x, z, yaw, seed):
    random, world, moves = np.random.default_rng(seed), World(GRAPH, 1), no_moves(1)
    world.spawn(4, x, z, yaw)
    moves.target[0] = FRAMES + 7
    moves.displacement[0], moves.adjustment[0] = random.uniform(-1, 1, (2, 3))
    world.step(moves)
    ahead = homogeneous(moves.displacement[0]) @ homogeneous(moves.adjustment[0])
    np.testing.assert_allclose(homogeneous(world.place[0]), homogeneous((x, z, yaw)) @ ahead, atol=1e-9)
    assert (world.node[0], world.edge[0], world.natural[0]) == (FRAMES + 7, LEAP, False)


def test_slots_are_reused_and_a_full_world_says_so():
    world = World(GRAPH, 2)
    assert [world.spawn(0, 0, 0, 0), world.spawn(1, 0, 0, 0)] == [0, 1]
    with pytest.raises(WorldFull, match="all 2"):
        world.spawn(0, 0, 0, 0)
    world.remove(0)
    with pytest.raises(NoSuchCharacter, match="no character 0"):
        world.correct(0, 0, 0, 0)
    assert world.spawn(7, 0, 0, 0) == 0
    assert world.edge.tolist() == [-1, -1]


@pytest.mark.parametrize("slot", [-1, 2, 1])
def test_bad_slots_are_refused(slot):
    world = World(GRAPH, 2)
    world.spawn(0, 0, 0, 0)
    with pytest.raises(NoSuchCharacter):
        world.remove(slot)


def test_a_teleport_leaves_nothing_behind_that_smooths():
    path = [8, 9, 10, *range(FRAMES + 6, FRAMES + 9)]
    moved, fresh = World(GRAPH, 1), World(GRAPH, 1)
    moved.spawn(path[0], 5.0, 5.0, 1.0)
    steps(moved, path)
    with pytest.raises(NoSuchCharacter):
        moved.teleport(1, 0.0, 0.0, 0.0)
    with pytest.raises(WorldError, match="expected finite"):
        moved.teleport(0, 0.0, np.nan, 0.0)
    moved.teleport(0, 1.0, -2.0, 7.0)
    fresh.spawn(path[-1], 1.0, -2.0, 7.0)
    for way in (path[-1:], [path[-1], path[-1] + 1, path[-1] + 2]):
        for world in (moved, fresh):
            steps(world, way)
        for shown, expected in zip(moved.show(0.5), fresh.show(0.5), strict=True):
            np.testing.assert_array_equal(shown, expected)


def test_bad_arguments_are_refused():
    world = World(GRAPH, 1)
    for place in [(np.nan, 0, 0), (0, np.inf, 0), (0, 0, -np.inf)]:
        with pytest.raises(WorldError, match="expected finite"):
            world.spawn(0, *place)
    with pytest.raises(WorldError, match=f"node {2 * FRAMES}"):
        world.spawn(2 * FRAMES, 0, 0, 0)
    for fraction in (0.0, 1.01, np.nan):
        with pytest.raises(WorldError, match="fraction"):
            world.show(fraction)
    for capacity, halflife in [(0, 0.1), (1, 0.0), (1, np.nan)]:
        with pytest.raises(WorldError):
            World(GRAPH, capacity, halflife=halflife)


def adjusted(path: list[int], random: np.random.Generator):
    """Moves along a path with adjustments of every size up to a few centimetres and degrees, none now and then."""
    for source, target in itertools.pairwise(path):
        moves = moves_along(GRAPH, np.array([edge_between(GRAPH, source, target)]))
        moves.adjustment[0] = random.uniform(-0.1, 0.1, 3) * random.choice([0.0, 1e-5, 1.0])
        yield moves


@pytest.mark.parametrize("seed", range(3))
def test_an_adjustment_is_spread_over_its_tick(seed):
    random, world = np.random.default_rng(seed), World(GRAPH, 1)
    world.spawn(8, 1.0, 2.0, 3.0)
    for moves in adjusted([8, 9, 10, *range(FRAMES + 6, FRAMES + 13), *range(5, 16), *range(4, 12)], random):
        root, rotations = seen(world, 1.0)
        world.step(moves)
        root_after, rotations_after = seen(world, 1e-6)
        np.testing.assert_allclose(root_after, root, atol=2e-6)
        assert angle_between(rotations_after, rotations) < 2e-6


def test_an_adjustment_is_whole_at_its_ticks_end_and_turns_evenly_about_its_pivot():
    world, moves = World(GRAPH, 1), moves_along(GRAPH, np.array([4], np.int32))
    world.spawn(4, 1.0, 2.0, 0.5)
    pivot, yaw = np.array([0.1, -0.2]), 0.3
    moves.adjustment[0] = turned(pivot, yaw)
    world.step(moves)
    bare = World(GRAPH, 1)
    bare.spawn(4, 1.0, 2.0, 0.5)
    bare.step(moves_along(GRAPH, np.array([4], np.int32)))
    to_world = homogeneous(bare.place[0])
    about = to_world @ [pivot[0], 0.0, pivot[1], 1.0]
    for fraction in (1e-6, 0.25, 0.5, 1.0):
        (root, rotations), (plain, plain_rotations) = seen(world, fraction), seen(bare, fraction)
        expected = about[:3] + quaternion.rotate(quaternion.from_yaw(fraction * yaw), plain - about[:3])
        np.testing.assert_allclose(root, expected, atol=1e-6)
        turn = quaternion.multiply(quaternion.from_yaw(fraction * yaw), plain_rotations[0])
        assert angle_between(rotations[0], turn) < 1e-6
        np.testing.assert_array_equal(rotations[1:], plain_rotations[1:])
    np.testing.assert_allclose(homogeneous(world.place[0]), to_world @ homogeneous(moves.adjustment[0]), atol=1e-12)
