"""One of the bundles that a server plays: the simulation its characters live in, and what clients are told of it."""

from dataclasses import dataclass

from footwork.protocol.messages import Welcome
from footwork.protocol.spectator import Topics
from footwork.runtime.effects import Effects
from footwork.runtime.pose_messages import PoseMessages
from footwork.runtime.simulation import Simulation


@dataclass(eq=False)
class Scene:
    """A bundle under its name.

    Args:
        name: what hello calls it.
        simulation: its own; another after a reload.
        welcome: what its sessions are told on arrival, as far as it is the same for all.
        effects: how their messages take effect.
        messages: how they are told of poses.
        topics: where spectators find it.
        sessions_begun: how many there were.
        reloads: how often another bundle took its place.
    """

    name: str
    simulation: Simulation
    welcome: Welcome
    effects: Effects
    messages: PoseMessages
    topics: Topics
    sessions_begun: int = 0
    reloads: int = 0
