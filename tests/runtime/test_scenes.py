"""Several bundles in one server: each with sessions, ticks, a recording and spectators of its own."""

import urllib.request
from dataclasses import replace

import pytest

from footwork.errors import InputError
from footwork.motion.bundle import read_bundle, sealed, write_bundle
from footwork.protocol import messages as m
from footwork.protocol.errors import BUNDLE, CHARACTERS, RefusedError
from footwork.protocol.spectator import Spectator
from footwork.runtime.monitoring import Monitoring
from footwork.runtime.recording import read_recording
from footwork.runtime.reload import Reloader
from footwork.runtime.server import Server
from served import TIMEOUT, client_of, serving, until
from talk import LIMITS, Talk, codes, spawn, walk
from toy_bundle import toy_bundle

SLOW = toy_bundle(speeds={"walk": (0.5, 1.5)})
OTHER = sealed(replace(toy_bundle(), attribution=("another one",)))


@pytest.fixture(params=[False, True], ids=["clock", "lock-step"])
def lockstep(request):
    return request.param


@pytest.fixture
def talk(lockstep):
    return Talk(lockstep=lockstep, slow=SLOW)


def test_a_hello_chooses_and_the_welcome_tells(talk):
    for asked, name, digest in (("", "bundle", talk.host.simulation.bundle.digest), ("slow", "slow", SLOW.digest)):
        welcome = talk.open(asked.encode() + b".", bundle=asked)
        assert (welcome.bundle, welcome.bundles, welcome.digest) == (name, ("bundle", "slow"), digest)
        assert bool(welcome.speeds) == (name == "slow")


def test_a_name_that_is_not_there_is_turned_away_with_those_there_are(talk):
    error, bye = talk.say(b"a", m.Hello(version=1, bundle="swift"))
    assert (error.code, error.valid, bye.reason) == (BUNDLE, ("bundle", "slow"), BUNDLE)
    assert "expected one of bundle, slow" in error.message
    assert b"a" not in talk.host.sessions


def test_a_session_that_is_resumed_stays_with_its_bundle(talk):
    token = talk.open(b"a", bundle="slow").token
    talk.host.lose(b"a", 0)
    assert talk.open(b"b", bundle="bundle", resume=token).bundle == "slow"


def test_each_has_a_world_of_its_own_and_characters_are_counted_together():
    talk = Talk(slow=SLOW)
    for peer, name in ((b"a", ""), (b"b", "slow")):
        talk.open(peer, bundle=name)
        talk.say(peer, spawn(1, 0, x=5.0), spawn(2, 1))
        assert not codes(talk.tick(peer))
    first, slow = talk.host.scenes
    assert [len(scene.simulation.world.slots) for scene in (first, slow)] == [2, 2]
    talk.say(b"b", spawn(3, 2))
    assert codes(talk.tick(b"b")) == [CHARACTERS]  # LIMITS.characters, and room in either world
    assert LIMITS.characters == talk.host.scenes.character_count == 4
    talk.say(b"a", walk(3, speed=1.0))
    assert codes(talk.tick(b"a")) == ["speed"]
    talk.say(b"b", walk(4, speed=1.0))
    assert not codes(talk.tick(b"b"))
    talk.say(b"a", m.Bye())
    assert [len(scene.simulation.world.slots) for scene in (first, slow)] == [0, 2]


def test_in_lock_step_nobody_waits_for_who_plays_another_bundle():
    talk = Talk(lockstep=True, slow=SLOW)
    for peer, name in ((b"a", ""), (b"b", "slow")):
        talk.open(peer, bundle=name)
        talk.say(peer, spawn(1, 0), m.Step())
        while talk.host.step():
            pass
    talk.say(b"b", m.Step(ticks=5))
    while stepped := talk.host.step():
        assert [scene.name for scene in stepped] == ["slow"]
    assert [scene.simulation.tick for scene in talk.host.scenes] == [1, 6]
    assert talk.answers(b"b")[-1] == m.Stepped(tick=6)


@pytest.mark.parametrize("names", [(), ("a/b",), ("",), ("x" * 65,), ("a b",)])
def test_what_cannot_be_a_name_is_refused(names):
    with pytest.raises(InputError, match="expected"):
        Server(dict.fromkeys(names, toy_bundle()), bind="tcp://127.0.0.1:0")


def test_a_live_server_plays_reloads_records_shows_and_counts_each_by_itself(tmp_path):
    paths = {name: tmp_path / f"{name}.footwork" for name in ("bundle", "slow")}
    for path in paths.values():
        write_bundle(path, SLOW if path.stem == "slow" else toy_bundle())
    bundles = {name: read_bundle(path) for name, path in paths.items()}
    kept = tmp_path / "kept"
    with (
        serving(bundle=bundles, spectate="tcp://127.0.0.1:0", record=kept) as server,
        Reloader(server, paths) as reloader,
        Monitoring(server, "127.0.0.1:0") as monitoring,
        client_of(server) as one,
        client_of(server, bundle="slow") as other,
    ):
        one.spawn(0, x=50.0)
        other.spawn(0, x=-50.0)
        assert next(one.poses()).character == next(other.poses()).character == 0
        with pytest.raises(RefusedError, match="bundle"):
            Spectator(server.gallery_address or "", bundle="swift", timeout=TIMEOUT)
        with Spectator(server.gallery_address or "", bundle="slow", timeout=TIMEOUT) as spectator:
            assert spectator.scene.digest == SLOW.digest
            public = next(spectator.poses())
            own = next(pose for pose in other.poses() if (pose.tick, pose.frame) >= (public.tick, public.frame))
            while (own.tick, own.frame) > (public.tick, public.frame):
                public = next(spectator.poses())
            assert public.root == own.root
            write_bundle(paths["slow"], OTHER)
            reloader.ask()
            until(lambda: server.reloads == 1)
            until(lambda: next(spectator.poses()) and spectator.scene.digest == OTHER.digest)
        until(lambda: next(other.poses()) and other.welcome.digest == OTHER.digest)
        assert (one.welcome.digest, other.welcome.bundle) == (bundles["bundle"].digest, "slow")
        metrics = urllib.request.urlopen(f"{monitoring.address}/metrics", timeout=TIMEOUT).read().decode()
    for line in ('footwork_reloads_total{bundle="slow"} 1.0', 'footwork_characters{bundle="bundle"} 1.0'):
        assert line in metrics
    summary = server.summary()
    assert {name: told["sessions"] for name, told in summary["bundles"].items()} == {"bundle": 1, "slow": 1}
    recorded = {read_recording(path).header.bundle for path in kept.iterdir()}
    assert recorded == {bundles["bundle"].digest, SLOW.digest, OTHER.digest}
    assert sorted(path.stem.split("-")[2] for path in kept.iterdir()) == ["bundle", "slow", "slow"]
