"""What runs on a worker of a Dask cluster, and whether what it says can be trusted to be what we would compute."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from footwork.errors import InputError
from footwork.training.fingerprint import fingerprint


@dataclass(frozen=True)
class Returned:
    """How a call went on a worker.

    Args:
        result: what it returned.
        error: what it raised instead; errors of the call stay apart from those of the cluster.
        worker: the worker's address.
        versions: what it computes with.
    """

    result: Any
    error: Exception | None
    worker: str
    versions: dict[str, str]


def call_there(call: Callable[..., Any], *arguments: Any) -> Returned:
    """Run a call on the worker that this is."""
    from distributed import get_worker

    worker = get_worker().address
    try:
        return Returned(call(*arguments), None, worker, fingerprint())
    except Exception as error:
        return Returned(None, error, worker, fingerprint())


def require_alike(worker: str, found: dict[str, str] | Exception) -> None:
    """Raise InputError unless a worker computes with what this process does.

    Args:
        worker: its address.
        found: its ``fingerprint()``, or what it raised when it was asked.
    """
    if isinstance(found, Exception):
        problem = f"the worker cannot load footwork ({found}), expected it there: pip install 'footwork[scale]'"
        raise InputError(problem, worker)
    here = fingerprint()
    differing = [name for name in here if found.get(name) != here[name]]
    if differing:
        theirs = ", ".join(f"{name} {found.get(name)}" for name in differing)
        ours = ", ".join(f"{name} {here[name]}" for name in differing)
        raise InputError(f"the worker has {theirs}, expected the same as here: {ours}", worker)
