"""Replays: a recording made once more, by the same simulation, to the same bytes."""

import hashlib
import platform
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial, singledispatch
from importlib.metadata import version

import llvmlite.binding
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import Command
from footwork.errors import FootworkError, InputError
from footwork.motion.bundle import Bundle
from footwork.motion.tick import TICK_RATE
from footwork.runtime import recording as r
from footwork.runtime.arena import Arena
from footwork.runtime.opponent import recorded_opponent
from footwork.runtime.recorder import Recorder
from footwork.runtime.simulation import Simulation
from footwork.runtime.world_errors import WorldError

_POSE_BYTES = 1 << 24
"""Poses are made for as many ticks at once as fit into this."""

Shown = Callable[[int, NDArray[np.float32]], object]
"""Is called with the tick last made and the poses of the ticks up to it, as of Simulation.play."""


def processor() -> str:
    """The kind of processor, which kernels are compiled for."""
    return f"{platform.machine()} {llvmlite.binding.get_host_cpu_name()}"


def start_recording(simulation: Simulation, path: object, *, rate: int, seed: int = 0) -> Recorder:
    """Record what happens in a simulation from now on.

    Args:
        simulation: one with nobody in it.
        path: the file, which must not exist yet.
        rate: how many frames of it are shown a second.
        seed: of whatever chooses the commands, 0 for players.

    Raises:
        InputError: for a file that exists, or a place that cannot be written to.
    """
    world = simulation.world
    header = r.Header(
        version=r.VERSION,
        bundle=simulation.bundle.digest,
        footwork=version("footwork"),
        processor=processor(),
        rate=rate,
        capacity=world.capacity,
        inertialise=world.smoothing.inertialise,
        foot_lock=world.smoothing.foot_lock,
        seed=seed,
    )
    recorder = Recorder(str(path), header)
    simulation.record(recorder)
    return recorder


def require_same(recording: r.Recording, bundle: Bundle) -> None:
    """Raise InputError for a recording that another bundle or another version of footwork made."""
    header = recording.header
    if header.bundle != bundle.digest:
        problem = f"was made with bundle {header.bundle[:12]}, this is {bundle.digest[:12]}"
        raise InputError(problem, recording.where)
    if header.footwork != version("footwork"):
        problem = f"was made by footwork {header.footwork}, this is {version('footwork')}"
        raise InputError(problem, recording.where)


@dataclass(frozen=True)
class Outcome:
    """How a replay went.

    Args:
        ticks: how many were made.
        characters: how many were spawned.
        commands: how many came into force.
        states: how many states were compared.
        agreed: the last tick whose state was the recorded one.
        departed: the first whose state was not, None where all were.
        poses: digest of all poses shown, in order.
    """

    ticks: int
    characters: int
    commands: int
    states: int
    agreed: int
    departed: int | None
    poses: str


