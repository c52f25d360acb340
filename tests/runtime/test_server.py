"""A live server on loopback: its clients, and those that are none."""

import random
import threading
import time
from contextlib import suppress

import msgpack
import pytest
import zmq

from footwork.errors import InputError
from footwork.protocol import messages as m
from footwork.protocol.client import Client
from footwork.protocol.codec import encode
from footwork.protocol.errors import BEHAVIOUR, MALFORMED, STALE, TOO_LARGE, VERSION, LocalError, RefusedError
from footwork.protocol.pose_arrays import root_of
from footwork.runtime.limits import Limits
from footwork.runtime.server import Server
from served import (
    BUNDLE,
    TIMEOUT,
    answer,
    client_of,
    consecutive,
    pose_that_acknowledges,
    serving,
    stranger,
    ticks,
    until,
)
from toy_bundle import SHOWN


@pytest.fixture
def server():
    with serving() as server:
        yield server


@pytest.fixture
def client(server):
    with client_of(server, name="test") as client:
        client.spawn(0)
        yield client


def test_poses_come_every_tick_and_commands_are_acknowledged(server, client):
    assert client.welcome.behaviours == SHOWN
    assert consecutive(ticks(client, 10))
    sequence = client.command(0, 1.0, "walk")
    assert pose_that_acknowledges(client, sequence).frame == 1
    summary = server.summary()
    assert summary["ticks"] >= 10
    assert summary["sessions"] == 1
    assert 0 < summary["tick_us"]["p50"] <= summary["tick_us"]["p99"]


