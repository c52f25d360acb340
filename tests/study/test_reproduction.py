"""The reproduction of the papers: its rows, the page and the numbers it writes, and what it does with bad rows."""

import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.study.reproduction import registry, workbench, zhao_safonova
from footwork.study.reproduction.charts import STANDARD, Axis, Series, line_charts, matrix_panels
from footwork.study.reproduction.motion_sets import MotionSets
from footwork.study.reproduction.outcome import Outcome, Status
from footwork.study.reproduction.page import page_of, shown
from footwork.study.reproduction.row import Column, Figure, Result, Row, Table, Verdict, judged, unjudged
from footwork.study.reproduction.run import reproduce
from footwork.study.reproduction.trends import fitted, growth
from reproduction_motions import LAYOUT, write_motion_sets
from shared_data import MOTIONS, needs_motions

# a run of all rows compiles every kernel of the pipeline where they are not cached yet
pytestmark = pytest.mark.timeout(400)

EVERY_ROW = ["Z-T1", "Z-T2", "Z-F6", "Z-F7", "Z-T3", "Z-T4", "Z-R1", "Z-F8", "Z-T5", "Z-T6", "Z-B", "Z-F1,2", "Z-Q"]
ABOUT = {
    "version": "1",
    "command": "footwork reproduce",
    "complete": True,
    "seconds": 1.0,
    "cores": 2,
    "peak_rss_mb": 100.0,
    "attribution": ["thanks to <someone>"],
}


