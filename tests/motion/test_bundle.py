import hashlib
import json
import re
from dataclasses import replace

import msgspec
import numpy as np
import pytest
from safetensors.numpy import load_file

from footwork.errors import InputError
from footwork.motion import tensor_file
from footwork.motion.bundle import VERSION, Bundle, decode_bundle, encode_bundle, read_bundle, sealed, write_bundle
from footwork.motion.coded_values import exact
from footwork.motion.graph import ARRAYS
from footwork.motion.player_model import PlayerModel, TraceFile
from footwork.motion.table import PolicyTable, shortlisted
from footwork.motion.task import SteeringTask
from motion_samples import ring_graph

TASK = SteeringTask(behaviours=("stop", "walk"))


def some_player() -> PlayerModel:
    change = np.random.default_rng(1).random((2, 2, TASK.heading_bins))
    files = (TraceFile("one.csv", "1" * 64), TraceFile("two.csv", "2" * 64))
    return PlayerModel(TASK.behaviours, change / change.sum(axis=(1, 2), keepdims=True), files)


def sample_bundle(nodes: int = 5, converged: bool = True) -> Bundle:
    values = np.random.default_rng(0).random((nodes, 2, TASK.heading_bins), np.float32)
    table = PolicyTable(TASK, exact(values), 1e-4, 400, converged, some_player())
    provenance = {"files": [{"name": "a.bvh", "sha256": "0" * 64}], "options": {"threshold": 0.1 + 0.2}}
    return Bundle(ring_graph(nodes), {"steering": table}, provenance, ("Motion by someone, CC BY 4.0",))


@pytest.fixture(scope="module")
def sample_bytes() -> bytes:
    return tensor_bytes(sample_bundle())


def tensor_bytes(bundle: Bundle) -> bytes:
    return encode_bundle(bundle)[0]


def forged(change) -> bytes:
    """The sample bundle with its JSON changed and sealed anew, as another program could write it."""
    bundle = sample_bundle()
    arrays, text, _ = tensor_file.unseal(tensor_bytes(bundle), "sample")
    about = msgspec.json.decode(text)
    change(about, arrays)
    return tensor_file.seal(arrays, about)[0]


def test_a_bundle_reads_as_it_was_written(tmp_path):
    bundle = sample_bundle()
    digest = write_bundle(tmp_path / "b.footwork", bundle)
    read = read_bundle(tmp_path / "b.footwork")
    assert read.digest == digest == sealed(bundle).digest
    assert read.provenance == bundle.provenance
    assert read.attribution == bundle.attribution
    assert read.table("steering").task == TASK
    np.testing.assert_array_equal(read.table("steering").values, bundle.table("steering").values)
    player = read.table("steering").player
    assert player is not None
    assert player.learned_from == some_player().learned_from
    np.testing.assert_array_equal(player.change, some_player().change)
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(read.graph, name), getattr(bundle.graph, name))
    for name in ("clips", "labels", "behaviours"):
        assert getattr(read.graph, name) == getattr(bundle.graph, name)
    assert read.graph.skeleton.names == bundle.graph.skeleton.names
    np.testing.assert_array_equal(read.graph.skeleton.offsets, bundle.graph.skeleton.offsets)


def test_a_policy_without_a_player_model_reads_as_one(tmp_path):
    bundle = sample_bundle()
    table = replace(bundle.table("steering"), player=None)
    write_bundle(tmp_path / "b.footwork", replace(bundle, tables={"steering": table}))
    assert read_bundle(tmp_path / "b.footwork").table("steering").player is None


def test_a_policy_in_sixteen_bits_reads_as_it_was_written(tmp_path):
    bundle = sample_bundle()
    table = bundle.table("steering").compact
    write_bundle(tmp_path / "b.footwork", replace(bundle, tables={"steering": table}))
    read = read_bundle(tmp_path / "b.footwork").table("steering")
    for mine, other in zip(read.coded, table.coded, strict=True):
        assert mine.dtype == other.dtype
        np.testing.assert_array_equal(mine, other)
    assert read.coded.codes.dtype == np.uint16
    np.testing.assert_allclose(read.values, bundle.table("steering").values, atol=1e-5)


def test_a_shortlist_reads_as_it_was_written_and_may_be_left_out(tmp_path):
    table = listed_table(np.zeros((5, 2, TASK.heading_bins), np.uint8))
    write_bundle(tmp_path / "b.footwork", replace(sample_bundle(), tables={"steering": table}))
    read = read_bundle(tmp_path / "b.footwork").table("steering")
    np.testing.assert_array_equal(read.shortlist, table.shortlist)
    assert read.nbytes == read.unlisted.nbytes + read.shortlist.nbytes
    assert read.unlisted.shortlist.shape == (5, 2, 0)


