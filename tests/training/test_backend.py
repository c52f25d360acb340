"""Tasks give the same results wherever they run, and a cluster that goes wrong is one error in bounded time."""

import os
import signal
import socket
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from threading import Thread

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.training.backend import backend, run_tasks
from local_cluster import (
    Grid,
    LocalCluster,
    announced,
    await_file,
    deadly,
    environment,
    flags,
    local_cluster,
    needs_dask,
    refusing,
    scaled,
)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    with local_cluster(tmp_path_factory.mktemp("cluster")) as started:
        yield started


@pytest.fixture
def hasty(monkeypatch):
    """Give clusters up after a second or two rather than ten."""
    from footwork.training import dask_client, dask_cluster

    monkeypatch.setattr(dask_client, "ANSWER", 2.0)
    monkeypatch.setattr(dask_cluster, "WORKERS", 1.0)


def arrays() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(5)
    return rng.normal(size=(400_000, 2)), rng.normal(size=7)


def test_results_come_in_the_order_of_the_tasks_and_progress_reaches_the_whole():
    array, factor = arrays()
    shares: list[float] = []
    results = run_tasks(scaled, (array, factor), [5, 0, 3], shares.append)
    assert [pid for _, pid in results] == [os.getpid()] * 3
    for task, (part, _) in zip([5, 0, 3], results, strict=True):
        np.testing.assert_array_equal(part, array[task::7] * factor[task])
    assert shares == pytest.approx([1 / 3, 2 / 3, 1.0])


def test_no_tasks_give_no_results():
    assert run_tasks(scaled, arrays(), []) == []


def test_errors_of_a_task_come_through():
    with pytest.raises(ValueError, match="three is too many"):
        run_tasks(refusing, (), range(8))


@needs_dask
def test_a_cluster_gives_the_very_results_of_this_process(cluster):
    array, factor = arrays()
    here = run_tasks(scaled, (array, factor), range(7))
    shares: list[float] = []
    with backend("dask", scheduler=cluster.address):
        there = run_tasks(scaled, (array, factor), range(7), shares.append)
    for (mine, _), (theirs, _) in zip(here, there, strict=True):
        np.testing.assert_array_equal(mine, theirs)
    assert os.getpid() not in {pid for _, pid in there}
    assert len(shares) == 7
    assert shares[-1] == 1.0
    assert [pid for _, pid in run_tasks(scaled, (array, factor), range(7))] == [os.getpid()] * 7


@needs_dask
def test_shared_arrays_arrive_as_compiled_code_knows_them(cluster):
    """Aligned, and writable or not as they were: Numba compiles anew for every other kind."""
    frozen = np.arange(300_001.0)
    frozen.flags.writeable = False
    shared = (Grid(np.arange(7, dtype=np.int8), frozen), np.arange(500_003.0)[1:])
    with backend("dask", scheduler=cluster.address):
        assert run_tasks(flags, shared, [0]) == [flags(0, *shared)] == [[(True, True), (True, False), (True, True)]]


@needs_dask
def test_errors_of_a_task_come_through_from_a_cluster_that_stays_ready(cluster):
    with backend("dask", scheduler=cluster.address):
        with pytest.raises(ValueError, match="three is too many"):
            run_tasks(refusing, (), range(8))
        assert run_tasks(refusing, (), [0, 1]) == [0, 1]


@needs_dask
def test_workers_that_are_killed_in_the_middle_change_nothing(tmp_path):
    """First one of two, later the other, with which all shared data goes, and a third that comes instead."""
    array = arrays()[0]
    begun = tmp_path / "begun"
    begun.mkdir()
    killed: list[int] = []

    def strike() -> None:
        killed.append(kill_worker_of(begun / "3", own))
        await_file(begun / "9")
        killed.append(kill_worker_of(begun / "9", own))
        own.start_worker()

    with local_cluster(tmp_path) as own, backend("dask", scheduler=own.address):
        assassin = Thread(target=strike, daemon=True)
        assassin.start()
        results = run_tasks(announced, (array,), [(str(begun), number) for number in range(16)])
        assassin.join()
    assert len(set(killed)) == 2
    for number, result in enumerate(results):
        np.testing.assert_array_equal(result, array[number::16] + number)


