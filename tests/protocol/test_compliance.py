"""The compliance suite against our own server, in process and over a socket, and against servers that are wrong."""

import pytest

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.compliance import CHECKS, SocketLine, run
from footwork.protocol.compliance.__main__ import main
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.session import Session
from footwork.runtime.simulation import Simulation
from in_process import Switchboard
from served import BUNDLE, serving


def problems(outcomes) -> dict[str, str]:
    return {outcome.name: outcome.problem for outcome in outcomes if outcome.problem}


@pytest.mark.parametrize("lockstep", [False, True])
def test_our_host_passes_in_process(lockstep):
    host = Host(Simulation(BUNDLE, 64), 60, Limits(), lockstep=lockstep)
    outcomes = run(Switchboard(host, 2).dial)
    assert problems(outcomes) == {}
    assert len(outcomes) == len(CHECKS) > 20


def test_our_server_passes_over_a_socket_and_says_so(capsys):
    with serving() as server:
        assert main(server.address) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[-1] == f"{len(CHECKS)} passed, 0 failed"
    assert printed[0] == f"pass  {next(iter(CHECKS))}"


class Deaf:
    """A server that answers everything with the same message."""

    def __init__(self, answer: bytes) -> None:
        self._answer = answer

    def send(self, data: bytes) -> None:
        pass

    def receive(self, seconds: float) -> bytes | None:
        return self._answer

    def close(self) -> None:
        pass


@pytest.mark.parametrize("answer", [b"garbage", encode(m.Bye()), encode(m.Error(code="version", message=""))])
def test_a_server_that_says_one_thing_only_fails_every_check(answer):
    assert set(problems(run(lambda: Deaf(answer)))) == set(CHECKS)


class Careless(Host):
    """Mistakes the nonces of pings."""

    def _answer(self, session: Session, message: m.FromClient | None) -> None:
        super()._answer(session, m.Ping(nonce=5) if isinstance(message, m.Ping) else message)


def test_a_mistake_is_found_by_the_check_of_that_rule():
    host = Careless(Simulation(BUNDLE, 64), 60, Limits())
    found = problems(run(Switchboard(host, 2).dial))
    assert set(found) == {"a_ping_is_answered_with_its_nonce", "a_flood_is_cut_off"}


def test_an_address_that_is_none_is_told_in_a_line():
    with pytest.raises(SystemExit, match=r"address 'nonsense'.*expected such as tcp://"):
        main("nonsense")


def test_a_line_over_a_socket_hangs_up():
    line = SocketLine("tcp://127.0.0.1:9")
    assert line.receive(0.01) is None
    line.close()
