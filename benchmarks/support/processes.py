"""Processes beside the one that measures, and the loop that all lateness is compared with."""

import multiprocessing
import time
from multiprocessing.connection import Connection
from typing import Any

from footwork.runtime.clock import SECOND, FrameClock, now_ns
from footwork.runtime.ring import Ring

PROCESSES = multiprocessing.get_context("spawn")


def in_process(target: Any, *arguments: Any) -> tuple[Any, Connection]:
    """Start ``target(*arguments, pipe)`` in a process of its own; returns it and our end of the pipe."""
    ours, theirs = PROCESSES.Pipe()
    process = PROCESSES.Process(target=target, args=(*arguments, theirs), daemon=True)
    process.start()
    return process, ours


def idle(rate: int, seconds: float) -> dict[str, float]:
    """Lateness of an empty loop on a server's deadlines, microseconds, and how often it was a whole period late."""
    process, pipe = in_process(_empty_loop, rate, seconds)
    figures = pipe.recv()
    process.join()
    return figures


def lateness_shares(lateness: Ring) -> dict[str, float]:
    """Percentiles by name."""
    return {f"p{share:g}": round(lateness.percentile(share), 3) for share in (50, 99, 99.9)}


def _empty_loop(rate: int, seconds: float, pipe: Connection) -> None:
    """Process: wakes at every deadline and does nothing."""
    lateness, late = Ring(), 0
    clock = FrameClock(rate, now_ns() + SECOND // rate)
    for _ in range(round(rate * seconds)):
        time.sleep(max(0, clock.deadline - now_ns()) / SECOND)
        behind = now_ns() - clock.deadline
        lateness.add(behind / 1000.0)
        late += behind > clock.period
        clock.advance(now_ns())
    pipe.send(lateness_shares(lateness) | {"late": late})
