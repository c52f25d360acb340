"""Arenas: whoever is spawned fights an opponent, by the same rules and to the same bytes as in any match."""

import math

import numpy as np
import pytest

from fighting_bundle import fighting_bundle, fighting_ground
from footwork.controllers.stepping import STAND, Stepping, wish_towards
from footwork.errors import InputError
from footwork.motion.planar import after
from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server
from footwork.protocol.compliance import run
from footwork.protocol.spectator import Spectator
from footwork.runtime.arena import Arena
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.match_rules import MatchRules
from footwork.runtime.opponent import Opponent, opponent_named, recorded_opponent
from footwork.runtime.recording import Opposed, read_recording
from footwork.runtime.replay import Replay, start_recording
from footwork.runtime.succession import Succession
from footwork.runtime.world_errors import WorldFull
from in_process import Switchboard
from served import TIMEOUT, client_of, serving
from talk import SECOND, Talk, codes, spawn

OPPONENT = Opponent("aggressive", opponent_named("aggressive").style, rules=MatchRules(round_seconds=5.0), seed=4)


def arena(capacity=4, opponent=OPPONENT):
    return Arena(fighting_bundle(), capacity, opponent=opponent)


def towards(one, slot=0):
    """The yaw at which a character has its opponent ahead."""
    x, z, _ = one.world.place[slot + 1] - one.world.place[slot]
    return math.atan2(x, z)


def played(one, slot, ticks):
    """Ticks in which a player comes near and strikes, and all that happened in them."""
    happened = []
    for tick in range(ticks):
        yaw = towards(one, slot)
        if tick % 20 == 0:
            one.give(slot, one.vocabulary.outright(yaw, "evade" if tick % 100 == 80 else "attack"))
        elif tick % 20 == 5:
            one.give(slot, one.vocabulary.of_keys(yaw, 1, 0, False))
        one.step()
        happened += one.happened
    return happened


@pytest.fixture(scope="module")
def fought():
    one = arena()
    slot = one.spawn(0.0, 0.0, 0.3)
    return one, played(one, slot, 600)


def kinds(happened, slot):
    return [one.kind for one in happened if one.slot == slot]


def test_a_player_and_its_opponent_fight(fought):
    one, happened = fought
    for slot in (0, 1):
        assert {"attack", "hit"} <= set(kinds(happened, slot)), "both strike, and land some"
    assert "evade" in kinds(happened, 0)
    damage = sum(blow.worth for blow in happened if blow.kind == "hit")
    assert damage > 0.0
    assert kinds(happened, 0).count("round") + kinds(happened, 1).count("round") > 0
    apart = one.world.place[1, :2] - one.world.place[0, :2]
    assert np.hypot(*apart) > 0.9 * OPPONENT.rules.apart


def test_an_opponent_begins_ahead_and_looks_back():
    one = arena()
    slot = one.spawn(3.0, -1.0, 0.5)
    x, z, yaw = one.world.place[slot + 1]
    start = OPPONENT.rules.start
    assert (x, z) == pytest.approx((3.0 + start * math.sin(0.5), -1.0 + start * math.cos(0.5)))
    assert math.cos(yaw - 0.5) == pytest.approx(-1.0)
    assert one.spawn(9.0, 9.0, 0.0) == 2
    with pytest.raises(WorldFull):
        one.spawn(0.0, 0.0, 0.0)


def test_the_seed_gives_the_same_bytes_and_another_gives_others(fought):
    def digest(seed):
        other = arena(opponent=Opponent("aggressive", OPPONENT.style, rules=OPPONENT.rules, seed=seed))
        played(other, other.spawn(0.0, 0.0, 0.3), 600)
        return other.digest()

    assert digest(4) == fought[0].digest() != digest(5)


