"""Plots take the reader's light or dark appearance, and the page of pictures shows and tells of all of them."""

import re

import pytest

from footwork.errors import InputError
from footwork.study.drawing import pyplot
from footwork.study.inspection_page import inspection_page
from footwork.study.plot_style import MARKER, PALETTE, add_legend, dress, inline_svg, save_svg, stylesheet

pytest.importorskip("matplotlib", reason="matplotlib is not installed")


def drawn():
    figure, axes = pyplot().subplots(figsize=(3, 2))
    axes.plot([0, 1], [1, 0], color=MARKER["well"], label="line")
    dress(axes, "title", caption="what it shows")
    add_legend(axes)
    return figure


def contrast(one: str, other: str) -> float:
    """Of two colours #rrggbb, as WCAG 2 defines it: from 1 to 21."""

    def luminance(colour: str) -> float:
        shares = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
        red, green, blue = (s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("ground", ["paper", "card"])
@pytest.mark.parametrize("appearance", [0, 1])
def test_text_and_lines_stand_out_on_both_grounds(ground, appearance):
    for name in ("ink", "faint", "standard", "well", "rival", "holds", "fails", "open", "failed"):
        assert contrast(PALETTE[name][appearance], PALETTE[ground][appearance]) > (4.5 if name == "ink" else 3.0), name


def test_a_file_brings_its_style_and_nothing_is_left_in_a_marker_colour(tmp_path):
    svg = save_svg(drawn(), tmp_path / "plot.svg").read_text()
    assert stylesheet() in svg
    assert "prefers-color-scheme: dark" in svg
    assert "var(--well)" in svg
    assert not re.search("|".join(MARKER.values()), svg)
    assert not list(tmp_path.glob("*.part"))


def test_in_a_page_it_is_as_wide_as_its_place():
    head = inline_svg(drawn()).partition(">")[0]
    assert "width" not in head
    assert "viewBox" in head


def test_a_place_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        save_svg(drawn(), tmp_path / "none" / "plot.svg")
    with pytest.raises(InputError, match="cannot be written"):
        inspection_page(tmp_path / "none", "b", {}, [], [])


def test_the_page_shows_every_picture_and_what_it_shows_plots_first(tmp_path):
    pictures = [tmp_path / name for name in ("walk.png", "ways.svg", "values_steering.svg")]
    report = {"nodes": 1234, "seconds": 0.5, "unknown": 1}
    page = inspection_page(tmp_path, "a <b>", report, pictures, ["nobody's & free"]).read_text()
    assert re.findall(r'<img alt="[^"]+" src="([^"]+)">', page) == ["ways.svg", "values_steering.svg", "walk.png"]
    assert page.count("<figcaption>") == 3
    assert "a &lt;b&gt;" in page
    assert "nobody&#x27;s &amp; free" in page
    assert "<td>1,234</td>" in page
