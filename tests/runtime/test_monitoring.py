"""Health and metrics over HTTP, of a live server."""

import json
import socket
import sys
import threading
import time
import urllib.error
import urllib.request
from contextlib import suppress

import pytest

from footwork.errors import InputError
from footwork.runtime.monitoring import Monitoring
from served import TIMEOUT, client_of, serving


def got(url: str) -> tuple[int, str]:
    try:
        with urllib.request.urlopen(url, timeout=TIMEOUT) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def comes(url: str, wanted: int, seconds: float = TIMEOUT) -> str:
    """The health's status once it is answered with this number."""
    end = time.monotonic() + seconds
    while (answer := got(url))[0] != wanted:
        assert time.monotonic() < end, answer
        time.sleep(0.02)
    return json.loads(answer[1])["status"]


@pytest.fixture
def hold():
    """Holds the server up for as long as it is set."""
    return threading.Event()


@pytest.fixture
def watched(hold):
    def held_up() -> bool:
        while hold.is_set():
            time.sleep(0.01)
        return False

    with serving(held_up) as server, Monitoring(server, "127.0.0.1:0") as monitoring:
        yield server, monitoring.address


def test_metrics_tell_what_the_server_did(watched):
    server, address = watched
    with client_of(server) as client:
        client.spawn(0)
        next(pose for pose in client.poses() if pose.tick > 2)
        status, text = got(f"{address}/metrics")
    lines = dict(line.rsplit(" ", 1) for line in text.splitlines() if not line.startswith("#"))
    assert status == 200
    assert float(lines["footwork_ticks_total"]) >= 1
    first = '{bundle="bundle"}'
    assert float(lines[f"footwork_sessions_total{first}"]) == float(lines[f"footwork_characters{first}"]) == 1
    assert float(lines["footwork_connections"]) >= 1
    assert float(lines["footwork_bytes_out_total"]) > float(lines["footwork_bytes_in_total"]) > 0
    assert float(lines['footwork_tick_seconds_bucket{le="+Inf"}']) == float(lines["footwork_tick_seconds_count"]) > 0


def test_a_server_that_makes_ticks_is_well_and_one_that_stalls_is_not(watched, hold, monkeypatch):
    _, address = watched
    monkeypatch.setattr("footwork.runtime.monitoring.STALLED_SECONDS", 0.3)
    assert comes(f"{address}/health", 200) == "ok"
    hold.set()
    assert comes(f"{address}/health", 503) == "stalled"
    hold.clear()
    assert comes(f"{address}/health", 200) == "ok"


def test_who_asks_half_a_question_keeps_nobody_waiting(watched):
    _, address = watched
    host, port = address.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port))) as half:
        half.sendall(b"GET /hea")
        assert comes(f"{address}/health", 200) == "ok"
    assert got(f"{address}/nothing")[0] == 404


def test_without_the_package_metrics_say_what_is_missing_and_health_goes_on(watched, monkeypatch):
    _, address = watched
    monkeypatch.setitem(sys.modules, "prometheus_client", None)
    status, text = got(f"{address}/metrics")
    assert status == 501
    assert "footwork[metrics]" in text
    assert comes(f"{address}/health", 200) == "ok"


@pytest.mark.parametrize("bind", ["nonsense", "127.0.0.1", "127.0.0.1:x", "127.0.0.1:70000", "300.0.0.1:0"])
def test_an_address_that_is_none_is_refused(watched, bind):
    with pytest.raises(InputError):
        Monitoring(watched[0], bind)


def test_who_asks_a_byte_at_a_time_is_hung_up_on(watched, monkeypatch):
    monkeypatch.setattr("footwork.runtime.monitoring._PATIENCE", 0.3)
    host, port = watched[1].removeprefix("http://").split(":")
    with socket.create_connection((host, int(port))) as slow:

        def goes_on() -> bool:
            with suppress(ConnectionError):
                slow.sendall(b"G")
                return True
            return False

        end = time.monotonic() + TIMEOUT
        while goes_on():
            assert time.monotonic() < end
            time.sleep(0.05)


def test_an_address_that_others_reach_is_warned_of(watched, caplog):
    with Monitoring(watched[0], "0.0.0.0:0"):
        assert "expected loopback" in caplog.text
