"""Python's garbage collector, kept out of the ticks."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def held_collector() -> Iterator[None]:
    """Freeze what exists and collect nothing by itself, so that no full collection stalls a tick."""
    enabled = gc.isenabled()
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        yield
    finally:
        gc.unfreeze()
        if enabled:
            gc.enable()


def collect_young() -> None:
    """Collect what came into being since the freeze; for the spare time between ticks."""
    gc.collect(1)
