"""Checks of servers that play several bundles, or one."""

from footwork.protocol import messages as m
from footwork.protocol.compliance.peer import Dial, calling, expect, in_session
from footwork.protocol.errors import BUNDLE

_NOBODYS = "no/such/bundle"


def a_bundle_is_played_under_its_name(dial: Dial) -> None:
    """Who names none plays the first, and every name that the welcome tells may be asked for."""
    with in_session(dial) as peer:
        names = peer.welcome.bundles
        expect(peer.welcome.bundle, names[0] if names else "", "bundle of a hello that names none")
    for name in names:
        with in_session(dial, bundle=name) as peer:
            expect((peer.welcome.bundle, peer.welcome.bundles), (name, names), "bundle and bundles")
            peer.pose_after(peer.spawn(1).sequence)


def a_bundle_that_is_not_there_is_refused(dial: Dial) -> None:
    """An error that lists those there are, and a bye, both with the code ``bundle``."""
    with in_session(dial) as peer:
        names = peer.welcome.bundles
    if not names:
        return
    with calling(dial) as peer:
        peer.say(m.Hello(version=m.PROTOCOL_VERSION, bundle=_NOBODYS))
        expect(peer.refusal(BUNDLE).valid, names, "valid names")
        expect(peer.hear(m.Bye).reason, BUNDLE, "reason of the bye")
