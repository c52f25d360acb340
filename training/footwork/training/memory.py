"""How much memory the process has held at most, how much the machine has, and how much there is left to take."""

import os
import resource
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

_MEMINFO = Path("/proc/meminfo")
_CGROUPS = Path("/proc/self/cgroup")
_MOUNT = Path("/sys/fs/cgroup")
# limit, use, and the line of memory.stat with what can be dropped of that use: control groups version 2, then 1
_FILES = {
    "": ("memory.max", "memory.current", "inactive_file"),
    "memory": ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
}


def peak_rss_mb() -> float:
    """The largest resident size of this process so far, in 2^20 bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # kilobytes on Linux, bytes on macOS
    return peak / (1 << 20) if sys.platform == "darwin" else peak / 1024


def machine_bytes() -> int:
    """The machine's main memory, bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def available_bytes() -> int:
    """Main memory that can still be taken, bytes: what the machine has to give, within the limits set to the process.

    Where the machine does not say what it has to give, all that it has.
    """
    free = machine_bytes()
    with suppress(OSError, KeyError):
        free = 1024 * _numbers(_MEMINFO)["MemAvailable:"]
    return max(0, min([free, *_left_under_limits()]))


def _left_under_limits() -> Iterator[int]:
    """What the control groups that the process is in, and those around them, leave it."""
    with suppress(OSError, ValueError):
        for line in _CGROUPS.read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            kind = "memory" if "memory" in controllers.split(",") else controllers
            if kind in _FILES:
                # inside a container the group is the mount itself, whatever its path is called outside
                group = _MOUNT / kind / path.strip("/")
                yield from _left_in(group, *_FILES[kind])


def _left_in(group: Path, limit: str, used: str, droppable: str) -> Iterator[int]:
    for folder in (group, *group.parents):
        with suppress(OSError, ValueError):
            spare = _numbers(folder / "memory.stat").get(droppable, 0)
            yield int((folder / limit).read_text()) - int((folder / used).read_text()) + spare
        if folder == _MOUNT:
            return


def _numbers(path: Path) -> dict[str, int]:
    """First and second word of each line of a file of numbers."""
    words = [line.split() for line in path.read_text().splitlines()]
    return {line[0]: int(line[1]) for line in words if len(line) > 1 and line[1].isdigit()}
