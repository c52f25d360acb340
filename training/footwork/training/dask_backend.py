"""joblib's way onto a cluster.

joblib brings a backend for Dask, which waits for ever where a worker cannot load a task or the scheduler is gone.
"""

from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, Protocol

from joblib.parallel import ParallelBackendBase


class Submitting(Protocol):
    """What runs calls elsewhere."""

    def submit(self, call: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Run ``call(*arguments)`` somewhere."""
        ...

    def result(self, future: Future[Any]) -> Any:
        """What the call returned; raises what it raised."""
        ...

    def cancel(self) -> None:
        """Take back what is not finished."""
        ...


class DaskBackend(ParallelBackendBase):
    """Gives each of joblib's tasks to a cluster."""

    supports_retrieve_callback = True

    def __init__(self, cluster: Submitting) -> None:
        super().__init__()
        self._cluster = cluster

    def effective_n_jobs(self, n_jobs: Any) -> Any:
        """At least two, as joblib would run the tasks of one job right here."""
        return max(2, n_jobs or 2)

    def submit(self, func: Any, callback: Callable[[Future[Any]], Any] | None = None) -> Future[Any]:
        """Send a batch of joblib, which is a single task as ``run_tasks`` asks for it."""
        [(call, arguments, _)] = func.items
        future = self._cluster.submit(call, *arguments)
        if callback is not None:
            future.add_done_callback(callback)
        return future

    def retrieve_result_callback(self, out: Future[Any]) -> Any:
        """The results of a batch."""
        return [self._cluster.result(out)]

    def abort_everything(self, ensure_ready: bool = True) -> None:
        """Take back what is not finished; the cluster stays ready."""
        self._cluster.cancel()