class Replay:
    """One recording, replayed once.

    Args:
        recording: what took effect.
        bundle: what it was recorded with.
        at_once: ticks made at once, at most: 1 for who looks at the simulation after each of them.

    Raises:
        InputError: for another bundle, another version of footwork, or effects that cannot be.
    """

    def __init__(self, recording: r.Recording, bundle: Bundle, *, at_once: int = r.LONGEST_GAP) -> None:
        header = recording.header
        require_same(recording, bundle)
        self.recording, self._at_once = recording, at_once
        self.frames = header.rate // TICK_RATE
        self.simulation = _simulation_of(recording, bundle)
        self.simulation.tick = recording.first
        self._agreed, self._departed, self._states = recording.first, None, 0

    def run(self, shown: Shown | None = None) -> Outcome:
        """Make all ticks as they were recorded.

        Args:
            shown: is given all poses.

        Raises:
            InputError: for effects that cannot be.
        """
        digest, records = hashlib.blake2b(digest_size=16), self.recording.records
        for number, record in enumerate(records, 1):
            for poses in self._up_to(r.made_by(record)):
                digest.update(poses.data)
                if shown is not None:
                    shown(self.simulation.tick, poses)
            self._take(record, number)
        return Outcome(
            ticks=self.simulation.tick - self.recording.first,
            characters=sum(isinstance(record, r.Spawned) for record in records),
            commands=sum(isinstance(record, r.Commanded) for record in records),
            states=self._states,
            agreed=self._agreed,
            departed=self._departed,
            poses=digest.hexdigest(),
        )

    def _up_to(self, tick: int) -> Iterator[NDArray[np.float32]]:
        simulation = self.simulation
        while simulation.tick < tick:
            pose = 4 * (3 + 4 * simulation.world.graph.skeleton.joint_count)
            a_tick = max(1, self.frames * len(simulation.world.slots) * pose)
            most = max(1, _POSE_BYTES // a_tick)
            yield simulation.play(min(tick - simulation.tick, most, self._at_once), self.frames)

    def _take(self, record: r.AnyRecord, number: int) -> None:
        if isinstance(record, r.State):
            self._compare(record)
        elif not isinstance(record, r.End):
            try:
                take_effect(record, self.simulation)
            except FootworkError as error:
                raise InputError(f"record {number}: {error}", self.recording.where) from None

    def _compare(self, state: r.State) -> None:
        self._states += 1
        if self._departed is None:
            if self.simulation.digest() == state.digest:
                self._agreed = state.tick
            else:
                self._departed = state.tick


def _simulation_of(recording: r.Recording, bundle: Bundle) -> Simulation:
    """The simulation that a recording was made in, before its first tick."""
    header, first = recording.header, next(iter(recording.records), None)
    kind = Simulation
    if isinstance(first, r.Opposed):
        kind = partial(Arena, opponent=recorded_opponent(first, recording.where))
    return kind(bundle, header.capacity, inertialise=header.inertialise, foot_lock=header.foot_lock)


@singledispatch
def take_effect(effect: r.Effect, simulation: Simulation) -> None:
    """Let what was recorded take effect once more.

    Raises:
        FootworkError: for what cannot be, such as a slot that holds no character.
    """
    raise TypeError(type(effect).__name__)


@take_effect.register
def _(effect: r.Spawned, simulation: Simulation) -> None:
    place = (effect.x, effect.z, effect.yaw)
    slot = simulation.spawn(*place, effect.behaviour, node=effect.node, held=effect.held)
    if slot != effect.slot:
        raise WorldError(f"a character came into slot {slot}, expected {effect.slot}")


@take_effect.register
def _(effect: r.Commanded, simulation: Simulation) -> None:
    simulation.give(effect.slot, Command(effect.heading, effect.behaviour, effect.one_shot, effect.speed))


@take_effect.register
def _(effect: r.Corrected, simulation: Simulation) -> None:
    simulation.correct(effect.slot, effect.x, effect.z, effect.yaw)


@take_effect.register
def _(effect: r.Teleported, simulation: Simulation) -> None:
    simulation.teleport(effect.slot, effect.x, effect.z, effect.yaw)


@take_effect.register
def _(effect: r.Removed, simulation: Simulation) -> None:
    simulation.remove(effect.slot)


@take_effect.register
def _(effect: r.Restored, simulation: Simulation) -> None:
    simulation.restore(effect.blob, effect.slots)


@take_effect.register
def _(effect: r.Fought, simulation: Simulation) -> None:
    raise WorldError("a match began, where characters were steered")


@take_effect.register
def _(effect: r.Opposed, simulation: Simulation) -> None:
    if not isinstance(simulation, Arena) or len(simulation.world.slots):
        raise WorldError("opponents came, where characters were steered already")


@take_effect.register
def _(effect: r.Resimulated, simulation: Simulation) -> None:
    given = [
        (tick, slot, Command(heading, behaviour, one_shot, speed))
        for tick, slot, heading, behaviour, one_shot, speed in effect.given
    ]
    simulation.resimulate(effect.slots, effect.ticks, given)