def test_fights_do_not_touch_one_another(fought):
    one = arena(capacity=6)
    other = one.spawn(0.0, 0.0, 0.0)
    slot = one.spawn(0.0, 0.0, 0.3)
    played(one, other, 50)
    one.remove(other)
    assert one.world.slots.tolist() == [slot, slot + 1]
    assert one.spawn(5.0, 5.0, 0.0) == other
    assert (one.health[:2] == 1.0).all()


def test_an_opponent_takes_no_commands_and_leaves_with_its_player():
    one = arena()
    slot = one.spawn(0.0, 0.0, 0.0)
    for refused in (lambda: one.give(1, one.vocabulary.of_keys(0.0, 1, 0, False)), lambda: one.remove(1)):
        with pytest.raises(InputError, match="opponent"):
            refused()
    one.remove(slot)
    assert not len(one.world.slots)


@pytest.mark.parametrize(("forward", "strafe"), [(1, 0), (-1, 0)])
def test_keys_step_that_way_with_the_face_to_the_opponent(forward, strafe):
    one = arena(opponent=Opponent("patient", opponent_named("patient").style))
    slot = one.spawn(0.0, 0.0, 0.0)
    one.teleport(slot + 1, 0.0, 8.0, math.pi)
    one.give(slot, one.vocabulary.of_keys(0.0, forward, strafe, False))
    one.play(60, 0)
    _x, z, yaw = one.world.place[slot]
    assert forward * z > 0.3
    assert abs(yaw - towards(one)) < 0.3


def test_who_holds_no_key_stands():
    one = arena(opponent=Opponent("patient", opponent_named("patient").style))
    slot = one.spawn(0.0, 0.0, 0.0)
    one.teleport(slot + 1, 0.0, 8.0, math.pi)
    one.play(60, 0)
    assert np.hypot(*one.world.place[slot, :2]) < 0.15


def test_a_snapshot_goes_on_as_the_fight_did(fought):
    one = arena()
    slot = one.spawn(0.0, 0.0, 0.3)
    played(one, slot, 100)
    blob = one.snapshot([0, 1])
    one.play(50, 0)
    digest = one.digest()
    one.restore(blob, [0, 1])
    one.resimulate([0, 1], 50)
    assert one.digest() == digest
    for slots in ([0], [1, 0], [0, 0]):
        with pytest.raises(InputError):
            one.snapshot(slots)


def test_a_snapshot_with_what_no_fighter_has_is_refused():
    one = arena()
    one.spawn(0.0, 0.0, 0.3)
    one.play(10, 0)
    digest, fighters = one.digest(), one._duels.duel.fighters
    kept, fighters["goal"][1] = fighters["goal"][1], 10**6
    blob = one.snapshot([0, 1])
    fighters["goal"][1] = kept
    with pytest.raises(InputError, match="no character has"):
        one.restore(blob, [0, 1])
    assert one.digest() == digest


def test_a_recorded_fight_replays_to_the_same_bytes(tmp_path):
    one, path = arena(), tmp_path / "fight.footrec"
    recorder = start_recording(one, path, rate=60)
    slot = one.spawn(0.0, 0.0, 0.3)
    played(one, slot, 150)
    one.restore(one.snapshot([0, 1]), [0, 1])
    played(one, slot, 60)
    one.correct(slot + 1, 1.0, 1.0, 0.0)
    played(one, slot, 60)
    one.remove(slot)
    one.end_recording()
    recorder.wait()
    recording = read_recording(path)
    outcome = Replay(recording, fighting_bundle()).run()
    assert (outcome.departed, outcome.ticks, outcome.agreed) == (None, 270, 270)
    first = recording.records[0]
    assert isinstance(first, Opposed)
    assert recorded_opponent(first, "test") == OPPONENT


def test_a_recording_with_styles_that_cannot_be_is_refused():
    record = OPPONENT.record(1)
    record.styles[1].pop("reach")
    with pytest.raises(InputError, match="FightingStyle"):
        recorded_opponent(record, "test")


