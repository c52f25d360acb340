"""A Dask cluster as a place to run tasks, which ends in bounded time whatever becomes of the cluster."""

import asyncio
import time
from collections.abc import Callable, Coroutine, Iterator, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import contextmanager
from typing import Any
from uuid import uuid4

from footwork.errors import InputError
from footwork.training import dask_client
from footwork.training.backend import DataLostError
from footwork.training.dask_backend import DaskBackend
from footwork.training.dask_worker import Aligned, call_there, require_alike
from footwork.training.fingerprint import fingerprint

WORKERS = 15.0  # seconds in which workers have to appear, at first and after the last one went
LOADING = 60.0  # seconds in which workers have to load footwork
_PULSE = 0.5  # seconds between two looks at the cluster


@contextmanager
def cluster(scheduler: str) -> Iterator["Cluster"]:
    """The cluster whose scheduler is at this address; it is left as it was found.

    Raises:
        InputError: for an address that is none, where no scheduler answers, or where it has no workers.
    """
    with dask_client.connected(scheduler) as (client, loop):
        place = Cluster(client, loop, scheduler)
        try:
            place.require_workers()
            yield place
        finally:
            place.cancel()


class Cluster:
    """A connected cluster, watched as long as it is used.

    Whatever is asked of it is a future that ends when the answer is there, or when the watch gives the cluster up.
    """

    def __init__(self, client: Any, loop: asyncio.AbstractEventLoop, address: str) -> None:
        self.joblib_backend = DaskBackend(self)
        self._client = client
        self._loop = loop
        self._address = address
        self._asked: set[Future[Any]] = set()
        self._held: list[Any] = []
        self._trouble: InputError | None = None
        asyncio.run_coroutine_threadsafe(self._watch(), loop)

    def require_workers(self) -> None:
        """Raise InputError unless there are workers, and all of them compute with what this process does."""
        self._answer(self._ask(self._alike_workers()))

    @contextmanager
    def shared(self, arrays: Sequence[Any]) -> Iterator[Sequence[Any]]:
        """A copy of the arrays on every worker; workers that come later fetch theirs from those."""
        self.require_workers()
        self._held = self._answer(self._ask(self._scattered(arrays)))
        try:
            yield self._held
        finally:
            self._held = []

    def submit(self, call: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Run ``call(*arguments)`` on some worker."""
        return self._ask(self._called(call, arguments))

    def result(self, future: Future[Any]) -> Any:
        """What a submitted call returned.

        Raises:
            InputError: where the cluster was lost, or the worker computes with something else than this process.
            DataLostError: where it has to be submitted again.
            Exception: whatever the call raised.
        """
        returned = self._answer(future)
        require_alike(returned.worker, returned.versions)
        if returned.error is not None:
            raise returned.error
        return returned.result

    def cancel(self) -> None:
        """Take back whatever is asked and not answered."""
        for future in tuple(self._asked):
            future.cancel()

    def _ask(self, question: Coroutine[Any, Any, Any]) -> Future[Any]:
        """A future of the answer, which the watch can cancel."""
        future = asyncio.run_coroutine_threadsafe(question, self._loop)
        self._asked.add(future)
        future.add_done_callback(self._asked.discard)
        if self._trouble is not None:
            future.cancel()
        return future

    def _answer(self, future: Future[Any]) -> Any:
        try:
            return future.result()
        except InputError:
            raise
        except (CancelledError, OSError) as error:
            raise self._trouble or DataLostError() from error
        except Exception as error:
            said = " ".join(f"{type(error).__name__}: {error}".split())
            problem = f"the workers cannot go on ({said}), expected footwork and memory there"
            raise InputError(problem, self._address) from error

    async def _watch(self) -> None:
        """Look after the cluster, and end what is asked of it once it is gone or what it holds is lost."""
        while self._trouble is None:
            try:
                await self._some_workers()
            except InputError as error:
                self._trouble = error
            if self._trouble or any(data.status in ("lost", "cancelled") for data in self._held):
                self.cancel()
            await asyncio.sleep(_PULSE)

    async def _some_workers(self) -> None:
        deadline = time.monotonic() + WORKERS
        while not await self._cores():
            if time.monotonic() > deadline:
                problem = f"the scheduler has no workers, expected one at least: dask worker {self._address}"
                raise InputError(problem, self._address)
            await asyncio.sleep(_PULSE)

    async def _cores(self) -> dict[str, int]:
        try:
            return await asyncio.wait_for(self._client.scheduler.ncores(), dask_client.ANSWER)
        except Exception as error:  # what answers and cannot be understood is no scheduler any more
            raise InputError("the scheduler does not answer any more, expected it to stay", self._address) from error

    async def _alike_workers(self) -> None:
        """Tasks carry the same question, for workers that come later, but a worker without footwork dies of a task."""
        await self._some_workers()
        try:
            found = await asyncio.wait_for(self._client.run(fingerprint, on_error="return"), LOADING)
            _require_alike_workers(found)
            await asyncio.wait_for(self._client.run_on_scheduler(fingerprint), LOADING)
        except TimeoutError:
            raise InputError(f"workers load nothing within {LOADING:g} s, expected them to", self._address) from None
        except ImportError as error:  # it reads the tasks, too
            problem = f"the scheduler cannot load footwork ({error}), expected it there: pip install 'footwork[scale]'"
            raise InputError(problem, self._address) from None

    async def _scattered(self, arrays: Sequence[Any]) -> list[Any]:
        once = {id(array): Aligned(array) for array in arrays}
        if not once:
            return []
        sent = await self._client.scatter(list(once.values()), broadcast=True, hash=False)
        standing = dict(zip(once, sent, strict=True))
        return [standing[id(array)] for array in arrays]

    async def _called(self, call: Callable[..., Any], arguments: Sequence[Any]) -> Any:
        """The result of a call on a worker; it is forgotten there as soon as it is here or wanted no more."""
        remote = self._client.submit(call_there, call, *arguments, key=f"footwork-{uuid4().hex}", pure=False)
        try:
            return await remote
        finally:
            remote.release()


def _require_alike_workers(found: dict[str, Any]) -> None:
    for worker, answer in found.items():
        if not isinstance(answer, OSError):  # a worker that has gone meanwhile
            require_alike(worker, answer)
