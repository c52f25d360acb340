"""State-annotated bundles: built from the embedded fighting motions, written, read, refused where they do not fit."""

import json
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest

from footwork.cli.motions import embedded_dataset
from footwork.errors import InputError
from footwork.motion import tensor_file
from footwork.motion.annotation import NO_WAY
from footwork.motion.bundle import decode_bundle, encode_bundle
from footwork.motion.state_machine import State, StateMachine, read_state_machine
from footwork.training import annotated_recipe
from footwork.training.build import build_bundle
from footwork.training.connectivity import largest_component
from footwork.training.graph_options import GraphOptions
from motion_samples import SampleMotions, sample_clip, sample_clips

FIGHTING = read_state_machine(Path(__file__).resolve().parents[2] / "examples" / "fighting.toml")
WITHOUT_SHADOWING = StateMachine(tuple(replace(state, shadowing=False) for state in FIGHTING.states), FIGHTING.where)
ANNOTATED = GraphOptions(graph="annotated")
SWAY = StateMachine((State("walk", ("walk",), ("walk", "run"), ("run",)), State("run", ("run",), ("walk",))))


@pytest.fixture(scope="module")
def built():
    return build_bundle(embedded_dataset("fighting"), ANNOTATED, machine=FIGHTING)


def test_every_strike_and_evasion_is_reached_from_all_footwork(built):
    bundle, report = built
    assert bundle.annotation is not None
    assert [pair["pairs_without_way"] for pair in report["at_once"]] == [0, 0]
    footwork = bundle.annotation.of_state(0)
    for pair in FIGHTING.at_once:
        for goal in bundle.annotation.of_state(pair[1]):
            edges = list(bundle.annotation.hops(bundle.graph, pair, int(footwork[0]), int(goal)))
            assert bundle.graph.target[edges[-1]] == bundle.annotation.first[goal]


def test_the_graph_and_its_footwork_can_be_walked_without_end(built):
    graph, notes = built[0].graph, built[0].annotation
    assert largest_component(graph.node_count, graph.source, graph.target).size == graph.node_count
    inside = (notes.state[notes.segment[graph.source]] == 0) & (notes.state[notes.segment[graph.target]] == 0)
    part = largest_component(graph.node_count, graph.source[inside], graph.target[inside])
    np.testing.assert_array_equal(part, np.flatnonzero(notes.state[notes.segment] == 0))


def test_its_behaviours_are_its_states(built):
    graph, notes, task = built[0].graph, built[0].annotation, built[0].table("steering").task
    assert graph.behaviours == task.behaviours == FIGHTING.names
    np.testing.assert_array_equal(graph.behaviour, notes.state[notes.segment])
    assert (task.facing, task.one_shot) == (("locomotion",), ("attack", "evade"))


def test_wind_ups_keep_their_label_in_the_state_of_the_strike(built):
    graph, notes = built[0].graph, built[0].annotation
    of_label = np.array(FIGHTING.states_of(graph.labels))[graph.label]
    other = of_label != notes.state[notes.segment]
    assert other.sum() == built[1]["wind_ups_and_recoveries"] > 0
    assert (of_label[other] == 0).all()


def test_the_report_tells_states_steps_and_delays(built):
    report = built[1]
    json.dumps(report, allow_nan=False)
    names = ["locomotion", "attack", "evade"]
    assert [state["state"] for state in report["states"]] == names
    assert sum(state["nodes"] for state in report["states"]) == report["scc_nodes"]
    assert sum(state["segments"] for state in report["states"]) == report["segments"]
    for step in report["steps"]:
        assert step["nodes"] == sum(step[name] for name in names)
    assert report["steps"][-1]["nodes"] == report["scc_nodes"]
    for pair in report["at_once"]:
        assert 0.0 <= pair["nearest_s"] <= pair["mean_s"] <= pair["longest_s"]
    assert {"states", "ways"} <= set(report["seconds"])
    assert report["policy"]["converged"]
    assert report["missing_behaviours"] == []


def test_the_state_that_says_so_gets_a_table_of_shadowing(built):
    bundle, report = built
    told = report["shadowing"]
    assert told["converged"]
    assert told["states"] == bundle.shadowing.values.size == 302 * 31 * 36
    assert told["bytes"] == bundle.shadowing.values.nbytes
    assert "shadowing" in report["seconds"]


