"""What a recipe for a motion graph gives: the graph that can be walked without end, and what it was cut from."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from footwork.motion.annotation import Annotation
from footwork.motion.graph import MotionGraph


@dataclass(frozen=True, eq=False)
class Built:
    """A motion graph and the size of the whole that it is the largest strongly connected part of.

    Args:
        graph: the part that can be walked without end.
        frames: captured frames that went in.
        nodes: of the whole graph.
        edges: of the whole graph.
        measured: JSON-able: what else is worth knowing of how it was built.
        annotation: of a state-annotated graph, None for any other.
    """

    graph: MotionGraph
    frames: int
    nodes: int
    edges: int
    measured: Mapping[str, Any] = field(default_factory=dict)
    annotation: Annotation | None = None

    @property
    def connected_frames(self) -> int:
        """Captured frames in the graph."""
        return int(self.graph.original.sum())
