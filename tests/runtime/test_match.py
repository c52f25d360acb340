"""Matches: the same seed gives the same bytes, what is counted happened, and fighters do as they are let."""

import math

import numpy as np
import pytest

from fighting_bundle import fighting_bundle, fighting_ground
from footwork.controllers.activity import ATTACK, EVADE
from footwork.controllers.attack import CLOSEST, best_attack
from footwork.controllers.evade import NO_THREAT, best_evade
from footwork.controllers.fighters import draw, new_fighters
from footwork.controllers.fighting_style import STYLES, FightingStyle, styles_for_kernels
from footwork.controllers.prediction import begin_paths, predict
from footwork.controllers.shadow import NEAREST, OVERREACH, PRESSING, RESTLESS, kept_distance, overreach, shadow_edge
from footwork.controllers.shadowing import TableShadowing
from footwork.controllers.strike_distance import strike_distance
from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.fighting_points import LIMBS, RADII, fighting_points
from footwork.motion.kinematics import forward
from footwork.motion.shadowing_table import ShadowingTable
from footwork.motion.shadowing_task import ShadowingTask
from footwork.runtime.bodies import push_apart
from footwork.runtime.match import LONGEST_PLAY, Match
from footwork.runtime.match_rules import MatchRules, rules_in
from footwork.runtime.tally import EVENTS

EXACT = FightingStyle(variety=0.0, roam=0.0)
PAIR = [STYLES["aggressive"], STYLES["evasive"]]


def match(seed=1, styles=PAIR, **options):
    return Match(fighting_ground(), styles, seed, **options)


@pytest.fixture(scope="module")
def played():
    bout = match(rules=MatchRules(round_seconds=20.0))
    return bout, bout.play(3000, shown=True)


def events(bout, kind):
    rows = bout.track.event[: bout.track.events[0]]
    return rows[rows[:, 1] == EVENTS.index(kind)]


def test_the_same_seed_gives_the_same_bytes_however_it_is_cut_into_calls(played):
    again = match(rules=MatchRules(round_seconds=20.0))
    poses = [again.play(ticks, shown=True) for ticks in (1, 999, 0, 2000)]
    assert again.digest() == played[0].digest()
    np.testing.assert_array_equal(np.concatenate(poses), played[1])
    other = match(seed=2, rules=MatchRules(round_seconds=20.0))
    other.play(3000)
    assert other.digest() != again.digest()


def test_poses_are_for_looking_only(played):
    unseen = match(rules=MatchRules(round_seconds=20.0))
    unseen.play(3000)
    assert unseen.digest() == played[0].digest()


def test_something_happens_and_it_is_counted(played):
    bout, counts = played[0], played[0].tally.of
    assert counts["attacks"].min() > 0
    assert counts["hits"].sum() > 0
    assert counts["evades"].sum() > 0
    assert (counts["shadow_ticks"] + counts["attack_ticks"] + counts["evade_ticks"] == 3000).all()
    for kind, name in (("attack", "attacks"), ("hit", "hits"), ("evade", "evades")):
        assert np.bincount(events(bout, kind)[:, 2], minlength=2).tolist() == counts[name].tolist()
    assert len(events(bout, "hit")) + len(events(bout, "miss")) == counts["strikes"].sum()
    assert len(events(bout, "round")) == bout.tally.clock["rounds"][0] >= 5


def test_a_hit_is_where_the_shown_limb_is_in_a_shown_target(played):
    bout, poses = played
    skeleton = fighting_bundle().graph.skeleton
    joints, offsets = fighting_points(skeleton)
    for tick, kind, who, limb, target in bout.track.event[: bout.track.events[0]]:
        if EVENTS[kind] not in ("hit", "miss"):
            continue
        pose = poses[tick].astype(np.float64)
        places, turns = forward(skeleton, pose[:, :3], pose[:, 3:].reshape(2, -1, 4))
        points = places[:, joints] + quaternion.rotate(turns[:, joints], offsets)
        away = np.linalg.norm(points[who, limb] - points[1 - who, len(LIMBS) :], axis=-1) - RADII
        assert target == away.argmin()
        assert (away.min() <= MatchRules().limb + 1e-6) == (EVENTS[kind] == "hit")