@pytest.mark.parametrize("rate", [30, 60, 120])
def test_the_rate_gives_so_many_poses_a_tick_and_thirty_ticks_a_second(rate):
    begun = time.monotonic()
    with serving(rate=rate) as server, client_of(server) as client:
        client.spawn(0)
        poses, frames = client.poses(), rate // 30
        shown = [(pose.tick - 1) * frames + pose.frame for pose, _ in zip(poses, range(rate // 2), strict=False)]
        assert time.monotonic() - begun > shown[-1] / rate
    assert shown == list(range(shown[0], shown[0] + rate // 2))


def test_held_keys_and_corrections_go_over_the_wire(client):
    sequence = client.keys(0, m.Keys(view_yaw=0.5, forward=1))
    assert pose_that_acknowledges(client, sequence)
    sequence = client.correct(0, 40.0, -30.0, 1.0)
    assert root_of(pose_that_acknowledges(client, sequence))[[0, 2]] == pytest.approx([40.0, -30.0], abs=0.5)


def test_ping_does_not_wait_for_a_tick_and_loses_no_poses(client):
    numbers = ticks(client, 2)
    until(lambda: client.ping() < 1 / 120)
    assert consecutive(numbers + ticks(client, 5))


def test_a_flood_of_messages_holds_no_tick_up(server, client):
    with stranger(server) as flooding:
        enough = threading.Event()

        def flood() -> None:
            while not enough.is_set():
                with suppress(zmq.Again):
                    flooding.send(bytes(1000), zmq.NOBLOCK)

        thread = threading.Thread(target=flood)
        thread.start()
        seen = ticks(client, 25)
        until(lambda: server.summary()["refused"] > 500)
        enough.set()
        thread.join()
    assert consecutive(seen)


def test_a_command_that_came_before_the_deadline_takes_effect_though_the_server_was_held_up():
    hold, held = threading.Event(), threading.Event()

    def hold_up_once() -> bool:
        if hold.is_set() and not held.is_set():
            held.set()
            server._router.poll(1000 * TIMEOUT)  # until the command came in
        return False

    with serving(hold_up_once, rate=30) as server, client_of(server) as client:
        client.spawn(0)
        ticks(client, 2)
        hold.set()
        held.wait(TIMEOUT)
        last = server.ticks
        assert pose_that_acknowledges(client, client.command(0, 0.0, "walk")).tick == last + 1


def test_an_unknown_behaviour_is_refused_with_those_there_are(client):
    sequence = client.command(0, 0.0, "run")
    with pytest.raises(RefusedError) as caught:
        pose_that_acknowledges(client, sequence)
    assert (caught.value.code, caught.value.sequence, caught.value.valid) == (BEHAVIOUR, sequence, SHOWN)


@pytest.mark.parametrize("wanted", ["run", "swim", ""])
def test_a_character_goes_on_after_a_behaviour_that_the_bundle_lacks(client, wanted):
    before = pose_that_acknowledges(client, client.command(0, 0.0, "walk"))
    sequence = client.command(0, 1.0, wanted)
    with pytest.raises(RefusedError, match="stop, walk, jump") as caught:
        pose_that_acknowledges(client, sequence)
    assert caught.value.valid == SHOWN
    assert pose_that_acknowledges(client, client.command(0, 0.0, "stop")).tick > before.tick


def test_stop_says_bye_and_frees_the_address(server):
    client = client_of(server)
    server.stop()
    with pytest.raises(RefusedError, match="shutdown"):
        list(client.poses())
    client.close()
    assert server.wait(TIMEOUT)
    Server(BUNDLE, bind=server.address).close()


def test_run_ends_when_until_says_so():
    server = Server(BUNDLE, bind="tcp://127.0.0.1:0", rate=120)
    server.run(until=lambda: server.ticks >= 5)
    assert server.ticks == 5


def test_silence_ends_a_session_but_a_client_that_only_looks_stays():
    with (
        serving(limits=Limits(idle_seconds=1.5)) as server,
        stranger(server) as silent,
        client_of(server) as client,
    ):
        client.spawn(0)
        silent.send(encode(m.Hello(version=1)))
        assert isinstance(answer(silent), m.Welcome)
        assert consecutive(ticks(client, 60))
        assert answer(silent) == m.Bye(reason="idle")


def test_the_wrong_version_is_told_the_right_one(server):
    with stranger(server) as socket:
        socket.send(encode(m.Hello(version=7)))
        error = answer(socket)
        assert isinstance(error, m.Error)
        assert error.code == VERSION
        assert answer(socket) == m.Bye(reason="version")


def test_stale_sequences_are_refused_and_change_nothing(server):
    with stranger(server) as socket:
        for message in (m.Hello(version=1), m.Spawn(sequence=5, character=0), m.Despawn(sequence=5, character=0)):
            socket.send(encode(message))
        seen = []
        while not seen or not isinstance(seen[-1], m.Pose):
            seen.append(answer(socket))
        assert [message.code for message in seen if isinstance(message, m.Error)] == [STALE]


def test_a_message_of_several_parts_or_too_long_is_refused(server):
    with stranger(server) as socket:
        for parts, code in (([b"a", b"b"], MALFORMED), ([b""], MALFORMED), ([bytes(2000)], TOO_LARGE)):
            socket.send_multipart(parts)
            error = answer(socket)
            assert isinstance(error, m.Error)
            assert error.code == code


def test_an_enormous_message_costs_its_sender_the_connection_and_nobody_else(server, client):
    with stranger(server) as socket:
        socket.send(bytes(1 << 22))
        assert consecutive(ticks(client, 10))


def mutated(rng: random.Random) -> bytes:
    seeds = [
        encode(m.Hello(version=1)),
        encode(m.Spawn(sequence=rng.randrange(1, 1000), character=rng.randrange(20))),
        encode(m.Command(sequence=rng.randrange(1, 1000), character=0, keys=m.Keys(view_yaw=1.0, forward=1))),
        encode(m.Correct(sequence=rng.randrange(1, 1000), character=0, x=1.0, z=1.0, yaw=0.0)),
        msgpack.Packer().pack({"type": "hello", "version": [[[]]] * 10}),
        rng.randbytes(rng.randrange(100)),
    ]
    data = bytearray(rng.choice(seeds))
    for _ in range(rng.randrange(3)):
        if data:
            data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def test_others_lose_no_tick_while_one_floods_with_garbage_and_dies(server, client):
    rng = random.Random(6)
    numbers = ticks(client, 5)
    with stranger(server) as flood:
        flood.set(zmq.SNDTIMEO, 1000 * TIMEOUT)
        flood.send(encode(m.Hello(version=1)))
        for _ in range(4000):
            flood.send(mutated(rng))
        numbers += ticks(client, 10)
    numbers += ticks(client, 20)
    assert consecutive(numbers)
    assert server.summary()["refused"] > 1000
    with client_of(server) as late:
        late.spawn(0)
        assert consecutive(ticks(late, 3))


def test_a_client_that_does_not_read_holds_nobody_up():
    with serving(rate=120) as server, stranger(server) as deaf, client_of(server) as client:
        client.spawn(0)
        deaf.set(zmq.RCVHWM, 1)
        deaf.send(encode(m.Hello(version=1)))
        for number in range(16):
            deaf.send(encode(m.Spawn(sequence=number + 1, character=number)))
        assert consecutive(ticks(client, 30))


def test_nobody_at_the_other_end_is_told_in_time():
    with pytest.raises(RefusedError, match="no answer to hello"):
        Client("tcp://127.0.0.1:9", timeout=0.1)


@pytest.mark.parametrize("address", ["nonsense", "tcp://127.0.0.1", "ftp://127.0.0.1:5"])
def test_an_address_that_is_none_is_the_callers_bug(address):
    with pytest.raises(LocalError, match="expected such as"):
        Client(address)


def test_another_rate_is_refused():
    with pytest.raises(InputError, match=r"50 frames a second, expected one of \(30, 60, 120\)"):
        Server(BUNDLE, bind="tcp://127.0.0.1:0", rate=50)
