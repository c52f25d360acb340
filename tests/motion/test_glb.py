"""GLB out and in: the same places of joints, checked by Khronos' validator where node has it; broken files refused."""

import json
import struct
import subprocess
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.body_mesh import body_mesh
from footwork.motion.clip import Clip
from footwork.motion.glb_reader import read_glb
from footwork.motion.glb_writer import Part, Take, take_of, write_glb
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.resample import resample
from footwork.motion.skeleton import Skeleton
from motion_samples import sample_clip
from node_tools import installed

CLIP = sample_clip(0, 40)
TOOLS = Path(__file__).parents[1] / "gltf_tools"


def places(clip: Clip, names: tuple[str, ...]) -> np.ndarray:
    return clip_places(clip)[0][:, clip.skeleton.indices(names)]


def assert_same(clip: Clip, other: Clip) -> None:
    names = clip.skeleton.names
    assert (other.fps, other.frame_count) == (clip.fps, clip.frame_count)
    np.testing.assert_allclose(places(other, names), places(clip, names), atol=1e-5)


def pieces(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def put(path: Path, document: dict[str, Any] | bytes, blob: bytes) -> Path:
    text = document if isinstance(document, bytes) else json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(blob), b"BIN\0") + blob
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    return path


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("glb") / "walk.glb"
    write_glb(path, [take_of(CLIP)], "Walked by Ann.")
    return path


def test_a_clip_comes_back_with_its_joints_where_they_were(written: Path):
    (back,) = read_glb(written)
    assert back.name == "walk.glb"
    assert back.translations is None
    assert_same(CLIP, back)


@pytest.mark.parametrize("fps", [24.0, 29.97, 30.0, 60.0, 120.0])
def test_any_rate_comes_back(tmp_path: Path, fps: float):
    clip = resample(CLIP, fps)
    write_glb(tmp_path / "a.glb", [take_of(clip)])
    (back,) = read_glb(tmp_path / "a.glb")
    assert back.fps == pytest.approx(fps, rel=1e-5)
    np.testing.assert_allclose(places(back, CLIP.skeleton.names), places(clip, CLIP.skeleton.names), atol=2e-5)


def test_joints_that_leave_their_offsets_come_back(tmp_path: Path):
    moved = np.repeat(CLIP.skeleton.offsets[None], CLIP.frame_count, axis=0)
    moved[:, 5] += np.sin(np.arange(CLIP.frame_count))[:, None] * 0.1
    clip = replace(CLIP, translations=moved)
    write_glb(tmp_path / "a.glb", [take_of(clip)])
    assert_same(clip, read_glb(tmp_path / "a.glb")[0])


def test_takes_and_bodies_come_back_under_their_names(tmp_path: Path):
    late = Take("duel", (Part("red", CLIP), Part("blue", sample_clip(1, 30), start=0.5)))
    write_glb(tmp_path / "a.glb", [late, Take("solo", (Part("red", sample_clip(2, 20)),))])
    back = {clip.name: clip for clip in read_glb(tmp_path / "a.glb")}
    assert list(back) == ["a.glb#duel#red", "a.glb#duel#blue", "a.glb#solo#red"]
    assert_same(sample_clip(1, 30), back["a.glb#duel#blue"])
    assert_same(sample_clip(2, 20), back["a.glb#solo#red"])
    document, _ = pieces(tmp_path / "a.glb")
    starts = {document["accessors"][s["input"]]["min"][0] for s in document["animations"][0]["samplers"]}
    assert starts == {0.0, 0.5}