def listed_table(shortlist) -> PolicyTable:
    return replace(sample_bundle().table("steering"), shortlist=shortlist)


def test_a_shortlist_that_does_not_fit_is_refused():
    states = 5, 2, TASK.heading_bins
    with pytest.raises(InputError, match="the shortlist holds int32, expected one of uint8, uint16"):
        listed_table(np.zeros(states, np.int32))
    with pytest.raises(InputError, match="shortlist"):
        listed_table(np.zeros((5, 2, 3), np.uint8))
    beyond = listed_table(np.full(states, 1, np.uint8))  # a node of the ring has one edge
    with pytest.raises(InputError, match="its shortlist names actions that are not there"):
        replace(sample_bundle(), tables={"steering": beyond})


@pytest.mark.parametrize(("most", "kind", "kept"), [(255, np.uint8, 2), (256, np.uint16, 2), (65536, np.uint8, 0)])
def test_a_shortlist_takes_as_few_bits_as_hold_it(most, kind, kept):
    best = np.array([[[0, most]]], np.int32)
    assert shortlisted(best).dtype == kind
    np.testing.assert_array_equal(shortlisted(best), best[..., :kept])


def test_a_mapped_bundle_is_the_same_and_outlives_its_file(tmp_path):
    path = tmp_path / "b.footwork"
    digest = write_bundle(path, sample_bundle(5))
    mapped = read_bundle(path, mapped=True)
    write_bundle(path, sample_bundle(7))
    assert mapped.digest == digest
    assert encode_bundle(mapped)[1] == digest
    for name in ARRAYS:
        assert not getattr(mapped.graph, name).flags.owndata


def test_the_same_bundle_gives_the_same_bytes(sample_bytes):
    assert all(tensor_bytes(sample_bundle()) == sample_bytes for _ in range(3))


def test_arrays_are_read_only_views_of_the_file(sample_bytes):
    graph = decode_bundle(sample_bytes, "sample").graph
    for name in ARRAYS:
        array = getattr(graph, name)
        assert not array.flags.writeable
        assert not array.flags.owndata


def test_other_programs_read_the_arrays(tmp_path):
    write_bundle(tmp_path / "b.footwork", sample_bundle())
    arrays = load_file(tmp_path / "b.footwork")
    assert arrays["table.steering.codes"].shape == (5, 2, 36)


def test_every_changed_byte_is_noticed(sample_bytes):
    start = 8 + int.from_bytes(sample_bytes[:8], "little")
    places = np.unique(np.r_[np.arange(0, start, 3), np.linspace(start, len(sample_bytes) - 1, 400).astype(int)])
    for place in places:
        for mask in (1, 0x20, 0x80):
            changed = bytearray(sample_bytes)
            changed[place] ^= mask
            with pytest.raises(InputError, match=r"^sample.*: "):
                decode_bundle(bytes(changed), "sample")


def test_every_truncation_is_noticed(sample_bytes):
    lengths = np.unique(np.r_[np.arange(0, 300), np.linspace(300, len(sample_bytes) - 1, 400).astype(int)])
    for length in lengths:
        with pytest.raises(InputError, match="sample"):
            decode_bundle(sample_bytes[:length], "sample")
    with pytest.raises(InputError, match="damaged"):
        decode_bundle(sample_bytes + b"\0", "sample")


@pytest.mark.parametrize(
    "garbage", [b"", b"\xff" * 40, b"HIERARCHY ROOT hips", b"\x02\0\0\0\0\0\0\0{}", b"\x02" + b"\0" * 7 + b"[]"]
)
def test_other_files_are_refused(garbage):
    with pytest.raises(InputError):
        decode_bundle(garbage, "sample")


