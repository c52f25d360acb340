"""Spectators of a live server."""

import time

import pytest
import zmq

from footwork.errors import InputError
from footwork.protocol.errors import LocalError, RefusedError
from footwork.protocol.spectator import Spectator, Topics
from footwork.runtime.server import Server
from served import BUNDLE, TIMEOUT, client_of, serving

ANYWHERE = "tcp://127.0.0.1:0"


@pytest.fixture
def server():
    with serving(spectate=ANYWHERE) as server:
        yield server


def test_a_spectator_sees_what_the_clients_see(server):
    with client_of(server) as one, client_of(server) as other:
        one.spawn(7, x=5.0)
        other.spawn(7, x=-5.0)
        with Spectator(server.gallery_address, timeout=TIMEOUT) as spectator:
            assert (spectator.scene.joints, spectator.scene.token) == (one.welcome.joints, b"")
            public = next(pose for pose in spectator.poses() if pose.character == 0)
            own = next(pose for pose in one.poses() if (pose.tick, pose.frame) >= (public.tick, public.frame))
            while (own.tick, own.frame) > (public.tick, public.frame):
                public = next(pose for pose in spectator.poses() if pose.character == 0)
        assert (own.root, own.rotations, own.facing) == (public.root, public.rotations, public.facing)
        assert (own.character, public.acknowledged) == (7, 0)


def test_a_spectator_may_look_at_one_character_only(server):
    with client_of(server) as client:
        for number in range(3):
            client.spawn(number)
        with Spectator(server.gallery_address, characters=[1], timeout=TIMEOUT) as spectator:
            poses = spectator.poses()
            assert {next(poses).character for _ in range(10)} == {1}


def test_in_lock_step_the_last_frame_of_every_tick_is_published():
    with serving(spectate=ANYWHERE, lockstep=True) as server, client_of(server) as client:
        client.spawn(0)
        watching = zmq.Context.instance().socket(zmq.SUB)
        with watching:
            watching.connect(server.gallery_address)
            watching.subscribe(b"scene")
            while not watching.poll(1):
                client.step(30)
        with pytest.raises(RefusedError, match="no scene"):
            Spectator(server.gallery_address or "", timeout=0.05)


def test_who_piles_up_subscriptions_is_cut_and_the_others_watch_on(server):
    with client_of(server) as client, zmq.Context.instance().socket(zmq.SUB) as greedy:
        client.spawn(0)
        with Spectator(server.gallery_address, timeout=TIMEOUT) as spectator:
            greedy.set(zmq.RECONNECT_IVL, -1)
            greedy.connect(server.gallery_address)
            for number in range(4000):
                greedy.subscribe(f"a topic of nobody's {number}")
            poses = spectator.poses()
            first = next(poses)
            while not server._gallery._connections.cut and next(poses).tick < first.tick + 30 * TIMEOUT:
                pass
            assert server._gallery._connections.cut == 1
            assert next(poses).character == 0


def test_in_lock_step_spectators_are_bounded_while_nobody_steps():
    with serving(lockstep=True, spectate=ANYWHERE) as server, zmq.Context.instance().socket(zmq.SUB) as greedy:
        greedy.set(zmq.RECONNECT_IVL, -1)
        greedy.connect(server.gallery_address)
        for number in range(4000):
            greedy.subscribe(f"a topic of nobody's {number}")
        end, gallery = time.monotonic() + TIMEOUT, server._gallery
        assert gallery is not None
        while not gallery._connections.cut and time.monotonic() < end:
            time.sleep(0.01)
        assert gallery._connections.cut == 1


def test_topics_are_no_beginnings_of_others():
    topics = [Topics().pose(number) for number in (0, 1, 10, 100, 65535)]
    assert not [(a, b) for a in topics for b in topics if a != b and b.startswith(a)]


def test_a_place_that_cannot_be_bound_is_refused_and_frees_the_servers_own():
    server = Server(BUNDLE, bind=ANYWHERE)
    address = server.address
    for place in (address, "tcp://127.0.0.1:99999"):
        with pytest.raises(InputError, match="cannot bind"):
            Server(BUNDLE, bind=ANYWHERE, spectate=place)
    server.close()
    with pytest.raises(LocalError, match="expected such as"):
        Spectator("nonsense")


def test_what_a_spectator_says_takes_nothing_from_the_others(server):
    with client_of(server) as client, zmq.Context.instance().socket(zmq.XSUB) as talker:
        client.spawn(0)
        with Spectator(server.gallery_address, timeout=TIMEOUT) as spectator:
            talker.connect(server.gallery_address)
            for said in (b"", b"nothing", b"\2"):
                talker.send(said)
            poses = spectator.poses()
            first = next(poses)
            assert next(pose for pose in poses if pose.tick > first.tick + 5)
