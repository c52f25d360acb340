"""All that a server plays: a scene for each bundle, under one bound on characters."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial

from msgspec import UNSET

from footwork.errors import InputError
from footwork.protocol import messages as m
from footwork.protocol.errors import BUNDLE, PeerError
from footwork.protocol.spectator import Topics
from footwork.runtime.arena import Arena
from footwork.runtime.effects import Effects
from footwork.runtime.greeting import welcome_of
from footwork.runtime.limits import Limits
from footwork.runtime.pose_messages import PoseMessages
from footwork.runtime.scene import Scene
from footwork.runtime.simulation import Simulation

ONLY = "bundle"
"""What the only bundle is called, unless it was given a name."""
MOST_BUNDLES = 256
_NAME = re.compile(r"[A-Za-z0-9._-]{1,64}")


def require_names(names: Iterable[str]) -> None:
    """Make sure that bundles can be called so, over the wire, in topics and in names of files.

    Raises:
        InputError: for no name or too many, and for one that cannot be a name.
    """
    names = list(names)
    if not 0 < len(names) <= MOST_BUNDLES:
        raise InputError(f"{len(names)} bundles, expected 1 to {MOST_BUNDLES}", "bundles")
    for name in names:
        if not is_name(name):
            raise InputError(f"name {name!r}, expected up to 64 letters, digits, '.', '_' and '-'", "bundles")


def is_name(text: str) -> bool:
    """Whether a bundle can be called so."""
    return _NAME.fullmatch(text) is not None


class Scenes:
    """Scenes by name.

    Args:
        simulations: of each bundle by its name; or the only one.
        frame_rate: shown frames a second.
        limits: how much clients may ask for, in all scenes together.
        lockstep: whether ticks are made when clients ask for them.
        make_room: called where there are enough characters, so that some may leave that nobody needs.

    Attributes:
        first: that of a client which names none.

    Raises:
        LocalError: for a bundle or a name that the wire cannot hold.
    """

    def __init__(
        self,
        simulations: Simulation | Mapping[str, Simulation],
        frame_rate: int,
        limits: Limits,
        *,
        lockstep: bool,
        make_room: Callable[[], object],
    ) -> None:
        named = simulations if isinstance(simulations, Mapping) else {ONLY: simulations}
        self._names = tuple(named)
        self._frame_rate, self._limits, self._lockstep = frame_rate, limits, lockstep
        self._make_room = make_room
        self._by_name = {name: self._scene(name, simulation) for name, simulation in named.items()}
        self.first = self._by_name[self._names[0]]

    def _scene(self, name: str, simulation: Simulation) -> Scene:
        topics = Topics("" if name == self._names[0] else name)
        welcome, messages = self.welcome_for(name, simulation), PoseMessages(simulation.shown)
        return Scene(name, simulation, welcome, self._effects_on(simulation), messages, topics)

    def _effects_on(self, simulation: Simulation) -> Effects:
        return Effects(simulation, self._limits, partial(self._find_room, simulation))

    def welcome_for(self, name: str, simulation: Simulation) -> m.Welcome:
        """What the sessions of a bundle are told on arrival.

        Raises:
            LocalError: for a bundle or a name that the wire cannot hold.
        """
        return welcome_of(
            simulation.bundle,
            simulation.behaviours,
            simulation.speeds,
            self._frame_rate,
            self._limits,
            lockstep=self._lockstep,
            opponent=simulation.opponent.name if isinstance(simulation, Arena) else UNSET,
            bundle=name,
            bundles=self._names,
        )

    def __iter__(self) -> Iterator[Scene]:
        return iter(self._by_name.values())

    def __getitem__(self, name: str) -> Scene:
        return self._by_name[name]

    def chosen(self, name: str) -> Scene:
        """The scene that a client asks for, by no name the first.

        Raises:
            PeerError: ``bundle``, for a name that no scene has.
        """
        scene = self._by_name.get(name) if name else self.first
        if scene is None:
            raise PeerError(BUNDLE, f"no bundle {name!r}, expected one of {', '.join(self._names)}", 0, self._names)
        return scene

    def playing(self, simulation: Simulation) -> Scene:
        """The scene of a simulation."""
        return next(scene for scene in self if scene.simulation is simulation)

    def put(self, scene: Scene, latter: Simulation, welcome: m.Welcome) -> None:
        """Let another simulation take the place of a scene's."""
        scene.simulation, scene.welcome, scene.effects = latter, welcome, self._effects_on(latter)
        scene.messages = PoseMessages(latter.shown)
        scene.reloads += 1

    @property
    def character_count(self) -> int:
        """How many characters there are in all."""
        return sum(len(scene.simulation.world.slots) for scene in self)

    def _find_room(self, simulation: Simulation) -> bool:
        """Whether there is room for another character, if need be in place of some that wait for their client."""
        if self._crowded(simulation):
            self._make_room()
        return not self._crowded(simulation)

    def _crowded(self, simulation: Simulation) -> bool:
        return simulation.full or self.character_count + simulation.company > self._limits.characters
