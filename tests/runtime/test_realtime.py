"""Real-time priority: taken or said why not, and only by those threads that make and send ticks."""

import os
import subprocess
import sys

import pytest

TRIED = """
import os, threading
from footwork.runtime.realtime import take_realtime
from footwork.runtime.router import Router
router = Router("tcp://127.0.0.1:0")
problems = take_realtime()
inherited = []
thread = threading.Thread(target=lambda: inherited.append(os.sched_getscheduler(0)))
thread.start()
thread.join()
mine = os.sched_getscheduler(0) & ~os.SCHED_RESET_ON_FORK
assert inherited == [os.SCHED_OTHER], inherited
assert (mine == os.SCHED_FIFO) == (not any("scheduling" in problem for problem in problems)), (mine, problems)
assert all("\\n" not in problem for problem in problems)
router.close()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="Linux only")
@pytest.mark.parametrize("permitted", [True, False])
def test_it_is_taken_where_permitted_and_otherwise_said(permitted):
    if not permitted and os.geteuid() != 0:
        pytest.skip("only root can give the permission up")
    drop = "" if permitted else "import os; os.setgid(65534); os.setuid(65534)\n"
    code = TRIED.replace("problems = take_realtime()", drop + "problems = take_realtime()", 1)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
