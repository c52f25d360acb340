"""How much memory the process has held at most, and how much the machine has."""

import os
import resource
import sys


def peak_rss_mb() -> float:
    """The largest resident size of this process so far, in 2^20 bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # kilobytes on Linux, bytes on macOS
    return peak / (1 << 20) if sys.platform == "darwin" else peak / 1024


def machine_bytes() -> int:
    """The machine's main memory, bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
