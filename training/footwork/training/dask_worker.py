"""What runs on a worker of a Dask cluster, and whether what it says can be trusted to be what we would compute."""

import pickle
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

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


@dataclass(frozen=True)
class Aligned:
    """What tasks share, an array or a named tuple of arrays, as it has to travel.

    Dask leaves arrays where they lie in a message, often at odd addresses, for which compiled code is compiled anew.
    These arrive at even ones, writable or not as they were.
    """

    value: Any

    def __reduce__(self) -> tuple[Any, ...]:
        frozen = [isinstance(field, np.ndarray) and not field.flags.writeable for field in _fields(self.value)]
        return _arrived, (pickle.dumps(self.value, protocol=4), frozen)  # later ones let Dask lay the arrays


def _arrived(pickled: bytes, frozen: list[bool]) -> Aligned:
    value = pickle.loads(pickled)  # noqa: S301  # part of what Dask unpickles anyway
    for field, read_only in zip(_fields(value), frozen, strict=True):
        if read_only:
            field.flags.writeable = False
    return Aligned(value)


def _fields(value: Any) -> tuple[Any, ...]:
    return value if isinstance(value, tuple) else (value,)


def call_there(call: Callable[..., Any], *arguments: Any) -> Returned:
    """Run a call on the worker that this is."""
    from distributed import get_worker

    worker = get_worker().address
    whole = [argument.value if isinstance(argument, Aligned) else argument for argument in arguments]
    try:
        return Returned(call(*whole), None, worker, fingerprint())
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