def test_shadowing_needs_states(built):
    with pytest.raises(InputError, match="shadowing without states, expected an annotated graph"):
        replace(built[0], annotation=None)


def test_the_report_means_what_the_tables_hold(built):
    notes, report = built[0].annotation, built[1]
    own = notes.state[notes.between((0, 2))] == 0
    delay = notes.ways[1].delay[own]
    assert report["at_once"][1]["mean_s"] == pytest.approx(delay.mean() / 30)
    assert report["at_once"][1]["nearest_s"] == pytest.approx(delay.min(axis=1).mean() / 30)
    waits = [
        left + nearest
        for nearest, length in zip(delay.min(axis=1), notes.length[notes.of_state(0)], strict=True)
        for left in range(1, length + 1)
    ]
    assert report["at_once"][1]["from_frames_s"] == pytest.approx(np.mean(waits) / 30)


def test_an_annotated_bundle_reads_as_it_was_written_and_comes_out_the_same_again(built):
    bundle = built[0]
    data, digest = encode_bundle(bundle)
    read = decode_bundle(data, "fight")
    assert read.annotation is not None
    assert read.shadowing is not None
    assert bundle.shadowing is not None
    np.testing.assert_array_equal(read.shadowing.values, bundle.shadowing.values)
    assert (read.shadowing.task, read.shadowing.state) == (bundle.shadowing.task, 0)
    assert (read.digest, digest) == (bundle.digest, bundle.digest)
    assert read.annotation.machine.states == FIGHTING.states
    for mine, other in zip(read.annotation.ways, bundle.annotation.ways, strict=True):
        np.testing.assert_array_equal(mine.edge, other.edge)
        np.testing.assert_array_equal(mine.delay, other.delay)
    again, _ = build_bundle(embedded_dataset("fighting"), ANNOTATED, machine=FIGHTING)
    assert again.digest == digest


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda about, arrays: about.update(states=[]), "machine: 0 states"),
        (lambda about, arrays: about.update(states=[{"name": 1}]), "states"),
        (lambda about, arrays: about["states"][1].update(to=["nowhere"]), "states.attack: leads to 'nowhere'"),
        (lambda about, arrays: about["states"][0].update(at_once=["evade", "attack", "locomotion"]), "ways.2.edge"),
        (lambda about, arrays: about["states"][1].update(to=["evade"]), "may not follow"),
        (lambda about, arrays: arrays.pop("segments.first"), "no array 'segments.first'"),
        (lambda about, arrays: arrays.update({"segments.first": arrays["segments.first"][:-1]}), "state has shape"),
        (lambda about, arrays: bump(arrays, "segments.first", -1, 1), "the graph has"),
        (lambda about, arrays: bump(arrays, "segments.first", 1, -5), "does not cut the nodes"),
        (lambda about, arrays: bump(arrays, "segments.first", 0, 1), "does not cut the nodes"),
        (lambda about, arrays: bump(arrays, "segments.state", 0, 3), "state holds 0 to 3"),
        (lambda about, arrays: bump(arrays, "ways.0.delay", (0, 0), 1), "not lead where they say"),
        (lambda about, arrays: bump(arrays, "ways.1.edge", (5, 1), 1), "not lead where they say"),
        (lambda about, arrays: bump(arrays, "ways.1.edge", (0, 0), 1 << 30), "edge of ways holds"),
        (lambda about, arrays: arrays.update({"ways.0.edge": np.zeros((2, 2), np.int32)}), "edge of ways has shape"),
        (lambda about, arrays: arrays.update({"ways.0.delay": np.zeros((2, 2), np.int16)}), "holds int16"),
        (lambda about, arrays: arrays.pop("shadowing.values"), r"no array 'shadowing\.values'"),
        (lambda about, arrays: bump(arrays, "shadowing.values", (3, 1, 2), np.nan), "is nan, expected a finite"),
        (lambda about, arrays: about["shadowing"].update(converged=False), "shadowing: not converged: residual"),
        (lambda about, arrays: about["shadowing"].update(state=1), r"values of \d+ segments, 'attack' has"),
        (lambda about, arrays: about["shadowing"].update(state=3), "shadowing: state holds 3 to 3"),
        (lambda about, arrays: about["shadowing"]["task"].update(distance=-1.0), r"distance is -1\.0, expected a pos"),
        (lambda about, arrays: about["shadowing"]["task"].update(bearing_bins=18), "values has shape"),
    ],
)
def test_annotations_that_do_not_fit_are_refused(built, change, says):
    arrays, text, _ = tensor_file.unseal(encode_bundle(built[0])[0], "sample")
    about = msgspec.json.decode(text)
    change(about, arrays)
    with pytest.raises(InputError, match=says):
        decode_bundle(tensor_file.seal(arrays, about)[0], "sample")


