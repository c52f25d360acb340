"""A bundle replaced under a running server, and one that cannot be."""

import threading
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.bundle import sealed, write_bundle
from footwork.protocol.pose_arrays import root_of
from footwork.runtime.reload import Reloader
from footwork.runtime.simulation import Simulation
from footwork.runtime.succession import Succession, nearest_nodes
from served import TIMEOUT, client_of, serving, until
from toy_bundle import toy_bundle

PACES = {"walk": (1.0, 2.0)}


def other_bundle():
    return sealed(replace(toy_bundle(), attribution=("another one",)))


def taller_bundle():
    bundle = toy_bundle()
    skeleton = replace(bundle.graph.skeleton, offsets=2.0 * bundle.graph.skeleton.offsets)
    return replace(bundle, graph=replace(bundle.graph, skeleton=skeleton))


@contextmanager
def reloading(tmp_path, **options):
    path = tmp_path / "served.footwork"
    write_bundle(path, toy_bundle())
    with (
        serving() as server,
        Reloader(server, {"bundle": path}, **options) as reloader,
        client_of(server) as client,
    ):
        client.spawn(7, x=20.0, z=-10.0)
        yield path, server, reloader, client


def test_sessions_go_on_in_the_new_bundle_and_are_told(tmp_path):
    with reloading(tmp_path) as (path, server, reloader, client):
        before = next(client.poses())
        write_bundle(path, other_bundle())
        reloader.ask()
        until(lambda: server.reloads == 1)
        poses = client.poses()
        ticks = [next(poses).tick for _ in range(60)]
        after = next(poses)
    assert client.welcome.digest == other_bundle().digest
    assert client.welcome.resumed
    assert after.character == before.character == 7
    np.testing.assert_allclose(root_of(after)[[0, 2]], root_of(before)[[0, 2]], atol=3.0)
    assert set(np.diff(ticks)) <= {0, 1}


@pytest.mark.parametrize("spoil", ["cut short", "changed", "another body", "no file"])
def test_what_cannot_take_its_place_is_refused_and_the_old_one_goes_on(tmp_path, caplog, spoil):
    with reloading(tmp_path) as (path, server, reloader, client):
        if spoil == "another body":
            write_bundle(path, taller_bundle())
        elif spoil == "no file":
            path.unlink()
        else:
            data = bytearray(path.read_bytes())
            data[-1] ^= 1
            path.write_bytes(data[:5000] if spoil == "cut short" else data)
        reloader.ask()
        until(lambda: "the old bundle goes on" in caplog.text)
        tick = next(client.poses()).tick
        assert next(pose for pose in client.poses() if pose.tick > tick + 3)
        assert server.reloads == 0
        assert client.welcome.digest == server.simulation.bundle.digest


def test_watching_notices_a_new_file_by_itself(tmp_path):
    with reloading(tmp_path, watch=True) as (path, server, _, _):
        write_bundle(path, other_bundle())
        until(lambda: server.reloads == 1)


def test_a_character_goes_on_at_its_place_in_its_pose_with_what_it_was_asked_for():
    former, latter = (Simulation(bundle, 4) for bundle in (toy_bundle(), other_bundle()))
    former.spawn(0.0, 0.0, 0.0)
    slot = former.spawn(3.0, 4.0, 0.5, "walk")
    former.give(slot, former.vocabulary.outright(1.25, "walk"))
    for _ in range(7):
        former.step()
    there = Succession(former, latter).move(slot)
    assert latter.world.node[there] == former.world.node[slot]
    np.testing.assert_array_equal(latter.world.place[there], former.world.place[slot])
    assert latter.lasting(there) == (1.25, "walk", None)


def one_shots(simulation, slot):
    given = simulation.orders.in_force
    return given.held[slot], given.latched[slot]


@pytest.mark.parametrize("let_go", [False, True])
def test_a_jump_that_waits_goes_on_waiting_and_one_that_was_made_is_not_made_again(let_go):
    former, latter = (Simulation(bundle, 2) for bundle in (toy_bundle(), other_bundle()))
    jump, slot = former.vocabulary.index("jump"), former.spawn(0.0, 0.0, 0.0, "walk")
    walks = former.vocabulary.outright(0.0, "walk")
    former.give(slot, replace(walks, one_shot=jump))
    if let_go:
        former.give(slot, walks)
    assert one_shots(latter, Succession(former, latter).move(slot)) == (-1 if let_go else jump, jump)
    for _ in range(90):  # it jumps, and lands
        former.step()
    assert one_shots(former, slot) == (-1 if let_go else jump, -1)
    there = Succession(former, latter).move(slot)
    latter.give(there, walks if let_go else replace(walks, one_shot=jump))
    assert one_shots(latter, there) == (-1 if let_go else jump, -1)


def test_a_speed_that_was_asked_for_is_asked_for_on_where_it_can_be():
    former, slower, without = (Simulation(toy_bundle(speeds=speeds), 1) for speeds in (PACES, {"walk": (0.5, 1.0)}, {}))
    slot = former.spawn(0.0, 0.0, 0.0)
    former.give(slot, former.vocabulary.outright(0.5, "walk", 1.5))
    assert slower.lasting(Succession(former, slower).move(slot)) == (0.5, "walk", 1.5)
    assert without.lasting(Succession(former, without).move(slot)) == (0.5, "walk", None)


def test_the_nearest_node_is_the_one_a_search_over_all_finds():
    graph = toy_bundle().graph
    nearest = nearest_nodes(graph, graph)
    joints = graph.joint_places.reshape(graph.node_count, -1)
    poses = np.hstack([joints, 0.2 * graph.root_velocity])
    for node in range(0, graph.node_count, 5):
        same = np.flatnonzero(graph.behaviour == graph.behaviour[node])
        distances = np.square(poses[same] - poses[node]).sum(axis=1)
        assert distances[list(same).index(nearest[node])] == pytest.approx(distances.min(), abs=1e-4)


def test_another_body_is_refused():
    former, latter = (Simulation(bundle, 1) for bundle in (toy_bundle(), taller_bundle()))
    with pytest.raises(InputError, match="another body"):
        Succession(former, latter)


def test_a_server_that_ended_lets_nobody_wait():
    with serving() as server:
        pass
    succession = Succession(server.simulation, server.simulate(other_bundle()))
    thread = threading.Thread(target=server.succeed, args=(succession,))
    thread.start()
    thread.join(TIMEOUT)
    assert not thread.is_alive()
