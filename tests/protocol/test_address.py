"""Addresses that libzmq would take for others."""

import pytest

from footwork.protocol.address import is_ipv6, port_fits
from footwork.protocol.client import Client
from footwork.protocol.errors import LocalError


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:65535", "tcp://127.0.0.1:*", "ipc://place:99999", "tcp://host"])
def test_ports_that_fit(address):
    assert port_fits(address)


def test_a_port_that_is_too_high_is_refused_by_the_client_too():
    assert not port_fits("tcp://127.0.0.1:65536")
    with pytest.raises(LocalError, match="a port is at most 65535"):
        Client("tcp://127.0.0.1:99999", timeout=0.1)


def test_brackets_tell_ipv6():
    assert is_ipv6("tcp://[::1]:5555")
    assert not is_ipv6("tcp://127.0.0.1:5555")
