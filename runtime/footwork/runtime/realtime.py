"""Real-time priority for the threads that make and send ticks, where the system permits it."""

import ctypes
import os
import sys
from pathlib import Path

if sys.platform == "linux":
    import resource

_PRIORITY = 10
_CURRENT, _FUTURE, _ON_FAULT = 1, 2, 4  # mlockall's flags
_TRANSPORT = "ZMQbg"  # what libzmq calls its threads


def take_realtime() -> list[str]:
    """Schedule the calling thread and libzmq's threads before all others (SCHED_FIFO), and keep memory from being
    swapped out; returns what was not permitted, a line each. Threads begun later do not inherit it.
    """
    if sys.platform != "linux":
        return ["real-time scheduling is for Linux only"]
    return [problem for problem in (_schedule(), _lock_memory()) if problem]


def _schedule() -> str:
    try:
        for thread in _threads():
            os.sched_setscheduler(thread, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(_PRIORITY))
    except OSError as error:
        return f"no real-time scheduling: {error.strerror}; it takes CAP_SYS_NICE or a limit on rtprio of {_PRIORITY}"
    return ""


def _threads() -> list[int]:
    """The calling thread and those of libzmq; 0 is the calling one."""
    others = Path("/proc/self/task").glob("*/comm")
    return [0, *(int(name.parent.name) for name in others if name.read_text().startswith(_TRANSPORT))]


def _lock_memory() -> str:
    if os.geteuid() != 0 and resource.getrlimit(resource.RLIMIT_MEMLOCK)[0] != resource.RLIM_INFINITY:
        # under a finite limit, locking all that is to come would make later allocations fail
        return "memory is not locked: it takes an unlimited memlock"
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mlockall(_CURRENT | _FUTURE | _ON_FAULT) != 0:
        return f"memory is not locked: {os.strerror(ctypes.get_errno())}"
    return ""
