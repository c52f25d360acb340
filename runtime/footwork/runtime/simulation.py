"""The one place where commands and the world meet: orders -> controller -> World.step -> pose frames.

No socket, no session, no clock: the server drives it tick by tick, and so does whatever runs without one.
"""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.bundle_controller import bundle_controller
from footwork.controllers.command import NONE, Command, Vocabulary
from footwork.controllers.controller import Controller, one_shots_of, speeds_of
from footwork.controllers.orders import Orders
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.runtime import recording as r
from footwork.runtime.characters import Motion
from footwork.runtime.pose_frames import PoseFrames
from footwork.runtime.recorder import Recorder, state_digest
from footwork.runtime.schedule import NOTHING, require_within, rows_of, schedule_of
from footwork.runtime.shown_actions import ShownActions
from footwork.runtime.snapshot import Snapshots
from footwork.runtime.ticks import ticks_of
from footwork.runtime.warm import warm_kernels
from footwork.runtime.world import World

_IDLE = "stop"
LONGEST_PLAY = r.LONGEST_GAP - r.STATE_TICKS
"""Ticks that may be made at once while a recording is made."""


class Simulation:
    """Characters that are steered by commands through one bundle.

    Args:
        bundle: the graph and its "steering" table.
        capacity: how many characters there is room for.
        inertialise: whether transitions are smoothed.
        foot_lock: whether feet that stand stay where they are shown.
        controller: what chooses moves, on the bundle's graph or on one of its own; the bundle's own where not
            given (``bundle_controller``).
        motion: ``World.motion`` of another simulation of the same bundle, to be shared; made anew where not given.

    Attributes:
        tick: the tick last made, from 0.
        behaviours: what commands may ask for: those that some frame shows.
        speeds: the slowest and the fastest that they may ask of each behaviour that takes a speed, m/s.
        vocabulary: reads commands.
        orders: those in force.
        shown: what ``show`` returns.

    Raises:
        InputError: for a bundle without a converged steering table or without a frame of any behaviour.
    """

    def __init__(
        self,
        bundle: Bundle,
        capacity: int,
        *,
        inertialise: bool = True,
        foot_lock: bool = True,
        controller: Controller | None = None,
        motion: Motion | None = None,
    ) -> None:
        self._controller: Controller = controller or bundle_controller(bundle)
        graph = self._controller.graph
        self.bundle = bundle
        self.tick = 0
        self.world = World(graph, capacity, inertialise=inertialise, foot_lock=foot_lock, motion=motion)
        self.behaviours = self._controller.present
        if not self.behaviours:
            raise InputError("no frame shows any behaviour, expected at least one", graph.where)
        self._idle = _IDLE if _IDLE in self.behaviours else self.behaviours[0]
        self.speeds = speeds_of(self._controller)
        self._one_shot = one_shots_of(self._controller)
        rest = self._idle if bundle.annotation is not None else ""
        self.vocabulary = Vocabulary(graph.behaviours, self.behaviours, self.speeds, one_shot=self._one_shot, rest=rest)
        self.orders = Orders(capacity)
        self._start = {name: self._controller.start_node(name) for name in self.behaviours}
        self._actions = ShownActions(self.world, self.behaviours)
        self.shown = self._actions.frames
        self._nothing_shown = self._no_poses(1, 0, 0)
        warm_kernels(self._controller)
        self._ticks = ticks_of(self._controller, self.world, self.orders)
        belongs_to = f"{bundle.digest} {type(self._controller).__name__}"
        memory, sound = self._controller.memory(capacity), getattr(self._controller, "sound", None)
        self._snapshots = Snapshots(self.world, self.orders, memory, belongs_to, sound)
        self._recorder: Recorder | None = None

    @property
    def full(self) -> bool:
        """Whether there is no room for another character."""
        return len(self.world.slots) == self.world.capacity

    @property
    def company(self) -> int:
        """How many characters come with a spawn."""
        return 1

    def spawn(self, x: float, z: float, yaw: float, behaviour: str = "", *, node: int = -1, held: int = NONE) -> int:
        """Put a character into the world, doing ``behaviour`` or else standing; returns its slot.

        It begins at ``node``, if one is given, else where its behaviour does; ``held``: see ``Orders.begin``.

        Raises:
            UnknownBehaviour: for a behaviour that the bundle lacks.
            WorldFull: where there is no room.
        """
        if behaviour:
            self.vocabulary.index(behaviour)
        start = behaviour or self._idle
        slot = self.world.spawn(self._start[start] if node < 0 else node, x, z, yaw)
        self._controller.begin(slot)
        self._actions.forget()
        self.orders.begin(slot, yaw, self.vocabulary.index(self._idle if start in self._one_shot else start), held)
        self._record(r.Spawned, slot, float(x), float(z), float(yaw), behaviour, node, held)
        return slot

    def remove(self, slot: int) -> None:
        """Take a character out of the world."""
        self.world.remove(slot)
        self._record(r.Removed, slot)

    def correct(self, slot: int, x: float, z: float, yaw: float) -> None:
        """Move a character's root, metres and radians; its motion goes on from there."""
        self.world.correct(slot, x, z, yaw)
        self._record(r.Corrected, slot, float(x), float(z), float(yaw))

    def teleport(self, slot: int, x: float, z: float, yaw: float) -> None:
        """Put a character elsewhere, metres and radians; no offset and no foot lock goes along."""
        self.world.teleport(slot, x, z, yaw)
        self._record(r.Teleported, slot, float(x), float(z), float(yaw))

    def give(self, slot: int, command: Command) -> None:
        """Put a command into force, from the next tick on.

        Raises:
            NoSuchCharacter: for a slot that holds none.
            UnknownBehaviour: for a behaviour that the bundle lacks.
            InputError: for a heading that is not finite, or a speed that is below 0 or not finite.
        """
        self.world.require(slot)
        self.vocabulary.require(command)
        shown = self.world.graph.behaviour[self.world.node[slot]]
        self.orders.give(slot, command, int(shown))
        self._record(r.Commanded, slot, float(command.heading), command.behaviour, command.one_shot, command.speed)

    def stand(self, slot: int) -> None:
        """Let a character stop where it is, as far as the bundle lets it."""
        self.give(slot, self.vocabulary.outright(self.world.place[slot, 2].item(), self._idle))

    def lasting(self, slot: int) -> tuple[float, str, float | None]:
        """What a character is asked for until told otherwise: heading, radians, behaviour, and speed, m/s, if any."""
        given = self.orders.in_force
        speed = None if np.isnan(given.speed[slot]) else given.speed[slot].item()
        return given.heading[slot].item(), self.world.graph.behaviours[given.lasting[slot]], speed

    def step(self) -> None:
        """Make one tick: choose a move for every character and make it."""
        self._make(self._nothing_shown)

    def play(self, ticks: int, frames: int) -> NDArray[np.float32]:
        """Make ticks without a change of commands, and return the poses of all characters in them.

        Args:
            ticks: how many.
            frames: how many moments of each tick are shown, evenly, the last being its own.

        Returns:
            Place of joint 0, then local rotations joint by joint, of the characters by rising slot.
            # (ticks, frames, characters, 3 + 4 J)

        Raises:
            InputError: for more ticks than LONGEST_PLAY while a recording is made.
        """
        if self._recorder is not None and ticks > LONGEST_PLAY:
            raise InputError(f"{ticks} ticks, expected at most {LONGEST_PLAY} at once while recording", "play")
        poses = self._no_poses(ticks, frames, len(self.world.slots))
        self._make(poses)
        return poses

    def _make(self, poses: NDArray[np.float32]) -> None:
        self._actions.forget()
        self._ticks.make(self.world.slots, NOTHING, poses)
        self.tick += len(poses)
        if self._recorder is not None and self.tick - self._recorder.state_tick >= r.STATE_TICKS:
            self._record_state(self._recorder)

    def snapshot(self, slots: Sequence[int]) -> bytes:
        """All that is remembered of some characters, as a blob that ``restore`` takes.

        Raises:
            NoSuchCharacter: for a slot that holds none.
        """
        return self._snapshots.take(self._rows(slots), self.tick)

    def restore(self, blob: bytes, slots: Sequence[int]) -> int:
        """Put the characters of a blob into as many slots that hold some, in place of those.

        They go on from there as they did before; all others stay as they are, and so does the tick.

        Returns:
            The tick after which the blob was taken.

        Raises:
            NoSuchCharacter: for a slot that holds none.
            InputError: for a blob that is damaged, of another bundle, version or number of characters, or holds what
                cannot be; nothing has changed then.
        """
        tick = self._snapshots.put(blob, self._rows(slots))
        self._actions.forget()
        self._record(r.Restored, tuple(map(int, slots)), blob)
        return tick

    def resimulate(self, slots: Sequence[int], ticks: int, given: Iterable[tuple[int, int, Command]] = ()) -> None:
        """Take some characters through ticks by themselves, as after ``restore``; the simulation's tick stays.

        Args:
            slots: which.
            ticks: how many.
            given: commands, each with the tick of these, from 0, before which it comes into force, and its slot.

        Raises:
            NoSuchCharacter: for a slot that holds none.
            UnknownBehaviour: for a command that the bundle cannot follow.
            InputError: for more ticks than LONGEST_GAP, and for a command before or after them.
        """
        given, rows = list(given), self._rows(sorted(set(slots)))
        require_within(ticks, given)
        for _, slot, command in given:
            self.world.require(slot)
            self.vocabulary.require(command)
        schedule = schedule_of(given)
        self._actions.forget()
        self._ticks.make(rows, schedule, self._no_poses(ticks, 0, len(rows)))
        if self._recorder is not None:
            self._record(r.Resimulated, tuple(map(int, slots)), ticks, rows_of(schedule))

    def digest(self) -> bytes:
        """A digest of all that is remembered of all characters.  # 16 bytes"""
        return state_digest(*self._state())

    def record(self, recorder: Recorder) -> None:
        """Tell a recorder, from when nobody is here yet, what takes effect until ``end_recording``."""
        self._recorder = recorder
        self._record_state(recorder)

    def end_recording(self) -> None:
        """End the recording, if there is one, after the tick last made."""
        if self._recorder is not None:
            self._record_state(self._recorder)
            self._recorder.end(self.tick)
            self._recorder = None

    def _record(self, kind: Callable[..., r.Effect], *fields: object) -> None:
        if self._recorder is not None:
            self._recorder.add(kind(self.tick + 1, *fields))

    def _record_state(self, recorder: Recorder) -> None:
        recorder.add_state(self.tick, *self._state())

    def _state(self) -> tuple[bytes, bytes]:
        return self.world.slots.astype("<i8").tobytes(), self._snapshots.rows(self.world.slots)

    def _rows(self, slots: Sequence[int]) -> NDArray[np.intp]:
        for slot in slots:
            self.world.require(slot)
        return np.array(slots, dtype=np.intp)

    def _no_poses(self, ticks: int, frames: int, count: int) -> NDArray[np.float32]:
        return np.empty((ticks, frames, count, 3 + 4 * self.world.graph.skeleton.joint_count), dtype=np.float32)

    @property
    def behaviour(self) -> NDArray[np.int32]:
        """What each slot's character does in this tick, an index into ``behaviours`` or -1.  # (capacity,)"""
        self._actions.note()
        return self._actions.behaviour

    @property
    def transition(self) -> NDArray[np.bool_]:
        """Whether each one's step to this tick left the captured order.  # (capacity,)"""
        self._actions.note()
        return self._actions.transition

    def show(self, fraction: float) -> PoseFrames:
        """What is shown of the tick last made at a fraction of it in (0, 1]; 1 is its own moment."""
        self.world.show(fraction)
        self._actions.note()
        return self.shown