@pytest.fixture(scope="module")
def duel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of two bodies, one of which comes late, and of two animations."""
    path = tmp_path_factory.mktemp("duel") / "duel.glb"
    late = Take("duel", (Part("red", CLIP), Part("blue", sample_clip(1, 30), start=0.5)))
    write_glb(path, [late, Take("solo", (Part("red", sample_clip(2, 1)),))])
    return path


@pytest.fixture(scope="module")
def tool(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., list[dict[str, Any]]]:
    """Runs a script of the tools; skips where there is no node."""
    node, folder = installed(TOOLS, tmp_path_factory.mktemp("tools") / "tools")

    def run(script: str, *files: Path) -> list[dict[str, Any]]:
        command = [*node, script, *map(str, files)]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=True)
        return [json.loads(line) for line in done.stdout.splitlines()]

    return run


def test_the_validator_of_the_format_has_nothing_to_say(written: Path, duel: Path, tool):
    reports = tool("validate.mjs", written, duel)
    assert [report["info"]["animationCount"] for report in reports] == [1, 2]
    for report in reports:
        assert (report["issues"]["messages"], report["issues"]["numInfos"], report["info"]["hasSkins"]) == ([], 0, True)


def test_another_importer_has_every_joint_where_it_was_in_every_frame(duel: Path, tool):
    shown = tool("places.mjs", duel)[0]
    assert shown["animation"] == "duel"
    np.testing.assert_allclose(shown["times"], np.arange(45) / 30, atol=1e-6)
    for body, (clip, start) in enumerate(((CLIP, 0), (sample_clip(1, 30), 15))):
        frames = np.array([bodies[body] for bodies in shown["frames"]])[start : start + clip.frame_count]
        np.testing.assert_allclose(frames, clip_places(clip)[0], atol=1e-4)


def test_the_file_says_whose_the_motion_is(written: Path):
    assert pieces(written)[0]["asset"]["copyright"] == "Walked by Ann."


def test_what_is_not_one_file_of_one_body_each_is_refused(tmp_path: Path):
    with pytest.raises(InputError, match="expected at least one take"):
        write_glb(tmp_path / "a.glb", [])
    taller = replace(CLIP.skeleton, offsets=CLIP.skeleton.offsets * 1.1)
    with pytest.raises(InputError, match="another skeleton than body"):
        write_glb(tmp_path / "a.glb", [Take("x", (Part("body", CLIP), Part("body", replace(CLIP, skeleton=taller))))])


def test_the_mesh_surrounds_its_bones_and_its_soles_touch_the_floor():
    body = default_body()
    mesh = body_mesh(body)
    corners = mesh.points[mesh.triangles]
    out = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    whole = np.linalg.norm(out, axis=1) > 1e-12
    assert (np.sum(out * mesh.normals[mesh.triangles].mean(axis=1), axis=1)[whole] > 0).all()
    rest = forward(body, np.zeros(3), np.tile(quaternion.IDENTITY, (body.joint_count, 1)))[0]
    lowest = (rest[mesh.joint] + mesh.points)[:, 1].min()
    assert lowest == pytest.approx(rest[:, 1].min() - 0.02, abs=2e-3)
    volume = np.sum(corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])) / 6.0
    assert 0.06 < volume < 0.12  # cubic metres: 75 kg, and what bones overlap at their joints


def test_a_body_whose_bones_have_rests_of_their_own_reads_the_same(written: Path, tmp_path: Path):
    """As other tools write it: every joint turned at rest, the whole in centimetres under a turned node."""
    document, blob = pieces(written)
    nodes, rng = document["nodes"], np.random.default_rng(3)
    joints = document["skins"][0]["joints"]
    parent = {child: number for number, node in enumerate(nodes) for child in node.get("children", [])}
    turn = dict(zip(joints, Rotation.from_rotvec(rng.normal(size=(len(joints), 3))), strict=True))
    top = Rotation.from_euler("x", -90, degrees=True)
    turn[parent[joints[0]]] = top
    nodes[parent[joints[0]]] |= {"rotation": top.as_quat().tolist(), "scale": [0.01] * 3}
    for joint in joints:
        up = turn[parent[joint]] if joint != joints[0] else top
        node = nodes[joint]
        node["translation"] = (100 * up.inv().apply(node["translation"])).tolist()
        node["rotation"] = (up.inv() * turn[joint]).as_quat().tolist()
    blob = bytearray(blob)
    animation = document["animations"][0]
    for channel in animation["channels"]:
        sampler, target = animation["samplers"][channel["sampler"]], channel["target"]
        view = document["bufferViews"][document["accessors"][sampler["output"]]["bufferView"]]
        start, end = view["byteOffset"], view["byteOffset"] + view["byteLength"]
        values = np.frombuffer(bytes(blob[start:end]), "<f4")
        up = turn[parent[target["node"]]]
        if target["path"] == "rotation":
            values = (up.inv() * Rotation.from_quat(values.reshape(-1, 4)) * turn[target["node"]]).as_quat()
        else:
            values = 100 * up.inv().apply(values.reshape(-1, 3))
        blob[start:end] = values.astype("<f4").tobytes()
    (back,) = read_glb(put(tmp_path / "other.glb", document, bytes(blob)))
    assert_same(CLIP, back)
    assert back.translations is None
    turns = back.rotations[:, back.skeleton.indices(CLIP.skeleton.names)]
    between = quaternion.multiply(turns, quaternion.conjugate(CLIP.rotations))
    assert np.abs(quaternion.to_rotation_vector(between)).max() < 1e-5
    np.testing.assert_allclose(
        back.skeleton.offsets[back.skeleton.indices(CLIP.skeleton.names)], CLIP.skeleton.offsets, atol=1e-6
    )


def hand_made(folder: Path, interpolation: str, values: Sequence[Sequence[float]]) -> Clip:
    """A node that an animation moves, without skin or mesh: keys at 0 and 1 s."""
    blob = np.array([0.0, 1.0], "<f4").tobytes() + np.array(values, "<f4").tobytes()
    views = [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteOffset": 8, "byteLength": len(blob) - 8}]
    document = {
        "asset": {"version": "2.0"},
        "nodes": [{"name": "a"}],
        "animations": [
            {
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                "samplers": [{"input": 0, "output": 1, "interpolation": interpolation}],
            }
        ],
        "accessors": [
            {"componentType": 5126, "count": 2, "type": "SCALAR", "bufferView": 0},
            {"componentType": 5126, "count": len(values), "type": "VEC3", "bufferView": 1},
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": len(blob)}],
    }
    (clip,) = read_glb(put(folder / "hand.glb", document, blob))
    return clip


def test_steps_lines_and_splines_are_evaluated_as_the_format_says(tmp_path: Path):
    line = hand_made(tmp_path, "LINEAR", [[0, 0, 0], [3, 0, 0]])
    assert (line.fps, line.frame_count) == (30.0, 31)
    np.testing.assert_allclose(line.root_position[:, 0], np.linspace(0, 3, 31), atol=1e-6)
    step = hand_made(tmp_path, "STEP", [[0, 0, 0], [3, 0, 0]])
    np.testing.assert_array_equal(step.root_position[:, 0], [0.0] * 30 + [3.0])
    zero = [0, 0, 0]
    spline = hand_made(tmp_path, "CUBICSPLINE", [zero, zero, [1, 0, 0], [2, 0, 0], [3, 0, 0], zero])
    t = np.arange(31) / 30
    want = 3 * (3 * t**2 - 2 * t**3) + (t**3 - 2 * t**2 + t) + 2 * (t**3 - t**2)
    np.testing.assert_allclose(spline.root_position[:, 0], want, atol=1e-5)


def cycle(document: dict[str, Any]) -> None:
    document["nodes"][3]["children"] = [1]


def set_(*path: Any, to: Any):
    def change(document: dict[str, Any]) -> None:
        inner: Any = document
        for key in path[:-1]:
            inner = inner[key]
        inner[path[-1]] = to

    return change


OUTPUT = ("animations", 0, "samplers", 3)
BAD = {
    "cycle": (set_("nodes", 3, "children", to=[1]), "two parents|cycle"),
    "child that is not there": (set_("nodes", 3, "children", to=[999]), "has child 999"),
    "its own child": (set_("nodes", 0, "children", to=[0]), "cycle"),
    "joint that is not there": (set_("skins", 0, "joints", to=[1, 999]), "not there"),
    "skin without joints": (set_("skins", 0, "joints", to=[]), "no joints"),
    "sampler that is not there": (set_("animations", 0, "channels", 0, "sampler", to=99), "sampler 99 of"),
    "accessor that is not there": (set_(*OUTPUT, "output", to=9999), "accessor 9999: needs item"),
    "huge count": (set_("accessors", 8, "count", to=2**31 - 1), "its view has"),
    "count over 2^31": (set_("accessors", 8, "count", to=2**40), "none of glTF"),
    "negative count": (set_("accessors", 8, "count", to=-1), "none of glTF"),
    "view past the end": (set_("bufferViews", 8, "byteOffset", to=2**30), "its view has 0"),
    "tiny stride": (set_("bufferViews", 8, "byteStride", to=4), "its view has"),
    "buffer elsewhere": (set_("buffers", 0, "uri", to="file:///etc/passwd"), "lies in another file"),
    "sparse": (set_("accessors", 8, "sparse", to={"count": 1}), "is sparse"),
    "wrong kind": (set_("accessors", 8, "type", to="VEC2"), "holds VEC2"),
    "plain integers": (set_("accessors", 8, "componentType", to=5123), "holds integers"),
    "unknown interpolation": (set_(*OUTPUT, "interpolation", to="MAGIC"), "'MAGIC', expected one of LINEAR"),
    "more values than times": (set_("accessors", 9, "count", to=20), "20 values for 40 times"),
    "no animation": (set_("animations", to=[]), "has no animation"),
    "name twice": (set_("nodes", 3, "name", to="hips"), "'hips' is used twice"),
    "endless name": (set_("nodes", 3, "name", to="x" * 9999), "none of glTF"),
    "too many nodes": (set_("nodes", to=[{}] * 30_000), "none of glTF"),
    "scale of nothing": (set_("nodes", 1, "scale", to=[0.0, 0.0, 0.0]), "its scale is 0"),
    "sheared": (set_("nodes", 0, "scale", to=[1.0, 5.0, 1.0]), "is sheared"),
    "mirrored": (set_("nodes", 0, "scale", to=[-1.0, 1.0, 1.0]), "is mirrored"),
    "place out of all bounds": (set_("nodes", 2, "translation", to=[1e300, 0.0, 0.0]), "not finite"),
    "rotation of no length": (set_("nodes", 0, "rotation", to=[0.0, 0.0, 0.0, 0.0]), "of no length"),
    "old version": (set_("asset", "version", to="1.0"), "expected 2.0"),
    "list for an object": (set_("nodes", to={}), "none of glTF"),
}


@pytest.mark.parametrize(("change", "said"), BAD.values(), ids=BAD.keys())
def test_a_broken_document_is_refused_with_its_place(written: Path, tmp_path: Path, change: Any, said: str):
    document, blob = pieces(written)
    change(document)
    with pytest.raises(InputError, match=said) as caught:
        read_glb(put(tmp_path / "bad.glb", document, blob))
    assert "bad.glb" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 500


def test_numbers_that_are_none_are_refused(written: Path, tmp_path: Path):
    document, blob = pieces(written)
    first = document["animations"][0]["samplers"][2]
    for accessor, bad, said in (
        (first["output"], float("nan"), "not finite"),
        (first["output"], float("inf"), "not finite"),
        (first["input"], 9.0, "do not rise"),
    ):
        start = document["bufferViews"][document["accessors"][accessor]["bufferView"]]["byteOffset"]
        changed = blob[:start] + struct.pack("<f", bad) + blob[start + 4 :]
        with pytest.raises(InputError, match=said):
            read_glb(put(tmp_path / "bad.glb", document, changed))


def test_an_hour_between_two_keys_is_no_hour_of_frames(tmp_path: Path):
    blob = np.array([0.0, 0.001, 1e8], "<f4").tobytes() + bytes(36)
    (tmp_path / "x").mkdir()
    hand_made(tmp_path / "x", "LINEAR", [[0, 0, 0]] * 2)
    document, _ = pieces(tmp_path / "x" / "hand.glb")
    document["accessors"][0]["count"] = document["accessors"][1]["count"] = 3
    document["bufferViews"] = [
        {"buffer": 0, "byteLength": 12},
        {"buffer": 0, "byteOffset": 12, "byteLength": 36},
    ]
    with pytest.raises(InputError, match="expected at most 1000000"):
        read_glb(put(tmp_path / "long.glb", document, blob))


def test_many_long_animations_of_the_same_few_bytes_are_refused(tmp_path: Path):
    hand_made(tmp_path, "LINEAR", [[0, 0, 0]] * 2)
    document, blob = pieces(tmp_path / "hand.glb")
    blob = np.array([0.0, 1000.0], "<f4").tobytes() + blob[8:]
    document["animations"] *= 1000
    with pytest.raises(InputError, match="frames of joints and more, expected at most 4000000"):
        read_glb(put(tmp_path / "many.glb", document, blob))


@pytest.mark.parametrize("text", [b"{", b"[" * 100_000, b"\xff\xfe", b"null", b'{"asset":{"version":2}}'])
def test_json_that_is_none_is_refused(tmp_path: Path, text: bytes):
    with pytest.raises(InputError, match="none of glTF"):
        read_glb(put(tmp_path / "bad.glb", text, b""))


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_a_damaged_file_is_read_or_refused_but_never_breaks(written: Path, tmp_path_factory, data: st.DataObject):
    whole = written.read_bytes()
    damaged = bytearray(whole[: data.draw(st.integers(0, len(whole)))])
    for _ in range(data.draw(st.integers(0, 4))):
        if damaged:
            damaged[data.draw(st.integers(0, min(len(damaged), 9000) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.getbasetemp() / "damaged.glb"
    path.write_bytes(bytes(damaged))
    with suppress(InputError):
        read_glb(path)


def test_skins_of_one_body_are_one_clip(written: Path, tmp_path: Path):
    document, blob = pieces(written)
    skin = document["skins"][0]
    names = [node.get("name") for node in document["nodes"]]
    document["skins"] = [skin | {"joints": [names.index("head")]}, skin | {"joints": skin["joints"][:6]}, skin]
    assert [clip.name for clip in read_glb(put(tmp_path / "dressed.glb", document, blob))] == ["dressed.glb"]


def test_a_body_of_one_joint_has_a_mesh(tmp_path: Path):
    ball = Skeleton(("ball",), np.array([-1]), np.zeros((1, 3)))
    rolling = Clip("roll", ball, 30.0, np.zeros((3, 3)), np.tile(quaternion.IDENTITY, (3, 1, 1)))
    write_glb(tmp_path / "ball.glb", [take_of(rolling)])
    assert read_glb(tmp_path / "ball.glb")[0].frame_count == 3
