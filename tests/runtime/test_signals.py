"""A server that runs on the main thread does as signals tell it."""

import os
import signal

import pytest

from footwork.runtime.server import Server
from footwork.runtime.signals import answering_signals
from toy_bundle import toy_bundle


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_server_ends_by_itself_and_the_handlers_come_back(number):
    before = signal.getsignal(number)
    server = Server(toy_bundle(), bind="tcp://127.0.0.1:0")

    def asked_to_end_at_the_third_tick() -> bool:
        if server.ticks == 3:
            os.kill(os.getpid(), number)
        return server.ticks > 30

    with answering_signals(server):
        server.run(until=asked_to_end_at_the_third_tick)
    assert server.ticks == 3
    assert server.wait(0.0)
    assert signal.getsignal(number) is before


def test_a_hangup_asks_for_a_reload_and_ends_nothing():
    server = Server(toy_bundle(), bind="tcp://127.0.0.1:0")
    asked = []

    def hung_up_on_at_the_third_tick() -> bool:
        if server.ticks == 3 and not asked:
            os.kill(os.getpid(), signal.SIGHUP)
        return server.ticks >= 6

    with answering_signals(server, lambda: asked.append(server.ticks)):
        server.run(until=hung_up_on_at_the_third_tick)
    assert asked == [3]
    assert server.ticks == 6
