"""``footwork build``: motion capture to bundle."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from footwork.cli.motions import AS_USUAL, Reading, load_motions
from footwork.cli.output import emit, log, progress
from footwork.cli.traces import read_traces
from footwork.errors import InputError
from footwork.motion.state_machine import read_state_machine
from footwork.training.graph_options import GraphOptions, require_machine
from footwork.training.task_options import TaskOptions

if TYPE_CHECKING:  # at run time it is imported where it is needed, so that --help answers at once
    from footwork.training.dataset import Dataset

_AS_USUAL = GraphOptions()
_USUALLY_ASKED = TaskOptions()


def build(
    motions: str,
    /,
    *,
    out: Path,
    options: Annotated[GraphOptions, Parameter(name="*")] = _AS_USUAL,
    asked: Annotated[TaskOptions, Parameter(name="*")] = _USUALLY_ASKED,
    machine: Path | None = None,
    players: Path | None = None,
    strikes: Path | None = None,
    backend: str = "threads",
    scheduler: str | None = None,
    reading: Reading = AS_USUAL,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Make a bundle from motion capture: motion graph, policy table, provenance.

    Example: footwork build captures --labels labels.csv --threshold 1.0 --out walker.footwork

    Args:
        motions: A folder of BVH or ASF/AMC files, or embedded:locomotion or embedded:fighting.
        out: The bundle to write; an older one there is replaced only once the new one is whole.
        options: The kind of motion graph and how it is built.
        asked: What the policy is asked to do, and what it may do for it.
        machine: The states of an annotated graph and which may follow which (TOML).
        players: A trace (CSV), or a folder of them: players whose changes of mind the policy learns to expect; without
            any it expects none.
        strikes: Where attacks reach their target (CSV with clip, frame at 30 Hz, limb), in place of what is detected in
            the clips that it names.
        backend: Where the search for a well-connected graph's transitions runs: threads, or dask for a cluster.
        scheduler: Address of the Dask cluster's scheduler, such as tcp://127.0.0.1:8786.
        reading: How a folder of capture is read.
        json: Print the report as one JSON object.
    """
    from footwork.motion.bundle import write_bundle
    from footwork.training.backend import backend as running_on
    from footwork.training.build import build_bundle
    from footwork.training.strike_table import read_strikes
    from footwork.training.warm import start_warming

    _check_place(out)
    require_machine(options, machine is not None)
    states = read_state_machine(machine) if machine else None
    task = asked.task()
    recorded = read_traces(players) if players else []
    contacts = read_strikes(strikes) if strikes else []
    started = time.perf_counter()
    warming = start_warming(options)
    with running_on(backend, scheduler=scheduler), progress() as report_progress:
        report_progress("reading motions", 0.0)
        dataset = load_motions(motions, reading)
        _tell_unlabelled(dataset)
        _tell_never_standing(dataset)
        read = time.perf_counter() - started
        report_progress("compiling", 0.0)
        warming.join()
        compiled = time.perf_counter() - started - read
        bundle, report = build_bundle(
            dataset,
            options,
            task=task,
            machine=states,
            speed_levels=asked.speed_levels,
            players=recorded,
            strikes=contacts,
            progress=report_progress,
        )
        digest = write_bundle(out, bundle)
    if report["policy"] is None:
        log("no frame shows a behaviour that can be asked for, so there is no policy: see --labels")
    if outside := report.get("outside"):
        words = ", ".join(f"{label} {frames}" for label, frames in outside.items())
        log(f"{sum(outside.values())} frames show no state of {machine} and are left out: {words}")
    if warning := report.get("knee", {}).get("warning"):
        log(warning)
    seconds = report["seconds"] | {"read": read, "compile": compiled, "total": time.perf_counter() - started}
    emit(report | {"seconds": seconds, "digest": digest}, json, str(out))


def _check_place(out: Path) -> None:
    """Refuse at once what would otherwise be refused after minutes of work."""
    if not out.parent.is_dir():
        raise InputError(f"no folder {out.parent}, expected one that exists", "--out")
    if out.is_dir():
        raise InputError(f"{out} is a folder, expected a file to write", "--out")


def _tell_unlabelled(dataset: Dataset) -> None:
    """Say how much has no label: it shows no behaviour, so it may be a slip in the table of labels."""
    frames = sum(clip.frame_count for clip in dataset.clips)
    unlabelled = sum(int((clip.labels == "").sum()) for clip in dataset.clips)
    if unlabelled:
        log(f"{unlabelled} of {frames} frames have no label and so no behaviour that can be asked for")


def _tell_never_standing(dataset: Dataset) -> None:
    """Say which clips have no contacts: all of such a clip counts as one flight, so it may be a slip in its floor."""
    names = [clip.name for clip in dataset.clips if not clip.contacts.any()]
    if names:
        log(f"no foot ever stands in {', '.join(names[:5])}{', ...' * (len(names) > 5)} ({len(names)} clips)")
