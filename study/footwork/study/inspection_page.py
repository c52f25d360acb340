"""The page of ``footwork inspect --plots``: figures and pictures of a bundle or of motions, with what they show."""

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from footwork.errors import InputError
from footwork.study.web_page import web_page

PAGE = "index.html"
_CAPTIONS = {
    "transitions": "Each point is a way from one frame to another that the capture does not have; the strip on top "
    "tells what the frames show.",
    "ways": "How long the shortest way takes from each captured frame to each other one, transitions included.",
    "transition_times": "How those times are spread: the mean is what a character takes to do something else.",
    "label_times": "How soon one kind of motion leads to another, at best and from the average frame.",
    "maneuverability": "How soon each kind of motion can be begun while another is under way.",
    "tour": "One of the best ways through all labels, frame by frame, as it is before transitions are smoothed.",
    "values": "What the policy expects of each command by how far one has to turn for it: the higher, the sooner and "
    "the more smoothly it is obeyed.",
    "knee": "The knee of the ranked costs is what --threshold auto takes.",
}
_SHEET = "Left limbs are blue, right ones orange; bars under the feet tell contact, the strip below the label."
_TOLD = {
    "clips": "clips",
    "captured_frames": "captured frames",
    "frames": "frames",
    "seconds": "seconds",
    "nodes": "nodes",
    "edges": "edges",
    "transitions": "transitions",
    "threshold_at_knee": "threshold at the knee",
}


def inspection_page(
    folder: Path, title: str, report: Mapping[str, Any], pictures: Sequence[Path], attribution: Sequence[str]
) -> Path:
    """Write the page into the folder of the pictures.

    Args:
        folder: where the pictures are.
        title: of the page.
        report: the figures, as ``footwork inspect --json`` prints them.
        pictures: in their order.
        attribution: what must be told to whoever gets the motion.

    Raises:
        InputError: for a place that cannot be written.
    """
    # plots tell of the whole, and come before the sheets of single clips
    ordered = sorted(pictures, key=lambda picture: picture.suffix != ".svg")
    body = [f"<h1>{escape(title)}</h1>", _figures(report), *map(_picture, ordered), _foot(attribution)]
    path = folder / PAGE
    try:
        path.write_text(web_page(title, "\n".join(body)), encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", path) from None
    return path


def _figures(report: Mapping[str, Any]) -> str:
    told = [(words, report[name]) for name, words in _TOLD.items() if report.get(name) is not None]
    cells = "".join(f"<tr><td>{escape(words)}</td><td>{_shown(value)}</td></tr>" for words, value in told)
    return f"<table>{cells}</table>"


def _shown(value: float) -> str:
    return f"{value:,.2f}" if isinstance(value, float) else f"{value:,}"


def _picture(path: Path) -> str:
    caption = next((text for name, text in _CAPTIONS.items() if path.stem.startswith(name)), _SHEET)
    name = escape(path.name)
    picture = f'<a href="{name}"><img alt="{escape(path.stem)}" src="{name}"></a>'
    return f"<figure>{picture}<figcaption>{escape(caption)}</figcaption></figure>"


def _foot(attribution: Sequence[str]) -> str:
    thanks = "".join(f"<p>{escape(line)}</p>" for line in attribution)
    return f"<footer><p>Made by <code>footwork inspect --plots</code>.</p>{thanks}</footer>"
