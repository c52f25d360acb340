"""The bundle: what training makes and the runtime loads, in one file that carries its own digest."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import tensor_file
from footwork.motion.annotation import Annotation
from footwork.motion.bundle_states import (
    AboutShadowing,
    about_states,
    arrays_of_states,
    read_annotation,
    read_shadowing,
    take,
)
from footwork.motion.coded_values import CodedValues
from footwork.motion.graph import ARRAYS, MotionGraph
from footwork.motion.player_model import PlayerModel, TraceFile
from footwork.motion.shadowing_table import ShadowingTable
from footwork.motion.skeleton import Skeleton
from footwork.motion.state_machine import State
from footwork.motion.strikes import Strikes
from footwork.motion.table import SHORTLIST_KINDS, PolicyTable
from footwork.motion.task import SteeringTask

VERSION = 3
_BODY_ARRAYS = {
    "parents": np.int32,
    "offsets": np.float64,
    "ends": np.float64,
    "masses": np.float64,
    "feet": np.int32,
}
_STRIKE_ARRAYS = {"node": np.int32, "limb": np.int16, "speed": np.float32}
_CODED = {"codes": (np.float32, np.uint16), "low": np.float32, "step": np.float32}


@dataclass(frozen=True, eq=False)
class Bundle:
    """A motion graph, the policies over it, and where they came from.

    Args:
        graph: the motion graph, strongly connected, so that there is always a next frame.
        tables: policies by name, such as "steering".
        provenance: JSON-able: source files with their digests, options, versions, counts before and after.
        attribution: what the licences of the sources ask to have shown, a line each.
        digest: SHA-256 of the file, empty before it is sealed.
        annotation: states, segments and quickest ways of a state-annotated graph, None for any other.
        shadowing: what to do before an opponent in the state of the annotation that is shadowing, None without one.
        strikes: where attacks of a state-annotated graph reach their target, None where it has no attacks.

    Raises:
        InputError: for a graph with no nodes or with a node that leads nowhere, for a table of other nodes or
            behaviours than the graph's, for an annotation or strikes of another graph, and for shadowing of other
            segments than the annotation's.
    """

    graph: MotionGraph
    tables: Mapping[str, PolicyTable]
    provenance: Mapping[str, Any] = field(default_factory=dict)
    attribution: tuple[str, ...] = ()
    digest: str = ""
    annotation: Annotation | None = None
    strikes: Strikes | None = None
    shadowing: ShadowingTable | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "attribution", tuple(self.attribution))
        self._check_graph()
        for table in self.tables.values():
            self._check_table(table)
        if self.annotation is not None:
            self.annotation.require_fits(self.graph)
        if self.shadowing is not None:
            self._check_shadowing(self.shadowing)
        if self.strikes is not None:
            self.strikes.require_fits(self.graph)

    def _check_graph(self) -> None:
        graph = self.graph
        if graph.node_count == 0:
            raise InputError("no nodes, expected at least one", graph.where)
        graph.require_no_dead_ends()

    def _check_table(self, table: PolicyTable) -> None:
        graph = self.graph
        if len(table.coded.codes) != graph.node_count:
            problem = f"{len(table.coded.codes)} rows, expected one for each of {graph.node_count} nodes"
            raise InputError(problem, table.where)
        if table.task.behaviours != graph.behaviours:
            problem = f"behaviours {', '.join(table.task.behaviours)}, the graph has {', '.join(graph.behaviours)}"
            raise InputError(problem, table.where)
        actions = len(table.task.turn_levels) * np.diff(graph.edge_start)
        if table.shortlist.size and (table.shortlist.max(axis=(1, 2)) >= actions).any():
            raise InputError("its shortlist names actions that are not there", table.where)

    def _check_shadowing(self, table: ShadowingTable) -> None:
        if self.annotation is None:
            raise InputError("shadowing without states, expected an annotated graph", table.where)
        table.require_fits(self.annotation)

    def table(self, name: str) -> PolicyTable:
        """The policy called ``name``.

        Raises:
            InputError: for a name that is not there, listing those that are.
        """
        if name not in self.tables:
            raise InputError(f"no table {name!r}, it has {', '.join(self.tables) or 'none'}", "bundle")
        return self.tables[name]


class _Table(msgspec.Struct):
    task: SteeringTask
    residual: float
    sweeps: int
    converged: bool
    learned_from: list[TraceFile] | None
    """None for a policy without a player model."""


class _Version(msgspec.Struct):
    version: int


class _About(msgspec.Struct):
    version: int
    joints: list[str]
    clips: list[str]
    labels: list[str]
    behaviours: list[str]
    tables: dict[str, _Table]
    provenance: dict[str, Any]
    attribution: list[str]
    states: list[State] | None = None
    """Of a state-annotated graph."""
    shadowing: AboutShadowing | None = None


def write_bundle(path: str | Path, bundle: Bundle) -> str:
    """Write a bundle, whole or not at all, and return its digest.

    Raises:
        InputError: for a table that is not converged, or a place that cannot be written to.
    """
    data, digest = encode_bundle(bundle)
    tensor_file.publish(Path(path), data)
    return digest


def sealed(bundle: Bundle) -> Bundle:
    """The bundle with the digest that its file has or will have."""
    return replace(bundle, digest=encode_bundle(bundle)[1])


def read_bundle(path: str | Path, *, mapped: bool = False) -> Bundle:
    """Read a bundle, its arrays as read-only views of one copy of the file, or of the file itself.

    Args:
        path: the file.
        mapped: view the file itself, mapped into memory that all processes share which map it. As long as the bundle
            is in use the file may only be replaced by renaming, as ``write_bundle`` does.

    Raises:
        InputError: for a file that is missing, cut short, changed, of a newer version, or whose parts do not fit
            together; and for a table that is not converged.
    """
    path = Path(path)
    data = tensor_file.map_bytes(path) if mapped else tensor_file.read_bytes(path)
    return decode_bundle(data, str(path))


def decode_bundle(data: tensor_file.Data, where: str) -> Bundle:
    """A bundle from the bytes of its file; errors as of ``read_bundle``."""
    arrays, text, digest = tensor_file.unseal(data, where)
    version = tensor_file.decode_about(text, _Version, where).version
    if version != VERSION:
        age = "newer" if version > VERSION else "older"
        raise InputError(f"a bundle of the {age} version {version}, expected version {VERSION}", where)
    about = tensor_file.decode_about(text, _About, where)
    tables = {name: _table(table, arrays, name, where) for name, table in about.tables.items()}
    graph = _graph(about, arrays, where)
    annotation = None if about.states is None else read_annotation(about.states, arrays, where)
    strikes = _strikes(arrays, where) if "strikes.node" in arrays else None
    shadowing = None if about.shadowing is None else read_shadowing(about.shadowing, arrays, where)
    return Bundle(graph, tables, about.provenance, tuple(about.attribution), digest, annotation, strikes, shadowing)


def encode_bundle(bundle: Bundle) -> tuple[bytes, str]:
    """The bytes of a bundle's file and its digest; errors as of ``write_bundle``."""
    graph = bundle.graph
    arrays = {f"graph.{name}": getattr(graph, name) for name in ARRAYS}
    arrays |= {f"skeleton.{name}": getattr(graph.skeleton, name) for name in _BODY_ARRAYS}
    for name, table in bundle.tables.items():
        arrays |= _table_arrays(name, table.require_converged())
    arrays |= arrays_of_states(bundle.annotation, bundle.shadowing)
    if bundle.strikes is not None:
        arrays |= {f"strikes.{name}": getattr(bundle.strikes, name) for name in _STRIKE_ARRAYS}
    about = {
        "version": VERSION,
        "joints": graph.skeleton.names,
        "clips": graph.clips,
        "labels": graph.labels,
        "behaviours": graph.behaviours,
        "tables": {name: _about_table(table) for name, table in bundle.tables.items()},
        "provenance": bundle.provenance,
        "attribution": bundle.attribution,
    } | about_states(bundle.annotation, bundle.shadowing)
    return tensor_file.seal(arrays, about)


