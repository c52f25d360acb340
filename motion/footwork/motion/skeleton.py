"""A tree of joints at rest, with the mass of each joint's segment and which joints are feet."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_range, require_shape


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Joint names, tree, rest offsets and segment masses.

    Parents come before their children and joint 0 is the only root. A joint's segment runs from the joint to
    its child, or to its end site where it has no child.

    Args:
        names: one name a joint, all different.  # (J,)
        parents: index of each joint's parent, -1 for the root.  # (J,)
        offsets: place of each joint in its parent's frame at rest, metres.  # (J, 3)
        ends: place of the tip of a leaf's segment in the joint's frame, metres, zero for none.  # (J, 3)
        masses: mass of each joint's segment, kilograms, zero where unknown.  # (J,)
        feet: for each foot the indices of its ankle and of the ball of the foot.  # (feet, 2)
        where: the file it came from, for messages.

    Raises:
        InputError: for a wrong shape, two roots, a cycle, repeated names or numbers that are not finite.
    """

    names: tuple[str, ...]
    parents: NDArray[np.int32]
    offsets: NDArray[np.float64]
    ends: NDArray[np.float64] = field(default=None)  # type: ignore[assignment]
    masses: NDArray[np.float64] = field(default=None)  # type: ignore[assignment]
    feet: NDArray[np.int32] = field(default=None)  # type: ignore[assignment]
    where: str = "skeleton"

    def __post_init__(self) -> None:
        joints = len(self.names)
        fill = {"ends": np.zeros((joints, 3)), "masses": np.zeros(joints), "feet": np.zeros((0, 2))}
        kinds = {"parents": np.int32, "offsets": np.float64, "ends": np.float64, "masses": np.float64, "feet": np.int32}
        for name, kind in kinds.items():
            value = getattr(self, name)
            object.__setattr__(self, name, frozen(fill[name] if value is None else value, kind))
        object.__setattr__(self, "names", tuple(self.names))
        self._check()

    def _check(self) -> None:
        joints = len(self.names)
        if joints == 0:
            raise InputError("a skeleton needs at least one joint", self.where)
        shapes = {
            "parents": (joints,),
            "offsets": (joints, 3),
            "ends": (joints, 3),
            "masses": (joints,),
            "feet": (None, 2),
        }
        for name, shape in shapes.items():
            require_shape(getattr(self, name), shape, name, self.where)
            require_finite(getattr(self, name), name, self.where)
        require_range(self.feet, 0, joints, "feet", self.where)
        if len(set(self.names)) != joints:
            repeated = next(name for name in self.names if self.names.count(name) > 1)
            raise InputError(f"joint name {repeated!r} is used twice", self.where)
        if (self.masses < 0).any():
            raise InputError("masses holds a negative number, expected zero or more", self.where)
        self._check_tree()

    def _check_tree(self) -> None:
        roots = [name for name, parent in zip(self.names, self.parents, strict=True) if parent < 0]
        if len(roots) != 1:
            raise InputError(f"{len(roots)} roots ({', '.join(roots)}), expected exactly one", self.where)
        late = np.flatnonzero(self.parents >= np.arange(len(self.names)))
        if self.parents[0] >= 0 or late.size:
            name = self.names[late[0] if late.size else 0]
            raise InputError(f"joint {name!r} comes before its parent or lies on a cycle", self.where)

    @property
    def joint_count(self) -> int:
        """The number of joints J."""
        return len(self.names)

    def index(self, name: str) -> int:
        """The index of the joint called ``name``.

        Raises:
            InputError: for a name that is not there, listing those that are.
        """
        try:
            return self.names.index(name)
        except ValueError:
            raise InputError(f"no joint {name!r}, it has {', '.join(self.names)}", self.where) from None

    def indices(self, names: Sequence[str]) -> NDArray[np.intp]:
        """The indices of several joints, in the order asked for."""
        return np.array([self.index(name) for name in names], dtype=np.intp)

    def children(self, joint: int) -> list[int]:
        """The indices of a joint's children."""
        return [int(child) for child in np.flatnonzero(self.parents == joint)]