@pytest.fixture(autouse=True, scope="module")
def few_weights():
    """Interpolate at two weights rather than nine: seconds rather than minutes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workbench, "WEIGHTS", 2)
        yield


@pytest.fixture(scope="module")
def motions(tmp_path_factory):
    return write_motion_sets(tmp_path_factory.mktemp("motions"))


@pytest.fixture(scope="module")
def quick(motions, tmp_path_factory):
    out = tmp_path_factory.mktemp("out") / "deeper"
    return reproduce(motions, out, only=["Z"], quick=True), out


def row(run, name="X-1") -> Row:
    return Row(name, 1, zhao_safonova.PAPER, "Table 0", "A <row>", "It is & stays so.", {"a": 1}, run)


def with_rows(monkeypatch, *rows: Row) -> None:
    monkeypatch.setattr(registry, "all_rows", lambda: list(rows))


class _Balance(HTMLParser):
    """Notes tags that are closed in another order than they were opened."""

    VOID = ("meta", "img", "path", "use", "rect", "image", "br")

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.names: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.names += [value or "" for name, value in attrs if name == "id"]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open.pop() == tag

    def handle_startendtag(self, tag, attrs):
        self.names += [value or "" for name, value in attrs if name == "id"]


def test_every_row_of_the_paper_is_there_in_order():
    assert [row.name for row in registry.all_rows() if row.paper.letter == "Z"] == EVERY_ROW
    assert all(row.claim and row.title and row.place for row in registry.all_rows())


def test_rows_are_chosen_by_name_or_by_the_letter_of_a_paper():
    assert [row.name for row in registry.chosen_rows(["z-f6", "Z-T1"])] == ["Z-T1", "Z-F6"]
    assert [row.name for row in registry.chosen_rows(["Z"])] == EVERY_ROW
    with pytest.raises(InputError, match=r"--only: no row 'Z-T99', there are .*Z-T1.*Z \(all of it\)"):
        registry.chosen_rows(["Z-T99"])


def test_the_published_numbers_are_complete():
    thresholds = {"dataset1": 8, "dataset2": 8, "dataset3": 5}
    for name, kinds in zhao_safonova.CONNECTIVITY.items():
        assert all(len(shares) == thresholds[name] and sorted(shares) == list(shares) for shares in kinds.values())
        assert all(list(shares.values()) == sorted(shares.values()) for shares in kinds.values())
    assert len(zhao_safonova.SUBOPTIMALITY) == 12
    assert set(zhao_safonova.MANEUVERABILITY_NODES) == set(zhao_safonova.MANEUVERABILITY["MG"])
    gain = zhao_safonova.MANEUVERABILITY["MG"][0.8] / zhao_safonova.MANEUVERABILITY["wcMG"][0.8]
    assert gain == pytest.approx(zhao_safonova.MANEUVERABILITY_GAIN, abs=0.01)


def test_a_quick_run_makes_every_row_of_a_folder_of_ones_own(quick):
    report, _ = quick
    assert [made["name"] for made in report["rows"]] == EVERY_ROW
    assert report["complete"]
    assert [made["error"] for made in report["rows"]] == [None] * len(EVERY_ROW)
    sizes = next(made for made in report["rows"] if made["name"] == "Z-T1")["ours"]
    assert {name: one["frames"] for name, one in sizes.items()} == {
        name: sum(cores.values()) for name, cores in LAYOUT.items()
    }


def test_the_numbers_in_the_file_are_those_returned(quick):
    report, out = quick
    assert json.loads((out / "reproduction.json").read_text()) == report


def test_well_connected_graphs_connect_no_less_than_standard_ones(quick):
    shares = next(made for made in quick[0]["rows"] if made["name"] == "Z-T2")["ours"]
    for name in ("dataset1", "dataset2"):
        standard, well = shares[name]["MG"], shares[name]["wcMG"]
        assert all(well[threshold] >= standard[threshold] for threshold in standard)


def test_the_page_is_one_sound_file_that_needs_no_other(quick):
    page = (quick[1] / "index.html").read_text()
    check = _Balance()
    check.feed(page)
    assert not check.open
    assert len(check.names) == len(set(check.names))
    assert {made["name"] for made in quick[0]["rows"]} <= set(check.names)
    assert not re.search(r'(?:src|href)="(?!data:|#)', page)
    assert "prefers-color-scheme: dark" in page
    assert sorted(path.name for path in quick[1].iterdir()) == ["index.html", "reproduction.json"]


def test_what_the_page_shows_is_escaped():
    table = Table("a < b", [Column("n<"), Column("v", "m&m")], [["<td>", 1.0]])
    figure = Figure("c > d", 'say "x"', png=b"png")
    result = Result([judged("x < y", False, "since y > x")], [table], [figure], notes=["n & n"])
    page = page_of([Outcome(row(lambda bench: result), Status.DONE, result)], ABOUT)
    assert "<td>" in re.sub(r"<td[^>]*>", "<td>", page)
    for raw in ("A <row>", "x < y", "a < b", "&lt;td&gt;1", "thanks to <someone>"):
        assert raw not in page
    for escaped in ("A &lt;row&gt;", "x &lt; y", "m&amp;m", "&lt;td&gt;", "&quot;x&quot;", "n &amp; n"):
        assert escaped in page


@pytest.mark.parametrize(
    ("cell", "digits", "words"),
    [(None, 2, "–"), (1234, 2, "1,234"), (1234.567, 1, "1,234.6"), ("as it is", 2, "as it is")],
)
def test_cells_are_printed_for_people(cell, digits, words):
    assert shown(cell, digits) == words


def test_the_verdict_of_a_row_is_its_worst():
    holds, fails, is_open = judged("a", True, ""), judged("b", False, ""), unjudged("c", "")
    assert Outcome(row(None), result=Result([holds, fails, is_open])).verdict is Verdict.FAILS
    assert Outcome(row(None), result=Result([holds, is_open])).verdict is Verdict.OPEN
    assert Outcome(row(None), result=Result([holds])).verdict is Verdict.HOLDS
    assert Outcome(row(None)).verdict is None


def test_a_row_that_fails_says_so_and_the_others_go_on(motions, tmp_path, monkeypatch):
    def broken(bench):
        raise ZeroDivisionError("by nought")

    def refused(bench):
        return Result(notes=[str(bench.traces)])

    with_rows(monkeypatch, row(broken, "X-1"), row(refused, "X-2"), row(lambda bench: Result(), "X-3"))
    report = reproduce(motions, tmp_path)
    assert report["failed"] == ["X-1", "X-2"]
    assert [made["status"] for made in report["rows"]] == ["failed", "failed", "done"]
    assert report["rows"][0]["error"] == "ZeroDivisionError: by nought"
    assert "expected a folder of their traces" in report["rows"][1]["error"]
    assert "ZeroDivisionError: by nought" in (tmp_path / "index.html").read_text()


def test_an_interrupted_run_leaves_the_rows_that_it_had_finished(motions, tmp_path, monkeypatch):
    def interrupted(bench):
        raise KeyboardInterrupt

    done = row(lambda bench: Result(notes=["this one was made"]), "X-1")
    with_rows(monkeypatch, done, row(interrupted, "X-2"), row(lambda bench: Result(), "X-3"))
    with pytest.raises(KeyboardInterrupt):
        reproduce(motions, tmp_path)
    report = json.loads((tmp_path / "reproduction.json").read_text())
    assert not report["complete"]
    assert [made["status"] for made in report["rows"]] == ["done", "not reached", "not reached"]
    page = (tmp_path / "index.html").read_text()
    assert "this one was made" in page
    assert "This run is not complete" in page


def test_progress_rises_over_all_rows(motions, tmp_path, monkeypatch):
    def telling(bench):
        bench.tell("half of it", 0.5)
        return Result()

    told = []
    with_rows(monkeypatch, row(telling, "X-1"), row(telling, "X-2"))
    reproduce(motions, tmp_path, progress=lambda what, share: told.append((what, share)))
    assert told == [("X-1", 0.0), ("half of it", 0.25), ("X-2", 0.5), ("half of it", 0.75)]


def test_motions_that_lack_a_set_or_a_table_are_refused(motions, tmp_path):
    (tmp_path / "dataset1").mkdir()
    (tmp_path / "labels.csv").write_text("set,file,start_frame,end_frame,label\n")
    with pytest.raises(InputError, match=r"has no dataset2, dataset3, core_ranges.csv, expected the folders dataset1,"):
        MotionSets(tmp_path)
    with pytest.raises(InputError, match="has no dataset1"):
        MotionSets(tmp_path / "nowhere")
    assert MotionSets(motions).labels.is_file()


def test_a_folder_that_cannot_be_written_is_refused_before_any_work(motions, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="expected a folder to write into"):
        reproduce(motions, tmp_path / "file")


def test_charts_take_the_colours_of_the_page_and_draw_the_same_twice():
    series = [Series("a", [1, 2, 3], [1.0, None, 9.0], STANDARD)]
    charts = [line_charts([("title", series, Axis("x", log=True, ticks=(1, 3)), Axis("y"))]) for _ in range(2)]
    assert charts[0] == charts[1]
    assert charts[0].startswith("<svg")
    assert "var(--standard)" in charts[0]
    assert not re.search(r"#0[0-9]0[0-9]0[0-9]", charts[0])
    assert matrix_panels([("m", np.eye(3))], 2, "x", "y").count("data:image/png") == 1


def test_trends_find_lines_and_powers():
    x = np.array([1.0, 2.0, 4.0, 8.0])
    line = fitted(x, 3.0 * x - 1.0)
    assert (line.slope, line.offset, line.r2) == pytest.approx((3.0, -1.0, 1.0))
    assert fitted(x, [1.0, -1.0, 1.0, -1.0]).r2 < 0.5
    assert growth(x, 7.0 * x**2) == pytest.approx(2.0)


@needs_motions
def test_real_walkers_connect_more_when_well_connected(tmp_path):
    report = reproduce(MOTIONS, tmp_path, only=["Z-T1", "Z-T2"], quick=True)
    sizes, connectivity = report["rows"]
    assert sizes["verdict"] == "holds"
    assert connectivity["ours"]["dataset1"]["wcMG"]["0.2"] > 2 * connectivity["ours"]["dataset1"]["MG"]["0.2"] > 0
    assert len(report["attribution"]) == 2