def test_fights_stay_with_their_bundle():
    with pytest.raises(InputError, match="do not go over"):
        Succession(arena(), arena())


def test_stepping_goes_where_it_is_asked_to():
    ground = fighting_ground()
    stepping, world = Stepping(ground.hops), ground.world

    def walked(wish):
        place, node = (0.0, 0.0, 0.0), int(world.segments["last"][np.flatnonzero(world.segments["state"] == 0)[0]])
        for _ in range(90):
            at = world.nodes[node]
            edge = stepping.edge(int(at["segment"]), wish) if at["ends"] else int(at["edge_start"])
            taken = world.edges[edge]
            place, node = after(place, (taken["x"], taken["z"], taken["yaw"])), int(taken["target"])
            place = place[0], place[1], 0.8 * place[2]  # as aiming does
        return place

    assert math.hypot(*walked(STAND)[:2]) < 0.2
    assert walked(wish_towards(0.0))[1] > 0.6
    assert walked(wish_towards(math.pi))[1] < -0.6
    assert walked(wish_towards(0.5 * math.pi))[0] > 0.3 > -0.3 > walked(wish_towards(-0.5 * math.pi))[0]
    assert stepping.edge(int(np.flatnonzero(world.segments["state"] != 0)[0]), STAND) == -1


def test_wishes_are_the_nearest_of_eight_directions():
    assert [wish_towards(math.radians(angle)) for angle in (0, 22, 23, 180, -180, -90, 350)] == [1, 1, 2, 5, 5, 7, 1]


# On the wire.


def talk(**options):
    return Talk(bundle=fighting_bundle(), simulate=lambda bundle, capacity: arena(capacity), **options)


def told(messages, kind):
    return [message for message in messages if isinstance(message, m.Event) and message.kind == kind]


def test_a_client_is_told_of_its_opponent_and_how_both_fare():
    line = talk()
    assert line.open(b"a").opponent == "aggressive"
    assert not line.open(b"b").opponents
    line.say(b"a", spawn(1, 5))
    said = line.tick(b"a")
    pairs = [(event.character, event.opponent, event.sequence) for event in told(said, "spawned")]
    assert pairs == [(5, 0, 1), (0, 5, 1)]
    poses = [message for message in said if isinstance(message, m.Pose)]
    assert [(pose.character, pose.health, pose.stamina) for pose in poses] == [(5, 1.0, 1.0), (0, 1.0, 1.0)]
    assert codes(line.say(b"a", spawn(2, 0))) == []
    assert codes(line.tick(b"a")) == ["character_taken"]


def test_blows_and_rounds_are_told_to_whom_they_happen():
    line = talk()
    line.open(b"a")
    line.open(b"b")
    line.say(b"a", spawn(1, 5))
    sequence, said, others = 1, [], []
    for tick in range(600):
        line.now += SECOND // 60
        sequence += 1
        yaw = towards(line.host.simulation)
        keys = m.Command(sequence=sequence, character=5, keys=m.Keys(view_yaw=yaw, forward=1))
        strike = m.Command(sequence=sequence, character=5, heading=yaw, behaviour="attack")
        line.say(b"a", strike if tick % 40 == 0 else keys)
        line.say(b"b", m.Ping())
        line.host.tick()
        for peer, data in line.host.outgoing():
            (said if peer == b"a" else others).append(decode_from_server(data))
        said += line.poses(b"a")
    hits, rounds = told(said, "hit"), told(said, "round")
    assert {(event.character, event.opponent) for event in hits} == {(0, 5), (5, 0)}
    assert all(0.0 < (event.damage or 0.0) <= 0.1 for event in hits)
    assert rounds
    assert {event.character for event in rounds} <= {0, 5}
    assert not [message for message in others if isinstance(message, m.Event)]
    by_tick = {(pose.tick, pose.character): pose.health for pose in said if isinstance(pose, m.Pose)}
    blow = next(event for event in hits if len([one for one in hits if one.tick == event.tick]) == 1)
    before, after_it = (by_tick[blow.tick - back, blow.character] for back in (1, 0))
    assert before - blow.damage == pytest.approx(after_it)  # type: ignore[operator]  # a hit has it


