"""How many threads offline work is shared out to; results never depend on it."""

import os

_MOST = 8


def thread_count() -> int:
    """The processors this process may use, at most eight."""
    if hasattr(os, "sched_getaffinity"):
        return min(len(os.sched_getaffinity(0)), _MOST)
    return min(os.cpu_count() or 1, _MOST)


THREADS = thread_count()
