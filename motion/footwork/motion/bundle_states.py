"""The part of a bundle's file that a state-annotated graph has: states, segments, ways, and the shadowing table."""

import math
from collections.abc import Mapping
from typing import Any

import msgspec
import numpy as np
from numpy.typing import DTypeLike, NDArray

from footwork.errors import InputError
from footwork.motion.annotation import Annotation, NextHops
from footwork.motion.shadowing_table import ShadowingTable
from footwork.motion.shadowing_task import ShadowingTask
from footwork.motion.state_machine import State, StateMachine


class AboutShadowing(msgspec.Struct):
    """A ShadowingTable without its values."""

    task: ShadowingTask
    state: int
    residual: float
    sweeps: int
    converged: bool


def take(arrays: Mapping[str, NDArray], name: str, kinds: DTypeLike | tuple, where: str) -> NDArray:
    """The array called ``name``.

    Raises:
        InputError: where there is none, or it is of none of the kinds.
    """
    if name not in arrays:
        raise InputError(f"no array {name!r}, it has {', '.join(sorted(arrays)) or 'none'}", where)
    kinds = kinds if isinstance(kinds, tuple) else (kinds,)
    if arrays[name].dtype not in kinds:
        expected = " or ".join(str(np.dtype(kind)) for kind in kinds)
        raise InputError(f"array {name!r} holds {arrays[name].dtype}, expected {expected}", where)
    return arrays[name]


def arrays_of_states(annotation: Annotation | None, shadowing: ShadowingTable | None) -> dict[str, NDArray]:
    """What of both is arrays, by name; errors as of ``write_bundle``."""
    if annotation is None:
        return {}
    arrays: dict[str, NDArray] = {"segments.first": annotation.first, "segments.state": annotation.state}
    for number, hops in enumerate(annotation.ways):
        arrays |= {f"ways.{number}.edge": hops.edge, f"ways.{number}.delay": hops.delay}
    return arrays | ({} if shadowing is None else {"shadowing.values": shadowing.require_converged().values})


def about_states(annotation: Annotation | None, shadowing: ShadowingTable | None) -> dict[str, Any]:
    """What of both is text, by name."""
    about: dict[str, Any] = {} if annotation is None else {"states": annotation.machine.states}
    if shadowing is not None:
        told = shadowing.state, shadowing.residual, shadowing.sweeps, shadowing.converged
        about["shadowing"] = AboutShadowing(shadowing.task, *told)
    return about


def read_annotation(states: list[State], arrays: Mapping[str, NDArray], where: str) -> Annotation:
    """An annotation from its states and arrays; errors as of ``read_bundle``."""
    machine = StateMachine(tuple(states), f"{where}: machine")

    def hops(number: int) -> NextHops:
        return NextHops(*(take(arrays, f"ways.{number}.{part}", np.int32, where) for part in ("edge", "delay")))

    return Annotation(
        machine,
        take(arrays, "segments.first", np.int32, where),
        take(arrays, "segments.state", np.int16, where),
        tuple(map(hops, range(len(machine.at_once)))),
        f"{where}: annotation",
    )


def read_shadowing(about: AboutShadowing, arrays: Mapping[str, NDArray], where: str) -> ShadowingTable:
    """A shadowing table from its values and what is told of it; errors as of ``read_bundle``."""
    values = take(arrays, "shadowing.values", np.float32, where)
    if not math.isfinite(about.residual):
        raise InputError(f"shadowing has a residual of {about.residual}, expected a finite number", where)
    found = about.residual, about.sweeps, about.converged
    return ShadowingTable(about.task, about.state, values, *found, f"{where}: shadowing").require_converged()
