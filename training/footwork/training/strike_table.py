"""Tables of strikes: where attacks reach their target, by hand, in place of what is detected.

CSV with a header line and the columns ``clip``, ``frame`` (at 30 Hz, from 0, as the report of a build tells them) and
``limb``. The rows of a clip are all the strikes of that clip, and of its mirrored twin with the other side's limbs.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from footwork.errors import InputError
from footwork.motion.annotation import Annotation
from footwork.motion.fighting_points import LIMBS
from footwork.motion.frame_tables import csv_rows
from footwork.motion.graph import MotionGraph
from footwork.motion.mirror import MIRRORED
from footwork.motion.strikes import Strikes
from footwork.motion.textfile import whole_number
from footwork.training.strike_detection import detected_strikes, speeds_at

ATTACK = "attack"
"""The state whose stretches hold strikes."""
COLUMNS = ("clip", "frame", "limb")


@dataclass(frozen=True)
class StrikeRow:
    """A strike as a person names it.

    Args:
        clip: name of the clip.
        frame: of first contact, at 30 Hz.
        limb: one of LIMBS.
        where: file and line, for messages.
    """

    clip: str
    frame: int
    limb: str
    where: str

    @property
    def mirrored(self) -> "StrikeRow":
        """The same in the clip's mirrored twin."""
        side, part = self.limb.split("_")
        return replace(self, clip=self.clip + MIRRORED, limb=f"{'right' if side == 'left' else 'left'}_{part}")


def read_strikes(path: str | Path) -> list[StrikeRow]:
    """The rows of a table of strikes.

    Raises:
        InputError: naming the line, for text that is not UTF-8, missing columns, and what is no frame or limb.
    """
    table = csv_rows(path)
    line, header = next(table, (1, []))
    if sorted(header) != sorted(COLUMNS):
        raise InputError(f"columns {', '.join(header) or 'none'}; expected {', '.join(COLUMNS)}", f"{path}:{line}")
    return [_row(header, cells, f"{path}:{line}") for line, cells in table]


def _row(header: list[str], cells: list[str], where: str) -> StrikeRow:
    if len(cells) != len(header):
        raise InputError(f"{len(cells)} cells, but the header has {len(header)}", where)
    values = dict(zip(header, cells, strict=True))
    if values["limb"] not in LIMBS:
        raise InputError(f"limb {values['limb']!r}, expected {', '.join(LIMBS)}", where)
    return StrikeRow(values["clip"], whole_number(values["frame"], where), values["limb"], where)


def strikes_of(graph: MotionGraph, annotation: Annotation | None, rows: Sequence[StrikeRow] = ()) -> Strikes | None:
    """The strikes of a graph: those named, and those detected in the clips that have none named.

    None for a graph without a state called ATTACK.

    Raises:
        InputError: for rows of a clip or a frame that is not in the graph or of another state, for two of one frame,
            and for rows where there are no attacks.
    """
    if annotation is None or ATTACK not in annotation.machine.names:
        if rows:
            raise InputError(f"a strike, but there is no state {ATTACK!r}", rows[0].where)
        return None
    state = annotation.machine.names.index(ATTACK)
    detected = detected_strikes(graph, annotation, state)
    if not rows:
        return detected
    rows = [*rows, *(row.mirrored for row in rows if row.clip + MIRRORED in graph.clips)]
    node = np.array([_node_of(row, graph, annotation, state) for row in rows])
    limb = np.array([LIMBS.index(row.limb) for row in rows])
    kept = ~np.isin(graph.clip[detected.node], [graph.clips.index(row.clip) for row in rows])
    speed = np.append(detected.speed[kept], speeds_at(graph, node, limb))
    node, limb = np.append(detected.node[kept], node), np.append(detected.limb[kept], limb)
    order = np.argsort(node, kind="stable")
    return Strikes(node[order], limb[order], speed[order], rows[0].where)


def _node_of(row: StrikeRow, graph: MotionGraph, annotation: Annotation, state: int) -> int:
    """The node that a row means."""
    if row.clip not in graph.clips:
        raise InputError(f"no clip {row.clip!r}, expected {', '.join(graph.clips)}", row.where)
    clip = graph.clips.index(row.clip)
    nodes = np.flatnonzero((graph.clip == clip) & (graph.frame == row.frame) & graph.original)
    nodes = nodes[annotation.state[annotation.segment[nodes]] == state]
    if not nodes.size:
        raise InputError(f"frame {row.frame} of {row.clip} is in no attack of the graph", row.where)
    return int(nodes[0])