def kill_worker_of(begun: Path, cluster: LocalCluster) -> int:
    """Kill the worker that runs a task as soon as it has begun."""
    await_file(begun)
    pid = int(begun.read_text())
    [worker] = [process for process in cluster.processes if process.pid == pid]
    worker.kill()
    worker.wait()
    return pid


@needs_dask
@pytest.mark.usefixtures("hasty")
def test_a_scheduler_that_is_lost_on_the_way_is_one_error(tmp_path):
    """One that hangs, and one that is gone."""
    with local_cluster(tmp_path, workers=1) as own:
        for blow in (signal.SIGSTOP, signal.SIGKILL):
            begun = tmp_path / str(blow)
            begun.mkdir()
            Thread(target=strike_scheduler, args=(own, blow, begun / "1"), daemon=True).start()
            with pytest.raises(InputError, match=r"tcp://127.*: the scheduler does not answer any more"):
                in_the_cluster(own.address, announced, arrays()[:1], [(str(begun), number) for number in range(200)])
            own.processes[0].send_signal(signal.SIGCONT)


def strike_scheduler(cluster: LocalCluster, blow: int, begun: Path) -> None:
    await_file(begun)
    cluster.processes[0].send_signal(blow)


def in_the_cluster(address: str, function, shared, tasks) -> list:
    with backend("dask", scheduler=address):
        return run_tasks(function, shared, tasks)


@needs_dask
@pytest.mark.usefixtures("hasty")
def test_workers_that_never_come_are_one_error(tmp_path):
    message = r"tcp://127.*: the scheduler has no workers, expected one at least: dask worker tcp://127"
    with local_cluster(tmp_path, workers=0) as own, pytest.raises(InputError, match=message):
        in_the_cluster(own.address, refusing, (), [0])


@needs_dask
@pytest.mark.usefixtures("hasty")
def test_a_task_that_takes_every_worker_down_is_one_error(tmp_path):
    with local_cluster(tmp_path, workers=1) as own, pytest.raises(InputError, match="the scheduler has no workers"):
        in_the_cluster(own.address, deadly, (), [0])


@needs_dask
def test_a_scheduler_or_a_worker_without_footwork_is_named(tmp_path):
    shadow = tmp_path / "shadow"
    (shadow / "footwork").mkdir(parents=True)
    (shadow / "footwork" / "__init__.py").touch()  # hides the real one
    message = r"tcp://127.*: the {} cannot load footwork.*pip install 'footwork\[scale\]'"
    with local_cluster(tmp_path, workers=1, path=shadow) as own:
        with pytest.raises(InputError, match=message.format("scheduler")):
            in_the_cluster(own.address, refusing, (), [0])
        own.start_worker(shadow)
        await_file(tmp_path / "worker2.log", b"Registered to")
        with pytest.raises(InputError, match=message.format("worker")):
            in_the_cluster(own.address, refusing, (), [0])


@needs_dask
def test_a_worker_with_another_library_is_named(cluster, monkeypatch):
    from footwork.training import dask_worker
    from footwork.training.fingerprint import fingerprint

    monkeypatch.setattr(dask_worker, "fingerprint", lambda: fingerprint() | {"numba": "0.1"})
    with pytest.raises(InputError, match=r"tcp://127.*: the worker has numba 0\.\d+.*expected the same .*numba 0\.1"):
        in_the_cluster(cluster.address, refusing, (), [0])


