"""Where the tasks of a search run: on threads of this process, or on the workers of a Dask cluster."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from typing import Any, Protocol

from joblib import Parallel, delayed, parallel_config
from joblib.parallel import ParallelBackendBase

from footwork.errors import InputError
from footwork.motion.threads import THREADS

BACKENDS = ("threads", "dask")
_ROUNDS = 5  # how often tasks are sent again whose data went down with the workers that held them
_EXAMPLE = "tcp://127.0.0.1:8786"


class DataLostError(Exception):
    """Workers went down with data that nobody else holds: what is not finished has to be sent again."""


class Place(Protocol):
    """Somewhere that tasks can run."""

    @property
    def joblib_backend(self) -> str | ParallelBackendBase:
        """What joblib is to use."""
        ...

    def shared(self, arrays: Sequence[Any]) -> AbstractContextManager[Sequence[Any]]:
        """Bring arrays to where the tasks run; gives what stands for them among a task's arguments."""
        ...


class _Threads:
    """Threads of this process, which see the arrays as they are."""

    joblib_backend = "threading"

    def shared(self, arrays: Sequence[Any]) -> AbstractContextManager[Sequence[Any]]:
        return nullcontext(arrays)


_HERE = _Threads()
_place: ContextVar[Place] = ContextVar("place", default=_HERE)


@contextmanager
def backend(name: str = "threads", *, scheduler: str | None = None) -> Iterator[None]:
    """Within it, ``run_tasks`` runs its tasks in the named place; results never depend on which.

    Args:
        name: ``threads`` for this process, ``dask`` for the workers of a Dask cluster.
        scheduler: address of the cluster's scheduler, such as ``tcp://127.0.0.1:8786``.

    Raises:
        InputError: for an unknown name, an address that is none, a scheduler that cannot be reached or has no
            workers, or without Dask; within, also for a cluster that is lost on the way, or whose workers have no
            footwork or another one.
    """
    with _opened(name, scheduler) as place:
        token = _place.set(place)
        try:
            yield
        finally:
            _place.reset(token)


def _opened(name: str, scheduler: str | None) -> AbstractContextManager[Place]:
    if name not in BACKENDS:
        raise InputError(f"{name!r} is no place to run, there is {', '.join(BACKENDS)}", "--backend")
    if name == "threads":
        if scheduler is not None:
            raise InputError(
                "threads of this process have no scheduler, expected it with --backend dask", "--scheduler"
            )
        return nullcontext(_HERE)
    if scheduler is None:
        raise InputError(f"not given, expected the address of a Dask scheduler, such as {_EXAMPLE}", "--scheduler")
    from footwork.training.dask_cluster import cluster  # here, so that only those who use Dask need it

    return cluster(scheduler)


def run_tasks(
    function: Callable[..., Any],
    shared: Sequence[Any],
    tasks: Sequence[Any],
    progress: Callable[[float], None] | None = None,
) -> list[Any]:
    """``[function(task, *shared) for task in tasks]``, in the order of the tasks whatever order they finish in.

    Args:
        function: a module's own function, without side effects: a task runs again where a worker is lost.
        shared: large arrays that every task reads and none writes; each worker gets them once, read-only.
        tasks: what differs between tasks, small and picklable.
        progress: told the share of the tasks that are finished.

    Raises:
        InputError: where the cluster cannot go on.
        Exception: whatever ``function`` raises.
    """
    place = _place.get()
    results: dict[int, Any] = {}
    for _ in range(_ROUNDS):
        waiting = {number: task for number, task in enumerate(tasks) if number not in results}
        try:
            for number, result in _finished(place, function, shared, waiting):
                results[number] = result
                if progress is not None:
                    progress(len(results) / len(tasks))
        except DataLostError:
            continue
        # joblib may end without an error that came while it looked for one: then the next round meets it again
        if len(results) == len(tasks):
            return [results[number] for number in range(len(tasks))]
    raise InputError(f"lost workers with their data {_ROUNDS} times, expected workers that stay", "--scheduler")


def _finished(
    place: Place, function: Callable[..., Any], shared: Sequence[Any], tasks: dict[int, Any]
) -> Iterator[tuple[int, Any]]:
    """Number and result of each task, as they finish."""
    with place.shared(shared) as held, parallel_config(place.joblib_backend, n_jobs=THREADS):
        calls = (delayed(_numbered)(number, function, task, *held) for number, task in tasks.items())
        # all at once and one by one: who runs them then shares them out by how fast they go
        options: dict[str, Any] = {"return_as": "generator_unordered", "pre_dispatch": "all", "batch_size": 1}
        finished: Any = Parallel(**options)(calls)
        yield from finished


def _numbered(number: int, function: Callable[..., Any], task: Any, *shared: Any) -> tuple[int, Any]:
    return number, function(task, *shared)
