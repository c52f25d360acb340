import math

import numpy as np
import pytest

from footwork.controllers.controller import Situations
from footwork.errors import InputError
from footwork.motion.angle import wrapped
from footwork.motion.moves import LEAP, no_moves
from footwork.runtime.simulation import Simulation
from footwork.runtime.world import World
from footwork.study.motion_matching.chains import chains_of, graph_of_all_frames
from footwork.study.motion_matching.controller import MotionMatchingController
from footwork.study.motion_matching.forms import FORMS, motion_matching
from footwork.study.motion_matching.options import REFERENCE, STRONG
from footwork.training.embedded import embedded_clips
from toy_bundle import toy_bundle
from toy_graphs import wandering_clip

STOP, WALK, RUN, JUMP = range(4)
CLIPS = embedded_clips()
CONTROLLERS = {form: motion_matching(CLIPS, form) for form in FORMS}
both_forms = pytest.mark.parametrize("form", FORMS)


class Character:
    """One character in a world of its own; what it did at each tick."""

    def __init__(self, controller, slot=0):
        self.controller, self.world, self.moves = controller, World(controller.graph, 1), no_moves(1)
        self.slot = np.array([slot])
        self.world.spawn(controller.start_node(), 0.0, 0.0, 0.0)
        controller.begin(slot)
        self.nodes, self.places, self.edges, self.turns = [], [], [], []

    def go(self, behaviour, heading=0.0, ticks=1):
        for _ in range(ticks):
            wanted = np.array([heading]), np.array([behaviour], np.int32)
            self.controller.choose(Situations(self.slot, self.world.node, self.world.place, *wanted), self.moves)
            self.world.step(self.moves)
            self.nodes.append(int(self.world.node[0]))
            self.places.append(self.world.place[0].copy())
            self.edges.append(int(self.moves.edge[0]))
            self.turns.append(float(self.moves.adjustment[0, 2]))
        return self

    @property
    def shown(self):
        return self.controller.graph.behaviour[self.nodes]


def trail(character):
    return character.nodes, [place.tolist() for place in character.places]


@both_forms
def test_a_character_walks_where_it_is_told_to(form):
    character = Character(CONTROLLERS[form]).go(WALK, 1.2, 150)
    x, z, yaw = character.places[-1] - character.places[-60]
    assert math.atan2(x, z) == pytest.approx(1.2, abs=0.4)
    assert math.hypot(x, z) > 1.0
    assert abs(wrapped(character.places[-1][2] - 1.2)) < 0.4
    assert np.isfinite(yaw)


@both_forms
def test_it_turns_round_and_stops(form):
    character = Character(CONTROLLERS[form]).go(WALK, 0.0, 60).go(WALK, math.pi, 90)
    assert abs(wrapped(character.places[-1][2] - math.pi)) < 0.5
    character.go(STOP, math.pi, 90)
    assert math.hypot(*(character.places[-1] - character.places[-15])[:2]) < 0.15


def test_the_strong_form_shows_at_once_what_it_is_asked_for():
    character = Character(CONTROLLERS["strong"])
    for behaviour in (WALK, RUN, JUMP, STOP):
        character.go(behaviour, 0.3, 20)
        assert (character.shown[-20:] == behaviour).all()


def test_a_jump_is_answered_at_once_in_either_form():
    for controller in CONTROLLERS.values():
        assert (Character(controller).go(WALK, 0.0, 40).go(JUMP, 0.0, 10).shown[-10:] == JUMP).all()


def test_turns_of_the_strong_form_are_bounded():
    character = Character(CONTROLLERS["strong"]).go(RUN, 3.0, 60).go(WALK, -2.0, 60)
    assert 0.1 < np.abs(character.turns).max() <= math.radians(6.0) + 1e-12