@needs_dask
@pytest.mark.usefixtures("hasty")
@pytest.mark.parametrize("greeting", [None, b"", b"HTTP/1.1 400 Bad Request\r\n\r\n", b"\xff" * 64])
def test_whatever_is_no_scheduler_is_one_error_in_bounded_time(greeting):
    """A peer that says nothing, one that hangs up, and two that say something else."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        Thread(target=greet, args=(server, greeting), daemon=True).start()
        started = time.monotonic()
        with pytest.raises(InputError, match=r"tcp://127.*: no Dask scheduler answers within 2 s"):
            in_the_cluster(f"tcp://127.0.0.1:{server.getsockname()[1]}", refusing, (), [0])
        assert time.monotonic() - started < 60.0


def greet(server: socket.socket, greeting: bytes | None) -> None:
    kept = []
    while True:
        try:
            peer = server.accept()[0]
        except OSError:
            return
        kept.append(peer)
        if greeting is not None:
            peer.sendall(greeting)
            peer.close()


@needs_dask
@pytest.mark.usefixtures("hasty")
def test_an_address_where_nobody_listens_is_one_error():
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
    with pytest.raises(InputError, match="no Dask scheduler answers"):
        in_the_cluster(address, refusing, (), [0])


@needs_dask
@pytest.mark.parametrize(
    "address",
    ["", "nonsense", "tcp://", "tcp://h", "tcp://h:0", "tcp://h:99999", "tcp://h:x", "http://h:80", "tcp://[::1"],
)
def test_an_address_that_is_none_says_what_one_looks_like(address):
    with pytest.raises(InputError, match=r"--scheduler: .* is no address, expected tcp://HOST:PORT"):
        in_the_cluster(address, refusing, (), [0])


def test_options_that_make_no_sense_are_refused():
    with (
        pytest.raises(InputError, match=r"--backend: 'grid' is no place to run, there is threads, dask"),
        backend("grid"),
    ):
        pass
    with pytest.raises(InputError, match=r"--scheduler: not given"), backend("dask"):
        pass
    with pytest.raises(InputError, match=r"--scheduler: threads of this process"), backend(scheduler="tcp://h:1"):
        pass


def test_without_dask_the_error_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    for name in ("dask_client", "dask_cluster"):
        monkeypatch.delitem(sys.modules, f"footwork.training.{name}", raising=False)
        monkeypatch.delattr(f"footwork.training.{name}", raising=False)
    with pytest.raises(InputError, match=r"--backend: Dask is not installed.*pip install 'footwork\[scale\]'"):
        in_the_cluster("tcp://127.0.0.1:8786", refusing, (), [0])


def test_nothing_of_dask_is_loaded_in_process():
    code = (
        "import sys; from local_cluster import refusing; from footwork.training.backend import run_tasks;"
        "run_tasks(refusing, (), [0, 1]); sys.exit(bool({'dask', 'distributed'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], env=environment(), check=False).returncode == 0


@needs_dask
def test_an_interrupt_takes_back_what_the_cluster_has_not_begun(cluster, tmp_path):
    code = (
        "import sys; from local_cluster import announced; from footwork.training.backend import backend, run_tasks;"
        "import numpy; folder, address = sys.argv[1:];\n"
        "with backend('dask', scheduler=address):\n"
        "    run_tasks(announced, (numpy.zeros(64),), [(folder, number) for number in range(400)])"
    )
    command = [sys.executable, "-c", code, str(tmp_path), cluster.address]
    # interruptible, though this may run behind a shell that has its children ignore interrupts
    heeding = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    with subprocess.Popen(command, env=environment(), stderr=subprocess.PIPE, preexec_fn=heeding) as process:
        await_file(tmp_path / "1")
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=100)[1].decode()
    assert said.splitlines()[-1] == "KeyboardInterrupt"
    begun, before = len(list(tmp_path.iterdir())), 0
    while begun > before:  # what was on its way still runs
        time.sleep(0.7)
        begun, before = len(list(tmp_path.iterdir())), begun
    assert begun < 300