def test_bodies_keep_apart(played):
    place = played[0].track.place
    apart = np.hypot(*(place[:, 0, :2] - place[:, 1, :2]).T)
    assert apart.min() > 0.3
    assert (apart < MatchRules().apart - 0.05).mean() < 0.02


@pytest.mark.parametrize(("away", "push"), [(0.6, 0.0), (0.48, 0.01), (0.1, 0.04), (0.0, 0.04)])
def test_pushes_are_half_of_what_is_missing_and_bounded(away, push):
    there, pushes = np.array([[1.0, 2.0, 0.3], [1.0, 2.0 + away, 1.0]]), np.zeros((2, 2))
    push_apart(there, 0.5, 0.04, pushes)
    np.testing.assert_allclose(np.hypot(*pushes.T), push, atol=1e-12)
    np.testing.assert_allclose(pushes[0], -pushes[1])
    assert push == 0.0 or (pushes[1] - pushes[0]) @ (there[1, :2] - there[0, :2]) >= 0.0


def test_a_round_ends_with_its_time_and_both_begin_the_next_one_fresh():
    bout = match(rules=MatchRules(round_seconds=1.0))
    bout.play(30)
    assert bout.tally.clock["rounds"][0] == 1
    assert bout.health.tolist() == [1.0, 1.0]


def test_who_is_beaten_loses_the_round():
    bout = match(styles=[STYLES["aggressive"]] * 2, rules=MatchRules(damage=1.0, full_speed=0.5))
    while not len(events(bout, "hit")):
        bout.step()
    (hit,), (over,) = events(bout, "hit")[:1], events(bout, "round")
    assert over[2] == hit[2]
    assert bout.winner == hit[2]
    assert bout.tally.clock["rounds"][0] == 1


def decisions(bout, count):
    """Situations in which a fighter decides: who."""
    found = 0
    while found < count:
        for who in range(2):
            if bout.undecided(who):
                begin_paths(bout.fighters, bout.world.node, bout.world.place, bout.room.paths)
                found += 1
                yield who
        bout.step()


def test_the_attack_is_the_one_whose_strike_comes_nearest():
    bout = match(styles=[EXACT, EXACT])
    world, paths, styles = bout.minds.world, bout.room.paths, bout.minds.styles
    tried = 0
    for who in decisions(bout, 60):
        row = world.segments[world.nodes[bout.world.node[who]]["segment"]]["attack_row"]
        if row < 0:
            continue
        nearest = math.inf
        for column, goal in enumerate(world.attack_goals):
            ticks = int(world.attacks[row, column]["when"])
            if not 0 <= ticks <= styles[who]["horizon"]:
                continue
            alone = bout.fighters.copy()
            alone["activity"][who], alone["goal"][who] = ATTACK, goal
            begin_paths(alone, bout.world.node, bout.world.place, paths)
            for one in range(2):
                predict(world, int(alone["activity"][one]), ticks, paths, one)
            mine, theirs = tuple(paths.place[who, ticks]), tuple(paths.place[1 - who, ticks])
            if math.hypot(mine[0] - theirs[0], mine[1] - theirs[1]) < CLOSEST:
                continue
            away = strike_distance(world, paths.node[who, ticks], mine, paths.node[1 - who, ticks], theirs)[0]
            nearest = min(nearest, away)
        begin_paths(bout.fighters, bout.world.node, bout.world.place, paths)
        found, goal = best_attack(world, bout.fighters, styles, who, paths)
        assert found == pytest.approx(nearest, abs=1e-4)
        assert (goal < 0) == math.isinf(nearest)
        tried += goal >= 0
    assert tried > 10


