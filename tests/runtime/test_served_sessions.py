"""Sessions of a live server: lost and resumed ones, and ticks that are asked for."""

import time

import pytest

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.errors import RefusedError
from footwork.protocol.pose_arrays import root_of
from footwork.runtime.limits import Limits
from served import answer, client_of, consecutive, pose_that_acknowledges, serving, stranger, ticks, until


@pytest.fixture
def server():
    with serving() as server:
        yield server


def test_a_client_that_dies_leaves_no_character_behind():
    with serving(limits=Limits(resume_seconds=0.1)) as server, client_of(server) as client:
        client.spawn(0)
        with stranger(server) as dying:
            dying.send(encode(m.Hello(version=1)))
            dying.send(encode(m.Spawn(sequence=1, character=3)))
            while not isinstance(answer(dying), m.Pose):
                pass
        seen = ticks(client, 1)
        until(lambda: server.population()["open_sessions"] == server.population()["characters"] == 1)
        assert consecutive(seen + ticks(client, 5))


def test_a_client_whose_connection_broke_gets_its_character_back(server):
    first = client_of(server)
    acknowledged = pose_that_acknowledges(first, first.spawn(4, x=20.0)).acknowledged
    first._socket.close(linger=0)
    with client_of(server, resume=first.welcome.token) as second:
        assert (second.welcome.resumed, second.welcome.spawned) == (True, (4,))
        pose = next(second.poses())
        assert (pose.character, pose.acknowledged) == (4, acknowledged)
        assert root_of(pose)[0] == pytest.approx(20.0, abs=1.0)
        assert pose_that_acknowledges(second, second.command(4, 0.0, "walk")).acknowledged == acknowledged + 1
    assert server.summary()["resumed"] == 1


def test_in_lock_step_ticks_are_made_when_asked_for():
    with serving(lockstep=True) as server, client_of(server, events=("behaviour",)) as client:
        assert client.welcome.lockstep
        client.spawn(0, behaviour="stop")
        client.command(0, 0.0, "walk")
        begun = time.monotonic()
        shown = [client.step()[0] for _ in range(60)]
        (last,) = client.step(30)
        assert [pose.tick for pose in shown] == list(range(1, 61))
        assert (last.tick, last.frame) == (90, 2)
        for _ in range(100):
            client.step(30)
        assert time.monotonic() - begun < 90.0  # a clock would take 103 s
        told = [client.receive(0) for _ in range(3)]
        assert [event.kind for event in told if isinstance(event, m.Event)] == ["spawned", "behaviour", "behaviour"]
        client.despawn(3)
        with pytest.raises(RefusedError, match="no character 3"):
            client.step()
        assert client.step()[0].tick == 3092


def test_a_clock_is_not_stepped(server):
    with client_of(server) as client, pytest.raises(RefusedError, match="lock_step"):
        client.step()
