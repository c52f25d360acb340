"""Recordings as films: what the characters of a game, or two fighters, did, as it was shown."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from footwork.cli.film import LONGEST_SECONDS, Role, packed, ticks_within
from footwork.cli.output import log, progress
from footwork.errors import InputError
from footwork.motion.tick import TICK_RATE

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help loads no numerics
    import numpy as np
    from numpy.typing import NDArray

    from footwork.motion.bundle import Bundle
    from footwork.runtime.recording import Recording
    from footwork.runtime.replay import Replay

MOST_ROLES = 8
"""Characters of a film; those who come later are left out."""


def is_recording(path: Path) -> bool:
    """Whether a file begins as recordings do."""
    from footwork.runtime.recording import MAGIC

    with path.open("rb") as file:
        return file.read(len(MAGIC)) == MAGIC


def recorded_film(path: Path, bundle: Path, start: float, seconds: float | None) -> bytes:
    """The film of a recording, as it was shown and at the rate at which it was recorded.

    Args:
        path: the recording; one that was cut off is shown up to its last whole record.
        bundle: what it was made with.
        start: where in it the film begins, seconds.
        seconds: how long the film is; to the recording's end, but LONGEST_SECONDS at most, where not given.

    Raises:
        InputError: for no recording or a damaged one, another bundle or version of footwork, and times out of it.
    """
    from footwork.motion.bundle import read_bundle
    from footwork.runtime.fight_recording import is_fight
    from footwork.runtime.recording import read_recording

    recording = read_recording(path)
    made_with = read_bundle(bundle)
    span = _span(recording, start, seconds)
    film = _of_fight if is_fight(recording) else _of_game
    with progress() as tell:
        tell("replaying", 0.0)
        return film(recording, made_with, span)


def _span(recording: Recording, start: float, seconds: float | None) -> range:
    """The ticks of the film."""
    whole = recording.last - recording.first
    skipped = round(start * TICK_RATE)
    if whole < 1:
        raise InputError("holds no tick, expected at least one", recording.where)
    if not 0 <= skipped < whole:
        raise InputError(f"{start:g} seconds, the recording has {whole / TICK_RATE:.1f}", "--start")
    wanted = LONGEST_SECONDS if seconds is None else seconds
    first = recording.first + 1 + skipped
    return range(first, min(first + ticks_within(wanted, "--seconds"), recording.last + 1))


def _tell_of(recording: Recording, span: range) -> None:
    """Say what is shown of a recording."""
    if not recording.whole:
        log(f"{recording.where}: was cut off, and is shown up to its last whole record")
    begin, end = ((tick - recording.first) / TICK_RATE for tick in (span.start - 1, span.stop - 1))
    whole = (recording.last - recording.first) / TICK_RATE
    log(f"{recording.where}: from {begin:.1f} to {end:.1f} s of {whole:.1f} s")


def _of_fight(recording: Recording, bundle: Bundle, span: range) -> bytes:
    from footwork.cli.fight_film import film_of_match
    from footwork.controllers.fighting_style import STYLES
    from footwork.runtime.fight_recording import match_of

    match = match_of(recording, bundle)
    known = {style: name for name, style in STYLES.items()}
    titles = [known.get(style, f"fighter {who}") for who, style in enumerate(match.styles)]
    match.play(span.start - 1)
    _tell_of(recording, span)
    return film_of_match(match, titles, len(span))


def _of_game(recording: Recording, bundle: Bundle, span: range) -> bytes:
    from footwork.runtime.recording import made_by
    from footwork.runtime.replay import Replay

    # records are two seconds apart at most, so that little is made in vain behind the film's end
    end = next((k for k, record in enumerate(recording.records, 1) if made_by(record) >= span.stop - 1), None)
    replay = Replay(replace(recording, records=recording.records[:end]), bundle, at_once=1)
    watch = _Watch(replay, span)
    replay.run(watch.see)
    if not watch.seen:
        raise InputError("shows no character there, expected at least one", recording.where)
    if watch.left_out:
        log(f"{recording.where}: {len(watch.left_out)} characters that come after the first {MOST_ROLES} are left out")
    shown = watch.shown
    _tell_of(recording, shown)
    return packed(
        bundle.graph,
        replay.simulation.behaviours,
        watch.roles(),
        rate=recording.header.rate,
        first_tick=shown.start,
        attribution=bundle.attribution,
    )


@dataclass
class _Seen:
    """One character, tick by tick.

    Args:
        first: the tick at which it comes.
        poses: of the frames of each tick.  # (frames, 3 + 4 J)
        doing: behaviour, whether it is a transition, and node, of each tick.
        health: of a fighter, of each tick.
    """

    first: int
    poses: list[NDArray[np.float32]] = field(default_factory=list)
    doing: list[tuple[int, bool, int]] = field(default_factory=list)
    health: list[float] = field(default_factory=list)


class _Watch:
    """Keeps what a replay that makes its ticks one by one shows in a span of them, by character."""

    def __init__(self, replay: Replay, span: range) -> None:
        from footwork.study.recorded_motion import Occupants

        self._replay, self._span = replay, span
        self._occupants = Occupants(replay.recording)
        self.seen: dict[tuple[int, int], _Seen] = {}
        self.left_out: set[tuple[int, int]] = set()

    def see(self, tick: int, poses: NDArray[np.float32]) -> None:
        """Take the poses of a tick.  # (1, frames, characters, 3 + 4 J)"""
        from footwork.runtime.arena import Arena

        if tick not in self._span:
            return
        simulation = self._replay.simulation
        for row, who in enumerate(self._occupants.at(tick, simulation.world.slots)):
            if who not in self.seen and len(self.seen) == MOST_ROLES:
                self.left_out.add(who)
                continue
            seen, slot = self.seen.setdefault(who, _Seen(tick)), who[1]
            seen.poses.append(poses[0, :, row].copy())
            seen.doing.append((simulation.behaviour[slot], simulation.transition[slot], simulation.world.node[slot]))
            if isinstance(simulation, Arena):
                seen.health.append(float(simulation.health[slot]))

    @property
    def shown(self) -> range:
        """The ticks from the first to the last in which somebody is there."""
        seen = self.seen.values()
        return range(min(one.first for one in seen), max(one.first + len(one.poses) for one in seen))

    def roles(self) -> list[Role]:
        """Of all that are kept, in the order in which they came."""
        return [self._role(f"character {number}", seen) for number, seen in enumerate(self.seen.values())]

    def _role(self, title: str, seen: _Seen) -> Role:
        import numpy as np

        frames = len(seen.poses[0])
        behaviour, transition, node = (np.repeat(np.array(column), frames) for column in zip(*seen.doing, strict=True))
        first = frames * (seen.first - self.shown.start)
        health = np.repeat(np.array(seen.health), frames) if seen.health else None
        return Role(title, first, np.concatenate(seen.poses), behaviour, transition, node, health)