def test_the_evasion_is_the_one_that_ends_furthest_away():
    bout = match(styles=[EXACT, EXACT])
    world, paths, styles = bout.minds.world, bout.room.paths, bout.minds.styles
    for who in decisions(bout, 20):
        row = world.segments[world.nodes[bout.world.node[who]]["segment"]]["evade_row"]
        if row < 0:
            continue
        most = 0.0
        for column, goal in enumerate(world.evade_goals):
            ticks = int(world.evades[row, column]["when"])
            if not 0 <= ticks <= 90:
                continue
            alone = bout.fighters.copy()
            alone["activity"][who], alone["goal"][who] = EVADE, goal
            begin_paths(alone, bout.world.node, bout.world.place, paths)
            for one in range(2):
                predict(world, int(alone["activity"][one]), ticks, paths, one)
            most = max(most, math.hypot(*(paths.place[0, ticks, :2] - paths.place[1, ticks, :2])))
        begin_paths(bout.fighters, bout.world.node, bout.world.place, paths)
        assert best_evade(world, bout.fighters, styles, who, paths, NO_THREAT)[0] == pytest.approx(most, abs=1e-4)


def test_shadowing_takes_the_hop_with_the_least_error_at_its_end():
    bout = match(styles=[EXACT, EXACT])
    minds, paths, graph = bout.minds, bout.room.paths, fighting_bundle().graph
    notes = fighting_bundle().annotation
    assert notes is not None
    for who in decisions(bout, 40):
        node = int(bout.world.node[who])
        if minds.shadowing.hops.row[notes.segment[node]] < 0:
            continue
        chosen = shadow_edge(minds.world, minds.shadowing, bout.fighters, minds.styles, who, paths)
        errors = {}
        for edge in range(graph.edge_start[node], graph.edge_start[node + 1]):
            there = notes.segment[graph.target[edge]]
            if notes.state[there] == 0:
                errors[edge] = error_after(bout, who, edge, int(notes.length[there]), paths)
        assert errors[chosen] == pytest.approx(min(errors.values()), abs=1e-9)


def test_a_table_is_shadowed_by_as_its_own_controller_does():
    bundle = fighting_bundle()
    notes = bundle.annotation
    assert notes is not None
    task = ShadowingTask(distance_bins=4, bearing_bins=8)
    values = np.random.default_rng(4).uniform(0.0, 9.0, (len(notes.of_state(0)), 4, 8)).astype(np.float32)
    table = TableShadowing(bundle.graph, notes, ShadowingTable(task, 0, values, 0.0, 1, True))
    bout = match(styles=[EXACT, EXACT], shadowing=table)
    minds, paths = bout.minds, bout.room.paths
    for who in decisions(bout, 30):
        segment, seen = int(notes.segment[bout.world.node[who]]), bout.relative(who)
        if minds.shadowing.hops.row[segment] >= 0:
            chosen = shadow_edge(minds.world, minds.shadowing, bout.fighters, minds.styles, who, paths)
            assert chosen == table.next_edge(segment, seen.x, seen.z)


def error_after(bout, who, edge, ticks, paths):
    """|d - 1.2| / 0.3 + |bearing| / 30 degrees once an edge and the segment after it are walked."""
    begin_paths(bout.fighters, bout.world.node, bout.world.place, paths)
    predict(bout.minds.world, int(bout.fighters["activity"][1 - who]), ticks, paths, 1 - who)
    graph = fighting_bundle().graph
    place, node = complex(*bout.world.place[who, :2]), int(graph.target[edge])
    yaw = bout.world.place[who, 2]
    for _ in range(ticks):
        x, z, turn = graph.displacement[edge].astype(float)
        place += complex(x * np.cos(yaw) + z * np.sin(yaw), z * np.cos(yaw) - x * np.sin(yaw))
        yaw, node = yaw + turn, int(graph.target[edge])
        edge = int(graph.edge_start[node])
    away = complex(*paths.place[1 - who, ticks, :2]) - place
    bearing = math.remainder(math.atan2(away.real, away.imag) - yaw, 2.0 * math.pi)
    return abs(abs(away) - 1.2) / 0.3 + abs(bearing) / math.radians(30.0)


