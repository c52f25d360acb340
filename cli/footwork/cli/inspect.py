"""``footwork inspect``: what is in a bundle, or in a folder of motions, in figures and pictures."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from footwork.cli.motions import AS_USUAL, EMBEDDED, Reading, load_motions
from footwork.cli.output import Report, emit, progress
from footwork.errors import InputError


def inspect(
    source: str,
    /,
    *,
    plots: Path | None = None,
    metric: str | None = None,
    reading: Reading = AS_USUAL,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Say what is in a bundle, or look at motions before a bundle is made of them.

    Example: footwork inspect walker.footwork --plots pictures

    Args:
        source: A bundle, a folder of BVH or ASF/AMC files, embedded:locomotion or embedded:fighting.
        plots: A folder to draw contact sheets and plots into, with a page that shows them all, index.html.
        metric: Look at motions through a metric (uniform, dynamics, torso or joints): its ranked costs and their knee,
            which --threshold auto of a build takes.
        reading: How a folder of capture is read.
        json: Print the report as one JSON object.
    """
    with progress() as report_progress:
        report_progress("reading", 0.0)
        motions = source.startswith(EMBEDDED) or Path(source).is_dir()
        if metric is not None and not motions:
            raise InputError("only motions can be looked at through a metric, expected a folder of them", source)
        if metric is not None:
            report = _inspect_metric(source, metric, plots, reading, report_progress)
        elif motions:
            report = _inspect_motions(source, plots, reading, report_progress)
        else:
            report = _inspect_bundle(Path(source), plots, report_progress)
        if plots is not None:
            from footwork.study.inspection_page import inspection_page

            pictures = [Path(picture) for picture in report["plots"]]
            page = inspection_page(plots, Path(source).name, report, pictures, report["attribution"])
            report |= {"page": str(page)}
    emit(report, json, source)


def _inspect_motions(source: str, plots: Path | None, reading: Reading, tell: Report) -> dict:
    from footwork.study.contact_sheet import contact_sheets
    from footwork.study.inspection import inspect_clips

    dataset = load_motions(source, reading)
    tell("drawing" if plots else "measuring", 0.5)
    pictures = contact_sheets(plots, list(dataset.clips)) if plots else []
    return inspect_clips(dataset.clips) | _about(dataset.attribution, pictures)


def _inspect_metric(source: str, metric: str, plots: Path | None, reading: Reading, tell: Report) -> dict:
    from footwork.motion.metrics import require_metric
    from footwork.study.metric_report import knee_plot, metric_report

    require_metric(metric, "--metric")
    dataset = load_motions(source, reading)
    tell("measuring", 0.5)
    report, knee = metric_report(dataset.clips, metric)
    pictures = []
    if plots:
        plots.mkdir(parents=True, exist_ok=True)
        pictures = [knee_plot(knee, metric, plots / f"knee_{metric}.svg")]
    return report | _about(dataset.attribution, pictures)


def _inspect_bundle(path: Path, plots: Path | None, tell: Report) -> dict:
    from footwork.motion.bundle import read_bundle
    from footwork.study.inspection import inspect_bundle
    from footwork.study.inspection_plots import inspection_plots

    bundle = read_bundle(path)
    tell("measuring", 0.1)
    report = inspect_bundle(bundle)
    tell("drawing", 0.5)
    pictures = inspection_plots(bundle, plots) if plots else []
    return report | _about(bundle.attribution, pictures)


def _about(attribution: Sequence[str], pictures: Sequence[Path]) -> dict:
    return {"attribution": list(attribution), "plots": [str(picture) for picture in pictures]}