def test_a_newer_version_says_so():
    def newer(about, arrays):
        about["version"] = VERSION + 1
        about["joints"] = "no longer a list"

    with pytest.raises(InputError, match=f"newer version {VERSION + 1}, expected version {VERSION}"):
        decode_bundle(forged(newer), "sample")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda about, arrays: arrays.pop("graph.target"), "no array 'graph.target'"),
        (lambda about, arrays: arrays.update({"graph.target": np.full(5, 99, np.int32)}), "target holds 99"),
        (lambda about, arrays: arrays.update({"graph.cost": np.full(5, np.nan, np.float32)}), "cost.*nan"),
        (lambda about, arrays: arrays.update({"graph.cost": np.zeros(4, np.float32)}), "cost has shape"),
        (lambda about, arrays: arrays.update({"table.steering.codes": np.zeros((4, 2, 36), np.float32)}), "low has"),
        (lambda about, arrays: about["tables"]["steering"].update(converged=False), "not converged"),
        (lambda about, arrays: about["tables"]["steering"]["task"].update(discount=1.0), "discount is 1"),
        (lambda about, arrays: about["tables"]["steering"]["task"].update(heading_bins="36"), "heading_bins"),
        (lambda about, arrays: about["tables"]["steering"]["task"].update(behaviours=["walk", "stop"]), "behaviours"),
        (lambda about, arrays: arrays.pop("player.steering"), "no array 'player.steering'"),
        (lambda about, arrays: arrays.update({"player.steering": np.ones((2, 2, 36))}), "player of table.*sum to 72"),
        (lambda about, arrays: arrays.update({"player.steering": np.full((2, 2, 9), 1 / 18)}), "9 heading bins"),
        (lambda about, arrays: about["tables"]["steering"].update(learned_from=[{"name": 1}]), "learned_from"),
        (lambda about, arrays: about["joints"].__setitem__(1, "hips"), "used twice"),
        (lambda about, arrays: about.pop("clips"), "clips"),
        (lambda about, arrays: arrays.update({"graph.target": np.full(5, 0.5, np.float32)}), "target' holds float32"),
        (lambda about, arrays: arrays.update({"skeleton.masses": np.ones(21, np.int32)}), "masses' holds int32"),
        (
            lambda about, arrays: arrays.update({"table.steering.codes": np.zeros((5, 2, 36))}),
            "expected float32 or uint16",
        ),
        (lambda about, arrays: arrays.update({"graph.rotations": np.zeros((5, 21, 4), np.float32)}), "of length 0"),
        (lambda about, arrays: arrays.update({"graph.cost": np.full(5, -1, np.float32)}), "cost holds -1"),
        (lambda about, arrays: arrays.update({"graph.smoothness": np.full(5, 1.1, np.float32)}), "expected 0 to 1"),
        (lambda about, arrays: about["labels"].clear(), "label holds 0 to 0"),
    ],
)
def test_parts_that_do_not_fit_are_refused(change, says):
    with pytest.raises(InputError, match=says):
        decode_bundle(forged(change), "sample")


def test_a_node_that_leads_nowhere_is_refused():
    def cut(about, arrays):
        starts = np.arange(6, dtype=np.int32)
        starts[3:] = [2, 4, 5]
        arrays["graph.edge_start"] = starts

    with pytest.raises(InputError, match="node 2 leads nowhere"):
        decode_bundle(forged(cut), "sample")


def test_an_offset_past_the_end_is_refused(sample_bytes):
    length = int.from_bytes(sample_bytes[:8], "little")
    header = json.loads(sample_bytes[8 : 8 + length])
    header["graph.cost"]["data_offsets"][1] += 10**9
    digest = json.loads(header["__metadata__"]["footwork"])["digest"]
    text = json.dumps(header).encode()
    data = len(text).to_bytes(8, "little") + text + sample_bytes[8 + length :]
    blank = data.replace(digest.encode(), b"0" * 64, 1)
    resealed = data.replace(digest.encode(), hashlib.sha256(blank).hexdigest().encode(), 1)
    with pytest.raises(InputError, match="does not fit"):
        decode_bundle(resealed, "sample")


def test_an_unconverged_table_is_never_written(tmp_path):
    with pytest.raises(InputError, match="not converged"):
        write_bundle(tmp_path / "b.footwork", sample_bundle(converged=False))
    assert list(tmp_path.iterdir()) == []


def test_provenance_that_is_no_json_is_never_written(tmp_path):
    bundle = sample_bundle()
    bad = Bundle(bundle.graph, bundle.tables, {"object": object()})
    with pytest.raises(InputError, match="JSON"):
        write_bundle(tmp_path / "b.footwork", bad)
    assert list(tmp_path.iterdir()) == []


def test_places_that_cannot_be_read_or_written(tmp_path):
    with pytest.raises(InputError, match=re.escape(str(tmp_path / "none"))):
        read_bundle(tmp_path / "none")
    with pytest.raises(InputError, match="not a regular file"):
        read_bundle(tmp_path)
    with pytest.raises(InputError, match="not a regular file"):
        read_bundle("/dev/zero")
    with pytest.raises(InputError, match="cannot be written"):
        write_bundle(tmp_path / "no" / "b.footwork", sample_bundle())


def test_writing_over_a_bundle_leaves_the_old_or_the_new(tmp_path):
    path = tmp_path / "b.footwork"
    write_bundle(path, sample_bundle(5))
    old, before = read_bundle(path), path.read_bytes()
    with path.open("rb") as still_open:
        write_bundle(path, sample_bundle(7))
        assert still_open.read() == before
    assert old.graph.node_count == 5
    assert old.graph.target[4] == 0
    assert read_bundle(path).graph.node_count == 7
    assert [entry.name for entry in tmp_path.iterdir()] == ["b.footwork"]
