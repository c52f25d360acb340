"""A real Dask cluster for tests: a scheduler and its workers as processes of this machine, and tasks for them."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

HERE = Path(__file__).parent
needs_dask = pytest.mark.skipif(
    find_spec("distributed") is None, reason="Dask is not installed (pip install 'footwork[scale]')"
)
PATIENCE = 60.0  # seconds in which something has to happen on a busy machine


@dataclass
class LocalCluster:
    """A scheduler that has written its address into a file, and workers of one thread each that have joined it."""

    folder: Path
    processes: list[subprocess.Popen[bytes]] = field(default_factory=list)

    @property
    def address(self) -> str:
        return str(json.loads((self.folder / "scheduler.json").read_text())["address"])

    def start_worker(self, path: Path = HERE) -> None:
        place = ("--scheduler-file", self.folder / "scheduler.json", "--local-directory", self.folder)
        self.start("worker", *place, "--nthreads", 1, "--no-nanny", "--death-timeout", 60, path=path)

    def start(self, what: str, *options: object, path: Path = HERE) -> None:
        command = [sys.executable, "-m", f"distributed.cli.dask_{what}", "--host", "127.0.0.1", "--no-dashboard"]
        log = (self.folder / f"{what}{len(self.processes)}.log").open("wb")
        process = subprocess.Popen([*command, *map(str, options)], env=environment(path), stdout=log, stderr=log)
        self.processes.append(process)

    def end(self) -> None:
        for process in self.processes:
            process.kill()
        for process in self.processes:
            process.wait()


def environment(path: Path = HERE) -> dict[str, str]:
    """Of a process that finds modules in a folder first."""
    return os.environ | {"PYTHONPATH": os.pathsep.join([str(path), os.environ.get("PYTHONPATH", "")])}


@contextmanager
def local_cluster(folder: Path, workers: int = 2, path: Path = HERE) -> Iterator[LocalCluster]:
    """A scheduler and workers on free ports, ended in any case; an orphaned scheduler ends by itself."""
    cluster = LocalCluster(folder)
    try:
        file = folder / "scheduler.json"
        cluster.start("scheduler", "--port", 0, "--scheduler-file", file, "--idle-timeout", 300, path=path)
        for _ in range(workers):
            cluster.start_worker()
        await_file(file)
        for log in folder.glob("worker*.log"):
            await_file(log, b"Registered to")
        yield cluster
    finally:
        cluster.end()


def await_file(path: Path, text: bytes = b"") -> None:
    """Wait until there is a file with something in it, or with a given text."""
    deadline = time.monotonic() + PATIENCE
    while not (path.exists() and path.stat().st_size and text in path.read_bytes()):
        assert time.monotonic() < deadline, f"{path} never came"
        time.sleep(0.01)


def scaled(task: int, array: np.ndarray, factor: np.ndarray) -> tuple[np.ndarray, int]:
    """A task: part of a shared array, scaled; and where it was done."""
    return array[task::7] * factor[task], os.getpid()


def announced(task: tuple[str, int], array: np.ndarray) -> np.ndarray:
    """A task that takes a while and leaves its process's number in a folder as soon as it has begun."""
    folder, number = task
    path = Path(folder) / str(number)
    path.with_suffix(".new").write_text(str(os.getpid()))
    path.with_suffix(".new").replace(path)
    time.sleep(0.1)
    return array[number::16] + number


class Grid(NamedTuple):
    """Arrays of many kinds that tasks share."""

    small: np.ndarray
    large: np.ndarray


def flags(task: int, grid: Grid, array: np.ndarray) -> list[tuple[bool, bool]]:
    """A task: whether each shared array is aligned and may be written to."""
    return [(bool(each.flags.aligned), bool(each.flags.writeable)) for each in (*grid, array)]


def refusing(task: int) -> int:
    if task == 3:
        raise ValueError("three is too many")
    return task


def deadly(task: int) -> int:
    """A task that takes its worker down with it."""
    os.kill(os.getpid(), signal.SIGKILL)
    return task