def bump(arrays, name, place, by) -> None:
    arrays[name] = arrays[name].copy()
    arrays[name][place] += by


def test_segments_that_branch_inside_are_refused(built):
    notes = built[0].annotation
    last = notes.segment_count - 1  # an evasion without a neighbour of its state would do as well: any two in a row
    first, state = np.delete(notes.first, last), np.delete(notes.state, last)
    ways = [replace(hops, edge=hops.edge[:-1], delay=hops.delay[:-1]) for hops in notes.ways]
    assert notes.state[last] == notes.state[last - 1] == 0
    with pytest.raises(InputError, match=r"edge \d+ branches inside a segment"):
        replace(built[0], annotation=replace(notes, first=first, state=state, ways=ways))


def test_parts_of_a_file_that_are_not_known_are_passed_over(built):
    arrays, text, _ = tensor_file.unseal(encode_bundle(built[0])[0], "sample")
    about = msgspec.json.decode(text) | {"news": [1]}
    read = decode_bundle(tensor_file.seal(arrays | {"news.array": np.zeros(3)}, about)[0], "sample")
    assert read.annotation is not None


def test_a_machine_is_asked_for_where_there_is_one_alone():
    motions = SampleMotions(sample_clips(2, 60))
    with pytest.raises(InputError, match="--machine: an annotated graph needs a state machine"):
        build_bundle(motions, ANNOTATED)
    with pytest.raises(InputError, match="--machine: a standard graph has no states, expected it with --graph annot"):
        build_bundle(motions, GraphOptions(), machine=FIGHTING)
    with pytest.raises(InputError, match="--mu: an annotated graph has no such option"):
        GraphOptions(graph="annotated", mu=2.0)


def test_more_ways_than_memory_has_room_for_are_refused(built, monkeypatch):
    monkeypatch.setattr(annotated_recipe, "available_bytes", lambda: 32 * 100)
    graph, notes = built[0].graph, built[0].annotation
    with pytest.raises(InputError, match=r"states.locomotion: \d+ x \d+ ways to 'attack' at once, expected 100 at"):
        annotated_recipe.annotated(graph, FIGHTING, notes.state[notes.segment])


def test_motions_without_an_attack_are_refused_before_the_work_begins():
    told = []
    options = replace(ANNOTATED, threshold=1.0)
    with pytest.raises(InputError, match=r"states.locomotion: no frame shows it.*\(there are 'idle', 'walk'\)"):
        build_bundle(
            SampleMotions(sample_clips(2, 60)), options, machine=FIGHTING, progress=lambda *what: told.append(what)
        )
    assert told == []


def test_a_threshold_that_keeps_no_strike_names_one_that_does():
    motions = embedded_dataset("fighting")
    with pytest.raises(InputError, match=r"toml: states.\w+: no way .* a threshold of [\d.e-]+ would keep") as caught:
        build_bundle(motions, replace(ANNOTATED, threshold=1e-5), machine=WITHOUT_SHADOWING)
    needed = float(str(caught.value).split("a threshold of ")[1].split()[0])
    _, report = build_bundle(motions, replace(ANNOTATED, threshold=needed), machine=WITHOUT_SHADOWING)
    assert all(state["nodes"] for state in report["states"])


def labelled(clip, run):
    labels = np.full(clip.frame_count, "walk", dtype="<U4")
    labels[slice(*run)] = "run"
    return replace(clip, labels=labels)


def test_frames_of_no_state_are_counted_and_left_out_and_behaviours_get_a_policy():
    clips = [labelled(sample_clip(seed, 80), run=(30, 44)) for seed in range(3)]
    odd = replace(sample_clip(3, 60), labels=np.full(60, "duck"))
    bundle, report = build_bundle(SampleMotions([*clips, odd]), ANNOTATED, machine=SWAY)
    assert report["outside"] == {"duck": 60}
    assert "duck" not in {bundle.graph.labels[index] for index in np.unique(bundle.graph.label)}
    assert report["policy"]["converged"]
    assert bundle.annotation is not None
    assert bundle.annotation.ways[0].delay.min() > NO_WAY
