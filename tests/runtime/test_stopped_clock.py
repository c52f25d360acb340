"""A server whose time of day jumps to and fro all the while, and whose process is stopped: sessions notice neither."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import zmq

from footwork.protocol.client import Client
from footwork.protocol.codec import encode
from footwork.protocol.messages import Hello, Ping
from footwork.runtime.clock import now_ns
from footwork.runtime.exchange import Exchange
from footwork.runtime.host import Host
from footwork.runtime.router import Router
from footwork.runtime.simulation import Simulation
from served import TIMEOUT, consecutive, ticks
from talk import LIMITS, SECOND, Talk, spawn
from toy_bundle import toy_bundle

IDLE = 2.0
STOPPED = 2.6  # longer than a session may be silent
SERVER = f"""
import json, sys
from pathlib import Path
from footwork.runtime.limits import Limits
from footwork.runtime.server import Server
from footwork.runtime.signals import answering_signals
from toy_bundle import toy_bundle
limits = Limits(idle_seconds={IDLE})
server = Server(toy_bundle(), bind="tcp://127.0.0.1:0", limits=limits, record=Path(sys.argv[1]))
print(server.address, flush=True)
with answering_signals(server):
    server.run()
print(json.dumps(server.summary()))
"""
JUMPS = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sys/time.h>
#include <time.h>

/* a year ahead for a fifth of a second, five hours back for the next */
int clock_gettime(clockid_t which, struct timespec *now) {
    static int (*real)(clockid_t, struct timespec *);
    struct timespec steady;
    if (!real) real = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
    int problem = real(which, now);
    if (problem || (which != CLOCK_REALTIME && which != CLOCK_REALTIME_COARSE)) return problem;
    real(CLOCK_MONOTONIC, &steady);
    now->tv_sec += steady.tv_nsec / 200000000 % 2 ? 365 * 86400 : -5 * 3600;
    return 0;
}
int gettimeofday(struct timeval *restrict now, void *restrict zone) {
    struct timespec exact;
    clock_gettime(CLOCK_REALTIME, &exact);
    now->tv_sec = exact.tv_sec;
    now->tv_usec = exact.tv_nsec / 1000;
    return 0;
}
time_t time(time_t *now) {
    struct timespec exact;
    clock_gettime(CLOCK_REALTIME, &exact);
    if (now) *now = exact.tv_sec;
    return exact.tv_sec;
}
"""


@pytest.fixture(scope="module")
def jumping(tmp_path_factory):
    """A library that, preloaded, lets the time of day jump."""
    if sys.platform != "linux" or shutil.which("cc") is None:
        pytest.skip("needs Linux and a C compiler")
    folder = tmp_path_factory.mktemp("clock")
    (folder / "jumps.c").write_text(JUMPS)
    subprocess.run(["cc", "-shared", "-fPIC", "-o", "jumps.so", "jumps.c", "-ldl"], cwd=folder, check=True)
    return folder / "jumps.so"


def stop_for(process: subprocess.Popen, seconds: float, client: Client) -> None:
    """Stop the process; the client commands on, 200 times, more than a tick's worth."""
    process.send_signal(signal.SIGSTOP)
    try:
        for number in range(200):
            client.command(0, 0.01 * number, "walk")
            time.sleep(seconds / 200)
    finally:
        process.send_signal(signal.SIGCONT)


def play(process: subprocess.Popen) -> None:
    with Client(process.stdout.readline().strip(), timeout=60) as client:  # type: ignore[union-attr]
        client.spawn(0)
        start = time.monotonic()
        assert consecutive(ticks(client, 40))  # over a second: six jumps
        assert time.monotonic() - start < TIMEOUT  # and not for as long as the clock went back
        start = time.monotonic()
        stop_for(process, STOPPED, client)
        assert consecutive(ticks(client, 60))
        # what was on its way, and no more caught up with than a quarter of a second
        assert time.monotonic() - start > STOPPED + (60 - 8 - 8) / 30
        sequence = client.command(0, 0.0, "walk")
        assert next(pose for pose in client.poses() if pose.acknowledged == sequence)


def test_neither_a_jump_of_the_clock_nor_a_stop_is_noticed_by_a_session(jumping, tmp_path):
    environment = {**os.environ, "LD_PRELOAD": str(jumping), "PYTHONPATH": str(Path(__file__).parents[1])}
    command = [sys.executable, "-c", SERVER, str(tmp_path)]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as process:
        try:
            play(process)
        finally:
            process.terminate()
        summary = json.loads(process.stdout.read())  # type: ignore[union-attr]
    assert (summary["sessions"], summary["resumed"], summary["refused"], summary["cut"]) == (1, 0, 0, 0)
    assert summary["skipped_frames"] > 60
    (recording,) = tmp_path.iterdir()
    told = time.strptime(recording.name[:16], "%Y%m%dT%H%M%SZ")
    assert abs(time.mktime(told) - time.mktime(time.gmtime())) > 3600  # the jumps were real


class StoppedWhileWaiting(Router):
    """As of a process that is stopped where it nearly always is."""

    def next(self, milliseconds):
        time.sleep(1.2)
        return super().next(milliseconds)


def test_in_lock_step_what_came_while_the_process_was_stopped_is_heard_when_it_is_taken():
    host = Host(Simulation(toy_bundle(), 1), 30, LIMITS, lockstep=True)
    router, dealer = StoppedWhileWaiting("tcp://127.0.0.1:0"), zmq.Context.instance().socket(zmq.DEALER)
    exchange = Exchange(host, router, LIMITS)
    dealer.connect(router.address)
    try:
        for message in (Hello(version=1), Ping()):
            dealer.send(encode(message))
            time.sleep(0.1)
            exchange.wait(SECOND)
        (session,) = host.sessions.values()
        assert now_ns() - SECOND < session.heard <= now_ns()
    finally:
        dealer.close(linger=0)
        router.close()


@pytest.mark.parametrize("forgiven", [False, True])
def test_silence_and_floods_do_not_count_while_nobody_could_listen(forgiven):
    talk = Talk()
    talk.open(b"a")
    talk.open(b"away")
    talk.say(b"a", spawn(1, 0))
    talk.host.lose(b"away", 0)
    gone = round((LIMITS.resume_seconds + 1.0) * SECOND)
    if forgiven:
        talk.host.forgive(gone)
    talk.host.end_overdue(gone)
    assert len(talk.host.sessions) == forgiven
    assert len(list(talk.host._roster.all)) == 2 * forgiven
