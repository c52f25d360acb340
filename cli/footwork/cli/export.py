"""``footwork export``: motion for other tools."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from footwork.cli.output import emit, log
from footwork.cli.recorded_film import is_recording
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help loads no numerics
    from footwork.motion.bundle import Bundle
    from footwork.motion.glb_writer import Take

Off = Parameter(negative=())
_FORBIDDEN = '<>:"/\\|?*#'


def export(
    source: Path,
    /,
    *,
    out: Path,
    format: Literal["glb", "bvh"] | None = None,  # noqa: A002
    clip: tuple[str, ...] = (),
    path: tuple[str, str] | None = None,
    bundle: Path | None = None,
    fps: float | None = None,
    json: Annotated[bool, Off] = False,
) -> None:
    """Write motion for Blender, game engines and other tools.

    Of a bundle it is the clips that its frames come from, or with --path a walk through the graph as a character shows
    it; of a recording it is all characters, as they were shown.

    Example: footwork export walker.footwork --path idle run --out start.glb

    Args:
        source: A bundle, or a recording of `footwork serve --record` or `footwork fight --record`.
        out: The file to write, replaced only once the new one is whole; a folder for BVH files of several clips.
        format: glb, with a body to look at and an animation for each clip, or bvh; the ending of --out says where not
            given.
        clip: Name of a clip of the bundle; may be given several times. All of them where not given.
        path: From where to where a path goes: two nodes by number, labels or behaviours.
        bundle: The bundle that a recording was made with.
        fps: Frames a second; as they are where not given.
        json: Print what was written as one JSON object.
    """
    from footwork.motion.bundle import read_bundle

    kind = format or _ending(out)
    recorded = is_recording(source)
    _check_options(source, recorded, bundle, clip, path)
    made_of = read_bundle(bundle if recorded and bundle else source)
    takes = _recorded(source, made_of) if recorded else _of_bundle(made_of, clip, path)
    if fps is not None:
        takes = [_at_rate(take, fps) for take in takes]
    files = _write_glb(out, takes, made_of) if kind == "glb" else _write_bvh(out, takes)
    for line in made_of.attribution:
        log(f"whoever gets this must be told: {line}")
    emit({"files": files, "takes": [_told(take) for take in takes], "attribution": made_of.attribution}, json, str(out))


def _ending(out: Path) -> Literal["glb", "bvh"]:
    match out.suffix.lower():
        case ".glb":
            return "glb"
        case ".bvh":
            return "bvh"
        case other:
            raise InputError(f"ending {other!r} says no format, expected .glb or .bvh, or --format", "--out")


def _check_options(source: Path, recorded: bool, bundle: Path | None, clip: tuple[str, ...], path: object) -> None:
    if recorded and bundle is None:
        raise InputError("a recording holds no motion itself, expected the bundle that it was made with", "--bundle")
    if recorded and (clip or path):
        raise InputError("is for bundles, a recording is exported whole", "--clip" if clip else "--path")
    if not recorded and bundle is not None:
        raise InputError(f"is for recordings, and {source} is a bundle", "--bundle")
    if clip and path:
        raise InputError("expected one of --clip and --path", "--path")


def _recorded(source: Path, bundle: Bundle) -> list[Take]:
    from footwork.motion.glb_writer import Take
    from footwork.runtime.recording import read_recording
    from footwork.study.recorded_motion import recorded_motion

    return [Take(source.stem, recorded_motion(read_recording(source), bundle))]


def _of_bundle(bundle: Bundle, names: tuple[str, ...], path: tuple[str, str] | None) -> list[Take]:
    from footwork.motion.glb_writer import take_of
    from footwork.study.graph_clips import clip_of_graph
    from footwork.study.shown_path import shown_walk

    graph = bundle.graph
    if path is not None:
        return [take_of(shown_walk(graph, *path))]
    held = {graph.clips[number]: number for number in sorted(set(graph.clip[graph.original].tolist()))}
    for name in names:
        if name not in held:
            raise InputError(f"no clip {name!r}, it has {', '.join(held)}", "--clip")
    return [take_of(clip_of_graph(graph, held[name])) for name in names or held]


def _at_rate(take: Take, fps: float) -> Take:
    from footwork.motion.resample import resample

    return replace(take, parts=[replace(part, clip=resample(part.clip, fps)) for part in take.parts])


def _write_glb(out: Path, takes: list[Take], bundle: Bundle) -> list[str]:
    from footwork.motion.glb_writer import write_glb

    write_glb(out, takes, " ".join(bundle.attribution))
    return [str(out)]


def _write_bvh(out: Path, takes: list[Take]) -> list[str]:
    """One file for one clip; for several a folder, with files called by their clips."""
    from footwork.motion.bvh import write_bvh

    clips = [part.clip for take in takes for part in take.parts]
    files = [out] if len(clips) == 1 else [out / f"{_file_name(clip.name)}.bvh" for clip in clips]
    if len(set(files)) < len(files):
        raise InputError("two clips would get one file, expected --clip for each of them", "--out")
    if len(clips) > 1:
        if out.is_file():
            raise InputError(f"{len(clips)} clips need a folder, {out} is a file", "--out")
        out.mkdir(exist_ok=True)
    for file, clip in zip(files, clips, strict=True):
        write_bvh(file, clip)
    return [str(file) for file in files]


def _file_name(name: str) -> str:
    """A clip's name as the name of a file, without the ending of the file that it came from."""
    plain = "".join("_" if letter in _FORBIDDEN or not letter.isprintable() else letter for letter in name)
    return plain.removesuffix(".bvh").removesuffix(".amc").removesuffix(".glb").strip(". ") or "clip"


def _told(take: Take) -> dict[str, object]:
    clips = [part.clip for part in take.parts]
    seconds = max(part.start + part.clip.seconds for part in take.parts)
    return {"name": take.name, "characters": len(clips), "fps": clips[0].fps, "seconds": seconds}
