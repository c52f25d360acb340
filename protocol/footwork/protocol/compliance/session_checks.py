"""Checks of sessions: how they begin, end and are resumed."""

from footwork.protocol import messages as m
from footwork.protocol.compliance.peer import Dial, Failed, calling, expect, in_session
from footwork.protocol.errors import LOCK_STEP, NO_SESSION, RESUME, STATE, VERSION


def the_welcome_tells_what_a_client_needs(dial: Dial) -> None:
    """Rates, a body whose parents come before their children, behaviours, limits and a token."""
    with in_session(dial) as peer:
        welcome = peer.welcome
        expect((welcome.version, welcome.tick_rate), (m.PROTOCOL_VERSION, m.TICK_RATE), "version and tick rate")
        expect(welcome.frame_rate % welcome.tick_rate, 0, "frame rate over tick rate")
        sizes = {len(each) for each in (welcome.joints, welcome.parents, welcome.offsets, welcome.ends)}
        expect(sizes, {len(welcome.joints)}, "sizes of the body's lists")
        expect(welcome.parents[0], -1, "parent of joint 0")
        expect([n for n, parent in enumerate(welcome.parents) if not parent < n], [], "joints before their parents")
        expect(len(welcome.token), 16, "length of the token")
        expect((welcome.resumed, welcome.spawned), (False, ()), "what a new session has")
        if not welcome.behaviours or min(welcome.characters, welcome.message_bytes, welcome.messages_per_tick) < 1:
            raise Failed("no behaviours, or a limit of nothing")


def another_version_is_turned_away(dial: Dial) -> None:
    """An error and a bye, both with the code ``version``."""
    with calling(dial) as peer:
        peer.say(m.Hello(version=m.PROTOCOL_VERSION + 1))
        peer.refusal(VERSION)
        expect(peer.hear(m.Bye).reason, VERSION, "reason of the bye")


def a_stranger_says_hello_first(dial: Dial) -> None:
    """Any other message is refused, with its sequence."""
    with calling(dial) as peer:
        peer.say(m.Despawn(sequence=5, character=0))
        peer.refusal(NO_SESSION, 5)


def a_second_hello_is_out_of_place(dial: Dial) -> None:
    """It is refused, and the session goes on."""
    with in_session(dial) as peer:
        peer.say(m.Hello(version=m.PROTOCOL_VERSION))
        peer.refusal(STATE)
        peer.say(m.Ping(nonce=1))
        peer.hear(m.Pong)


def a_ping_is_answered_with_its_nonce(dial: Dial) -> None:
    """Without waiting for a tick to be asked for."""
    with in_session(dial) as peer:
        for nonce in (0, 7, 2**53 - 1):
            peer.say(m.Ping(nonce=nonce))
            expect(peer.hear(m.Pong).nonce, nonce, "nonce")


def after_a_bye_there_is_no_session(dial: Dial) -> None:
    """And a hello begins another, on the same line."""
    with calling(dial) as peer:
        first = peer.greet()
        peer.say(m.Bye())
        peer.say(m.Ping())
        expect(peer.hear(m.Error).code, NO_SESSION, "error code")
        if peer.greet().token == first.token:
            raise Failed("two sessions have the same token")
        peer.say(m.Bye())


def a_token_brings_the_session_back(dial: Dial) -> None:
    """Over another line: its characters, its sequence and what was acknowledged."""
    with calling(dial) as peer:
        token = peer.greet().token
        sequence = peer.spawn(3, x=30.0).sequence
        peer.pose_after(sequence)
    with in_session(dial, resume=token) as peer:
        welcome = peer.welcome
        expect((welcome.resumed, welcome.token), (True, token), "what the welcome says of the session")
        expect((welcome.sequence, peer.own), (sequence, (3,)), "sequence and characters")
        pose = peer.pose()
        expect((pose.character, pose.acknowledged), (3, sequence), "character and acknowledged sequence")


def a_token_of_no_session_is_refused(dial: Dial) -> None:
    """An error and a bye with the code ``resume``; after a bye a session's own token is one of those."""
    with calling(dial) as peer:
        token = peer.greet().token
        peer.say(m.Bye())
        peer.say(m.Ping())
        peer.refusal(NO_SESSION)  # the bye was taken
    for wrong in (token, bytes(16)):
        with calling(dial) as peer:
            peer.say(m.Hello(version=m.PROTOCOL_VERSION, resume=wrong))
            peer.refusal(RESUME)
            expect(peer.hear(m.Bye).reason, RESUME, "reason of the bye")


def a_step_is_made_in_lock_step_only(dial: Dial) -> None:
    """So many ticks and an answer, or a refusal where the server has a clock."""
    with in_session(dial) as peer:
        welcome = peer.welcome
        peer.say(m.Step(ticks=3))
        if not welcome.lockstep:
            expect(peer.hear(m.Error).code, LOCK_STEP, "error code")
        else:
            expect(peer.hear(m.Stepped).tick, welcome.tick + 3, "tick")
