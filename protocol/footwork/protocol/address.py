"""What both ends must know of an address before libzmq sees it."""

import zmq

from footwork.protocol.errors import LocalError

_MOST_PORT = 65535


def port_fits(address: str) -> bool:
    """Whether the TCP port is at most 65535: libzmq takes a higher one modulo 65536 and goes where nobody looks."""
    port = address.rpartition(":")[2]
    return not (address.startswith("tcp://") and port.isdecimal() and int(port) > _MOST_PORT)


def is_ipv6(address: str) -> bool:
    """Whether the host is an IPv6 address in brackets, for which libzmq wants to be told."""
    return address.startswith("tcp://[")


def connect(socket: zmq.Socket, address: str, example: str) -> None:
    """Connect a socket to an address, of which ``example`` is one.

    Raises:
        LocalError: for an address that is none.
    """
    if not port_fits(address):
        raise LocalError(f"address {address!r}: a port is at most 65535")
    socket.set(zmq.IPV6, is_ipv6(address))
    try:
        socket.connect(address)
    except zmq.ZMQError as error:
        raise LocalError(f"address {address!r}: {error.strerror}, expected such as {example}") from None