def test_an_opponent_obeys_nobody_but_can_be_moved():
    line = talk()
    line.open(b"a")
    line.say(b"a", spawn(1, 5))
    line.tick(b"a")
    command = m.Command(sequence=2, character=0, keys=m.Keys(view_yaw=0.0, forward=1))
    line.say(
        b"a", command, m.Despawn(sequence=3, character=0), m.Correct(sequence=4, character=0, x=9.0, z=9.0, yaw=0.0)
    )
    said = line.tick(b"a")
    assert codes(said) == ["opponent", "opponent"]
    assert told(said, "corrected")
    line.say(b"a", m.Despawn(sequence=5, character=5))
    assert [event.character for event in told(line.tick(b"a"), "despawned")] == [5, 0]


def test_limits_count_both():
    line = talk()
    line.open(b"a")
    line.open(b"b")
    line.say(b"a", spawn(1, 5), spawn(2, 6))
    assert codes(line.tick(b"a")) == ["characters"], "three are a session's"
    line.say(b"b", spawn(1, 0))
    line.tick(b"b")
    line.open(b"c")
    line.say(b"c", spawn(1, 0))
    assert codes(line.tick(b"c")) == ["characters"], "four are the server's"
    line.host.forget(b"a", "test")
    line.say(b"c", spawn(2, 0))
    assert not codes(line.tick(b"c"))


def test_a_resumed_session_knows_whom_it_fights():
    line = talk()
    token = line.open(b"a").token
    line.say(b"a", spawn(1, 5))
    line.tick(b"a")
    line.host.lose(b"a", line.now)
    line.tick(b"a")
    welcome = line.open(b"z", resume=token)
    assert welcome.resumed
    assert welcome.spawned == (5, 0)
    assert welcome.opponents == ((5, 0),)
    assert [pose.character for pose in line.tick(b"z") if isinstance(pose, m.Pose)] == [5, 0]


def test_fights_go_on_in_lock_step():
    line = talk(lockstep=True)
    line.open(b"a")
    line.say(b"a", spawn(1, 5), m.Step(ticks=2))
    assert len(line.host.step()) == len(line.host.step()) == 1
    said = line.answers(b"a")
    assert [pose.character for pose in said if isinstance(pose, m.Pose)] == [5, 0]
    assert m.Stepped(tick=2) in said


def test_keys_that_jump_are_told_what_there_is():
    line = talk()
    line.open(b"a")
    line.say(b"a", spawn(1, 5), m.Command(sequence=2, character=5, keys=m.Keys(view_yaw=0.0, jump=True)))
    (error,) = [message for message in line.tick(b"a") if isinstance(message, m.Error)]
    assert error.code == "behaviour"
    assert error.valid == ("locomotion", "attack", "evade")


@pytest.mark.parametrize("lockstep", [False, True])
def test_a_host_of_fights_keeps_to_the_protocol(lockstep):
    host = Host(arena(capacity=64), 60, Limits(), lockstep=lockstep)
    assert {outcome.name: outcome.problem for outcome in run(Switchboard(host, 2).dial) if outcome.problem} == {}


def test_spectators_see_both_and_how_they_fare():
    with (
        serving(bundle=fighting_bundle(), spectate="tcp://127.0.0.1:0", opponent=OPPONENT) as server,
        client_of(server) as client,
        Spectator(str(server.gallery_address), timeout=TIMEOUT) as spectator,
    ):
        assert spectator.scene.opponent == "aggressive"
        client.spawn(3)
        poses = spectator.poses()
        assert {next(poses).character for _ in range(8)} == {0, 1}
        assert isinstance(next(poses).health, float)