def test_the_reference_keeps_a_character_near_its_simulated_root():
    character = Character(CONTROLLERS["reference"]).go(RUN, 0.0, 120)
    median = character.controller.data.speed[RUN]
    gone = character.places[-1][1] - character.places[59][1]
    assert gone == pytest.approx(median * 60 / 30.0, abs=0.4)


@both_forms
def test_leaps_leave_every_dead_end_and_nothing_else_leaves_the_graph(form):
    controller = CONTROLLERS[form]
    character = Character(controller)
    for ask in np.random.default_rng(1).integers(0, 4, 40):
        character.go(ask, float(ask), 12)
    edge = chains_of(controller.graph).edge
    followed = np.array(character.edges[1:])
    kept = followed != LEAP
    assert kept.any()
    assert not kept.all()
    np.testing.assert_array_equal(followed[kept], edge[character.nodes[:-1]][kept])


@both_forms
def test_the_same_asked_again_gives_the_same(form):
    first, again = (Character(CONTROLLERS[form]).go(RUN, 1.0, 80).go(STOP, 0.0, 40) for _ in range(2))
    assert trail(first) == trail(again)


@both_forms
def test_a_character_put_elsewhere_goes_on_as_it_would_have(form):
    here, there = (Character(CONTROLLERS[form], slot).go(WALK, 0.5, 40) for slot in range(2))
    x, z, yaw = there.places[-1]
    there.world.correct(0, x + 20.0, z - 5.0, yaw)
    assert here.go(WALK, 2.0, 40).nodes == there.go(WALK, 2.0, 40).nodes


@both_forms
def test_many_at_once_do_what_each_would_alone(form):
    controller, count, random = CONTROLLERS[form], 9, np.random.default_rng(4)
    heading = np.repeat(random.uniform(-3, 3, (8, count)), 12, axis=0)
    asked = np.repeat(random.integers(0, 4, (8, count)), 12, axis=0).astype(np.int32)
    world, moves = World(controller.graph, count), no_moves(count)
    for slot in range(count):
        world.spawn(controller.start_node(), 0.0, 0.0, 0.0)
        controller.begin(slot)
    together = []
    for tick in range(len(asked)):
        at = Situations(np.arange(count), world.node, world.place, heading[tick], asked[tick])
        controller.choose(at, moves)
        world.step(moves)
        together.append((world.node.copy(), world.place.copy()))
    for slot in range(count):
        alone = Character(controller, 20 + slot)
        for tick in range(len(asked)):
            alone.go(asked[tick, slot], heading[tick, slot])
        assert alone.nodes == [int(node[slot]) for node, _ in together]
        np.testing.assert_array_equal(alone.places, [place[slot] for _, place in together])


def test_it_drives_a_simulation_on_a_bundles_own_graph():
    bundle = toy_bundle()
    options = REFERENCE._replace(skipped_end=2, skipped_around=1)
    simulation = Simulation(bundle, 2, controller=MotionMatchingController(bundle.graph, options))
    slot = simulation.spawn(1.0, 2.0, 0.3)
    simulation.give(slot, simulation.vocabulary.outright(1.0, "walk"))
    for _ in range(90):
        simulation.step()
    assert np.isfinite(simulation.show(1.0).root[slot]).all()


def test_what_no_frame_shows_is_searched_for_among_all():
    graph = graph_of_all_frames([clip for clip in CLIPS if not (clip.labels == "jump").any()])
    assert len(Character(MotionMatchingController(graph, STRONG)).go(JUMP, 0.0, 40).nodes) == 40


def test_clips_too_short_to_search_and_unknown_names_are_refused():
    with pytest.raises(InputError, match="no stretch of frames longer than the 10 at its end"):
        motion_matching([wandering_clip(1, 9)], "reference")
    with pytest.raises(InputError, match="no form 'best' of motion matching, there are reference, strong"):
        motion_matching(CLIPS, "best")
    with pytest.raises(InputError, match="no behaviour 'fly', it has stop, walk, run, jump"):
        CONTROLLERS["reference"].start_node("fly")
