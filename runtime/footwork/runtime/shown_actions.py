"""What characters do, as messages tell it: the behaviour, the frame of the capture, whether its order was left."""

from collections.abc import Sequence

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.kept import Kept, keep
from footwork.runtime.pose_frames import PoseFrames
from footwork.runtime.world import World


@numba.njit(cache=True, nogil=True)
def _note(slots: NDArray, kept: Kept) -> None:
    node, natural, told, behaviour, clip, source_frame, transition = kept.parts
    for who in slots:
        here = node[who]
        behaviour[who], clip[who], source_frame[who] = told[here, 0], told[here, 1], told[here, 2]
        transition[who] = not natural[who]


class ShownActions:
    """What the characters of a world do, by slot; rows of slots that hold none mean nothing.

    Args:
        world: where they are.
        behaviours: by which ``behaviour`` is numbered.

    Attributes:
        behaviour: index into ``behaviours``, -1 for none of them.  # (capacity,) int32
        clip: the source clip of the greater weight, an index into the graph's clips.  # (capacity,) int32
        source_frame: frame of that clip.  # (capacity,) int32
        transition: whether the last move left the captured order.  # (capacity,) bool
    """

    def __init__(self, world: World, behaviours: Sequence[str]) -> None:
        graph, none = world.graph, np.zeros(world.capacity, dtype=np.int32)
        self.behaviour, self.clip, self.source_frame = none, none.copy(), none.copy()
        self.transition = np.zeros(world.capacity, dtype=np.bool_)
        numbers = [behaviours.index(name) if name in behaviours else -1 for name in graph.behaviours]
        number = np.array([*numbers, -1])[graph.behaviour]  # of a frame of none, -1, the last
        told = np.stack([number, *graph.nearest_source], axis=1).astype(np.int32)
        shown = self.behaviour, self.clip, self.source_frame, self.transition
        self._world, self._kept = world, keep((world.node, world.natural, told, *shown))
        self._noted = False
        self.note()  # compiles what it calls, or loads it from the cache
        self.forget()

    @property
    def frames(self) -> PoseFrames:
        """These together with what the world shows."""
        root, rotations = self._world.show(1.0)
        return PoseFrames(
            root=root,
            rotations=rotations,
            facing=self._world.place[:, 2],
            behaviour=self.behaviour,
            clip=self.clip,
            source_frame=self.source_frame,
            transition=self.transition,
        )

    def forget(self) -> None:
        """Look anew for what characters do, which is the same in all frames of a tick, once it is asked for."""
        self._noted = False

    def note(self) -> None:
        """Write what all characters do after the tick last made, unless it was written since ``forget``."""
        if not self._noted:
            _note(self._world.slots, self._kept)
            self._noted = True
