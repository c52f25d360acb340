"""``python -m footwork.protocol.compliance ADDRESS``: prints which checks a server passes; exit status 1 if not all."""

import sys
from functools import partial

from footwork.protocol.client import DEFAULT_ADDRESS
from footwork.protocol.compliance import run
from footwork.protocol.compliance.peer import SocketLine
from footwork.protocol.errors import LocalError


def main(address: str = DEFAULT_ADDRESS) -> int:
    """Check the server at an address; how many checks it failed."""
    try:
        outcomes = run(partial(SocketLine, address))
    except LocalError as error:
        sys.exit(f"compliance: {error}")
    for outcome in outcomes:
        print(f"FAIL  {outcome.name}: {outcome.problem}" if outcome.problem else f"pass  {outcome.name}")
    failed = sum(bool(outcome.problem) for outcome in outcomes)
    print(f"{len(outcomes) - failed} passed, {failed} failed")
    return failed


if __name__ == "__main__":
    sys.exit(min(1, main(*sys.argv[1:])))
