"""Real-time priority: taken or said why not, and only by those threads that make and send ticks."""

import os
import subprocess
import sys
from pathlib import Path

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


RELOADED = """
import os, sys, threading
from dataclasses import replace
from pathlib import Path
from footwork.motion.bundle import sealed, write_bundle
from footwork.runtime.realtime import take_realtime
from footwork.runtime.reload import Reloader
from footwork.runtime.server import Server
from served import until
from toy_bundle import toy_bundle

def priorities():
    for thread in Path("/proc/self/task").iterdir():
        policy = os.sched_getscheduler(int(thread.name)) & ~os.SCHED_RESET_ON_FORK
        yield (thread / "comm").read_text().strip(), int(thread.name) == os.getpid(), policy == os.SCHED_FIFO

def replace_the_bundle():
    write_bundle(path, sealed(replace(toy_bundle(), attribution=("another one",))))
    reloader.ask()
    until(lambda: server.reloads == 1)
    told.extend(priorities())
    server.stop()

folder = Path(sys.argv[1])
path, told = folder / "served.footwork", []
write_bundle(path, toy_bundle())
server = Server(toy_bundle(), bind="tcp://127.0.0.1:0", record=folder)
with Reloader(server, {"bundle": path}) as reloader:
    problems = take_realtime()
    helper = threading.Thread(target=replace_the_bundle)
    helper.start()
    server.run()
    helper.join()
assert server.reloads == 1 and len(server.summary()["recordings"]) == 2
granted = not any("scheduling" in problem for problem in problems)
for name, first, realtime in told:
    assert realtime == (granted and (first or name.startswith("ZMQbg"))), (name, told)
assert any(name.startswith("ZMQbg") for name, _, _ in told) and len(told) >= 6, told
"""


@pytest.mark.skipif(sys.platform != "linux", reason="Linux only")
def test_after_a_reload_it_is_the_same_threads_that_have_it(tmp_path):
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[1])}
    command = [sys.executable, "-c", RELOADED, str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="Linux only")
@pytest.mark.parametrize("permitted", [True, False])
def test_it_is_taken_where_permitted_and_otherwise_said(permitted):
    if not permitted and os.geteuid() != 0:
        pytest.skip("only root can give the permission up")
    drop = "" if permitted else "import os; os.setgid(65534); os.setuid(65534)\n"
    code = TRIED.replace("problems = take_realtime()", drop + "problems = take_realtime()", 1)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