def test_an_activity_that_is_chosen_holds_until_another_is():
    bout = match(styles=[EXACT, EXACT])
    bout.choose(0, activity="shadow")
    bout.choose(1, activity="shadow")
    bout.play(600)
    assert bout.tally.of["shadow_ticks"].tolist() == [600, 600]
    bout.choose(0, activity="evade")
    while bout.activity(0) != "evade":
        bout.step()
    bout.choose(0)
    bout.play(600)
    assert bout.tally.of["attacks"][0] + bout.tally.of["evades"][0] > 1


def test_a_segment_that_is_chosen_is_where_the_fighter_goes_once():
    bout = match(styles=[EXACT, EXACT])
    for who in range(2):
        bout.choose(who, activity="shadow")
    goal = int(bout.ground.world.attack_goals[2])
    bout.choose(0, activity="shadow", segment=goal)
    nodes = []
    for _ in range(120):
        bout.step()
        nodes.append(int(bout.world.node[0]))
    segments = bout.ground.world.nodes["segment"][nodes]
    assert goal in segments
    assert bout.tally.of["attacks"][0] == 1


def test_relative_places_are_as_seen_from_each():
    bout = match()
    bout.world.place[0] = 1.0, 2.0, math.pi / 2
    bout.world.place[1] = 4.0, 1.0, 0.0
    seen = bout.relative(0)
    assert (seen.x, seen.z) == pytest.approx((1.0, 3.0))
    assert seen.distance == pytest.approx(math.sqrt(10.0))
    assert seen.bearing == pytest.approx(math.atan2(1.0, 3.0))
    assert seen.facing == pytest.approx(-math.pi / 2)


def test_chance_is_even_and_each_fighters_own():
    fighters = new_fighters(3)
    drawn = np.array([[draw(fighters[who]) for _ in range(4000)] for who in range(2)])
    assert drawn.min() >= 0.0
    assert drawn.max() < 1.0
    assert abs(np.histogram(drawn, 10, (0.0, 1.0))[0] - 800).max() < 120
    assert abs(np.corrcoef(drawn)[0, 1]) < 0.05


def test_what_cannot_be_is_refused():
    bout = match()
    with pytest.raises(InputError, match="activity 'rest', expected shadow, attack, evade"):
        bout.choose(0, activity="rest")
    for segment in (-1, 10**6):
        with pytest.raises(InputError, match="segment"):
            bout.choose(0, segment=segment)
    with pytest.raises(InputError, match="fighter 2"):
        bout.choose(2)
    for ticks in (-1, LONGEST_PLAY + 1):
        with pytest.raises(InputError, match="ticks"):
            bout.play(ticks)
    with pytest.raises(InputError, match="3 styles"):
        match(styles=[EXACT] * 3)


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        ({"match": {"push": 9}}, "push is 9, expected a number from 0 to 3"),
        ({"match": {"gloves": 9}}, "unknown key 'gloves', expected round_seconds"),
        ({"match": 3}, "match is 3, expected a table"),
    ],
)
def test_rules_out_of_range_are_refused_with_their_range(values, problem):
    with pytest.raises(InputError, match=problem):
        rules_in(values, "fight.toml")


def test_the_longer_nothing_happens_the_nearer_a_fighter_comes_and_back_again():
    (style,) = styles_for_kernels([STYLES["patient"]])
    calm = RESTLESS + PRESSING * np.array([-0.1, 0.0, 0.5, 1.0, 1.5, 2.0, 3.0])
    far, near = style["distance"], NEAREST
    kept = [kept_distance(style, number) for number in calm]
    assert kept == pytest.approx([far, far, 0.5 * (far + near), near, 0.5 * (far + near), far, near])
    (close,) = styles_for_kernels([FightingStyle(distance=0.6)])
    assert kept_distance(close, RESTLESS + PRESSING) == 0.6, "who is nearer already does not back off"
    assert [overreach(number) for number in calm[:4]] == pytest.approx([0.0, 0.0, 0.5 * OVERREACH, OVERREACH])


def test_two_who_keep_their_distance_do_not_settle_down():
    bout = match(styles=[FightingStyle(roam=0.0, distance=1.5)] * 2)
    bout.play(3600)
    begun = np.concatenate([[0], np.sort(events(bout, "attack")[:, 0]), [3600]])
    assert np.diff(begun).max() < 25 * 30
