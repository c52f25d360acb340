"""Recordings of matches: the styles, the rules and the seed are all that a match is made of.

What is kept besides is the digest of its state every two seconds, so that a replay is known to be the same.
"""

import hashlib
from importlib.metadata import version
from pathlib import Path

from footwork.controllers.fighting_style import FightingStyle
from footwork.controllers.ranged_numbers import numbers_of, of_numbers
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.tick import TICK_RATE
from footwork.runtime import recording as r
from footwork.runtime.match import Match, fight_ground, table_of
from footwork.runtime.match_rules import MatchRules
from footwork.runtime.recorder import Recorder, state_digest
from footwork.runtime.replay import Outcome, Shown, processor, require_same

_SLOTS = b"\0\1"


def record_fight(match: Match, ticks: int, path: str | Path) -> None:
    """Make ticks of a match that has not begun, and write down what makes it.

    Raises:
        InputError: for a match that has begun, a file that exists, or a place that cannot be written to.
    """
    if match.tick:
        raise InputError(f"{match.tick} ticks of it are made, expected a match that has not begun", path)
    recorder = Recorder(path, _header(match))
    styles = numbers_of(match.styles[0]), numbers_of(match.styles[1])
    recorder.add(r.Fought(1, styles, numbers_of(match.rules), match.shadowing is not None))
    while match.tick < ticks:
        match.play(min(ticks - match.tick, r.STATE_TICKS))
        recorder.add_state(match.tick, _SLOTS, match.rows())
    recorder.end(match.tick)
    recorder.wait()
    if recorder.errors:
        raise InputError("could not be written to its end", path)


def is_fight(recording: r.Recording) -> bool:
    """Whether a recording is of a match."""
    return bool(recording.records) and isinstance(recording.records[0], r.Fought)


def match_of(recording: r.Recording, bundle: Bundle) -> Match:
    """The match that a recording is of, before its first tick.

    Raises:
        InputError: for another bundle, another version of footwork, or numbers that no style or rule can have.
    """
    require_same(recording, bundle)
    begun, header = recording.records[0], recording.header
    if not isinstance(begun, r.Fought) or any(isinstance(record, r.Effect) for record in recording.records[1:]):
        raise InputError("damaged: expected one match and nothing else in it", recording.where)
    styles = [of_numbers(FightingStyle, numbers, recording.where) for numbers in begun.styles]
    return Match(
        fight_ground(bundle),
        styles,
        header.seed,
        rules=of_numbers(MatchRules, begun.rules, recording.where),
        shadowing=table_of(bundle) if begun.table else None,
        inertialise=header.inertialise,
        foot_lock=header.foot_lock,
    )


def replay_fight(recording: r.Recording, bundle: Bundle, shown: Shown | None = None) -> Outcome:
    """Make a recorded match once more.

    Args:
        recording: ``is_fight``.
        bundle: what it was recorded with.
        shown: is given the tick last made and the poses of the ticks up to it, (ticks, 1, 2, 3 + 4 J).

    Raises:
        InputError: for another bundle, another version of footwork, or numbers that no style or rule can have.
    """
    match = match_of(recording, bundle)
    digest, states, agreed, departed = hashlib.blake2b(digest_size=16), 0, 0, None
    for record in recording.records[1:]:
        poses = match.play(r.made_by(record) - match.tick, shown=True)
        digest.update(poses.data)
        if shown is not None:
            shown(match.tick, poses[:, None])
        if isinstance(record, r.State):
            states += 1
            same = state_digest(_SLOTS, match.rows()) == record.digest
            agreed = record.tick if same and departed is None else agreed
            departed = record.tick if departed is None and not same else departed
    return Outcome(match.tick, 2, 0, states, agreed, departed, digest.hexdigest())


def _header(match: Match) -> r.Header:
    smoothing = match.world.smoothing
    return r.Header(
        version=r.VERSION,
        bundle=match.ground.bundle.digest,
        footwork=version("footwork"),
        processor=processor(),
        rate=TICK_RATE,
        capacity=2,
        inertialise=smoothing.inertialise,
        foot_lock=smoothing.foot_lock,
        seed=match.seed,
    )
