"""Chains: stretches of motion laid end to end, the captured clips first and then the interpolated segments.

A chain's *frames* are nodes of a graph. An interpolated chain has rows besides, before its first frame and after its
last: context that the metric's windows look at, but that is never played.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.arrays import frozen
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.motion.skeleton import Skeleton
from footwork.motion.window import RADIUS
from footwork.training.nodes import Nodes, nodes_of

# The row past an interpolated segment's end is compared with others, and its window reaches RADIUS rows further.
CONTEXT = RADIUS + 1
NO_SEGMENT = -1
NO_CHAIN = -1

_KINDS = {
    "length": np.int32,
    "context": np.int32,
    "places": np.float64,
    "first": np.int32,
    "second": np.int32,
    "chain_weight": np.float64,
    "clip": np.int32,
    "frame": np.int32,
    "other_clip": np.int32,
    "other_frame": np.int32,
    "label": np.int16,
    "behaviour": np.int16,
    "contacts": np.bool_,
}


@dataclass(frozen=True, eq=False)
class Chains:
    """C chains laid end to end: N nodes (frames) and M rows (frames and context), all arrays read-only.

    Nodes are numbered chain by chain, so that the captured frames are nodes 0..original_count-1 in the order of
    ``nodes_of``. A window of a row is the rows round it, held at the ends of its chain.

    Args:
        skeleton: the body that all chains share.
        clips: names of the source clips.
        labels: the words that frames are labelled with.
        behaviours: the behaviours that commands may ask for.
        length: frames of each chain.  # (C,)
        context: rows before and also after a chain's frames: 0 for clips, CONTEXT for interpolated ones.  # (C,)
        places: world places of all joints of every row, metres.  # (M, J, 3)
        first: number of the first source's segment, NO_SEGMENT for clips.  # (C,)
        second: number of the second source's segment, above the first's; NO_SEGMENT for clips.  # (C,)
        chain_weight: share of the first source, 1 for clips.  # (C,)
        clip: first source clip of each node.  # (N,)
        frame: its nearest frame.  # (N,)
        other_clip: second source clip of each node, ``clip`` for captured frames.  # (N,)
        other_frame: its nearest frame, ``frame`` for captured frames.  # (N,)
        label: index into ``labels``, that of the heavier source.  # (N,)
        behaviour: index into ``behaviours`` or -1, that of the heavier source.  # (N,)
        contacts: which feet stand on the ground.  # (N, feet)
    """

    skeleton: Skeleton
    clips: tuple[str, ...]
    labels: tuple[str, ...]
    behaviours: tuple[str, ...]
    length: NDArray[np.int32]
    context: NDArray[np.int32]
    places: NDArray[np.float64]
    first: NDArray[np.int32]
    second: NDArray[np.int32]
    chain_weight: NDArray[np.float64]
    clip: NDArray[np.int32]
    frame: NDArray[np.int32]
    other_clip: NDArray[np.int32]
    other_frame: NDArray[np.int32]
    label: NDArray[np.int16]
    behaviour: NDArray[np.int16]
    contacts: NDArray[np.bool_]

    def __post_init__(self) -> None:
        for name, kind in _KINDS.items():
            object.__setattr__(self, name, frozen(getattr(self, name), kind))

    @property
    def chain_count(self) -> int:
        """The number of chains C."""
        return len(self.length)

    @property
    def node_count(self) -> int:
        """The number of nodes N."""
        return len(self.clip)

    @property
    def row_count(self) -> int:
        """The number of rows M."""
        return len(self.places)

    @cached_property
    def original_count(self) -> int:
        """How many nodes are captured frames: nodes 0..original_count-1."""
        return int(self.length[self.first == NO_SEGMENT].sum())

    @cached_property
    def first_row(self) -> NDArray[np.intp]:
        """First row of each chain, context included.  # (C,)"""
        return _starts(self.length + 2 * self.context)

    @cached_property
    def first_node(self) -> NDArray[np.intp]:
        """First node of each chain.  # (C,)"""
        return _starts(self.length)

    @cached_property
    def last_node(self) -> NDArray[np.intp]:
        """Last node of each chain.  # (C,)"""
        return frozen(self.first_node + self.length - 1, np.intp)

    @cached_property
    def chain_of_node(self) -> NDArray[np.intp]:
        """The chain that each node lies in.  # (N,)"""
        return frozen(np.repeat(np.arange(self.chain_count), self.length), np.intp)

    @cached_property
    def row_of_node(self) -> NDArray[np.intp]:
        """The row of each node.  # (N,)"""
        return frozen(np.arange(self.node_count) + np.repeat(self._rows_ahead, self.length), np.intp)

    @cached_property
    def weight(self) -> NDArray[np.float64]:
        """Share of the first source of each node, 1 for captured frames.  # (N,)"""
        return frozen(np.repeat(self.chain_weight, self.length), np.float64)

    @cached_property
    def followers(self) -> NDArray[np.intp]:
        """The chain of the next segments of both sources at the same weight, NO_CHAIN where there is none.  # (C,)"""
        levels, level = np.unique(self.chain_weight, return_inverse=True)
        segments = int(max(self.first.max(), self.second.max())) + 3
        keys = ((self.first + 1).astype(np.int64) * segments + self.second + 1) * len(levels) + level
        nexts = keys + (segments + 1) * len(levels)
        order = np.argsort(keys, kind="stable")
        place = np.searchsorted(keys, nexts, sorter=order)
        at = order[np.minimum(place, len(order) - 1)]
        start, after = self.first_node, self.first_node[at]
        joined = (keys[at] == nexts) & (self.first != NO_SEGMENT)
        joined &= (self.clip[start] == self.clip[after]) & (self.other_clip[start] == self.other_clip[after])
        return frozen(np.where(joined, at, NO_CHAIN), np.intp)

    @property
    def _rows_ahead(self) -> NDArray[np.intp]:
        """How many more rows than nodes lie before the frames of each chain.  # (C,)"""
        return self.first_row + self.context - self.first_node


def _starts(counts: NDArray) -> NDArray[np.intp]:
    return frozen(np.cumsum(counts) - counts, np.intp)


def chains_of_clips(clips: Sequence[Clip], behaviours: tuple[str, ...]) -> Chains:
    """The clips alone as chains.

    Raises:
        InputError: as ``nodes_of``.
    """
    nodes = nodes_of(clips, behaviours)
    return Chains(**chain_parts(nodes, clips))


def chain_parts(nodes: Nodes, clips: Sequence[Clip]) -> dict[str, Any]:
    """The fields of ``Chains`` for the clips alone, by name."""
    count, arrays = len(clips), nodes.arrays
    return {
        "skeleton": nodes.skeleton,
        "clips": nodes.clips,
        "labels": nodes.labels,
        "behaviours": nodes.behaviours,
        "length": np.array(nodes.lengths),
        "context": np.zeros(count),
        "places": np.concatenate([clip_places(clip)[0] for clip in clips]),
        "first": np.full(count, NO_SEGMENT),
        "second": np.full(count, NO_SEGMENT),
        "chain_weight": np.ones(count),
        "other_clip": arrays["clip"],
        "other_frame": arrays["frame"],
    } | {name: arrays[name] for name in ("clip", "frame", "label", "behaviour", "contacts")}