def _table_arrays(name: str, table: PolicyTable) -> dict[str, NDArray]:
    player = {} if table.player is None else {f"player.{name}": table.player.change}
    parts = table.coded._asdict() | ({"shortlist": table.shortlist} if table.shortlist.size else {})
    return {f"table.{name}.{part}": array for part, array in parts.items()} | player


def _about_table(table: PolicyTable) -> _Table:
    learned_from = None if table.player is None else list(table.player.learned_from)
    return _Table(table.task, table.residual, table.sweeps, table.converged, learned_from)


def _table(about: _Table, arrays: Mapping[str, NDArray], name: str, where: str) -> PolicyTable:
    coded = CodedValues(*(take(arrays, f"table.{name}.{part}", kind, where) for part, kind in _CODED.items()))
    listed = {}
    if f"table.{name}.shortlist" in arrays:
        listed["shortlist"] = take(arrays, f"table.{name}.shortlist", SHORTLIST_KINDS, where)
    if not math.isfinite(about.residual):
        raise InputError(f"table {name!r} has a residual of {about.residual}, expected a finite number", where)
    return PolicyTable(
        about.task,
        coded,
        about.residual,
        about.sweeps,
        about.converged,
        _player(about, arrays, name, where),
        **listed,
        where=f"{where}: table {name!r}",
    ).require_converged()


def _player(about: _Table, arrays: Mapping[str, NDArray], name: str, where: str) -> PlayerModel | None:
    if about.learned_from is None:
        return None
    change = take(arrays, f"player.{name}", np.float64, where)
    return PlayerModel(about.task.behaviours, change, tuple(about.learned_from), f"{where}: player of table {name!r}")


def _graph(about: _About, arrays: Mapping[str, NDArray], where: str) -> MotionGraph:
    body = {name: take(arrays, f"skeleton.{name}", kind, where) for name, kind in _BODY_ARRAYS.items()}
    graph = {name: take(arrays, f"graph.{name}", kind, where) for name, kind in ARRAYS.items()}
    return MotionGraph(
        skeleton=Skeleton(names=tuple(about.joints), where=f"{where}: skeleton", **body),
        clips=tuple(about.clips),
        labels=tuple(about.labels),
        behaviours=tuple(about.behaviours),
        where=f"{where}: graph",
        **graph,
    )


def _strikes(arrays: Mapping[str, NDArray], where: str) -> Strikes:
    read = (take(arrays, f"strikes.{name}", kind, where) for name, kind in _STRIKE_ARRAYS.items())
    return Strikes(*read, where=f"{where}: strikes")
