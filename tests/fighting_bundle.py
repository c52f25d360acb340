"""The bundle of the embedded fighting motions, built once in each process that tests with it."""

from dataclasses import replace
from functools import cache
from pathlib import Path

from footwork.cli.motions import embedded_dataset
from footwork.motion.bundle import Bundle
from footwork.motion.state_machine import read_state_machine
from footwork.runtime.match import FightGround, fight_ground
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

FIGHTING = Path(__file__).resolve().parents[1] / "examples" / "fighting.toml"


@cache
def fighting_bundle() -> Bundle:
    """Annotated, with strikes, without a table for shadowing."""
    options, machine = GraphOptions(graph="annotated", threshold=1.0), read_state_machine(FIGHTING)
    states = tuple(replace(state, shadowing=False) for state in machine.states)
    return build_bundle(embedded_dataset("fighting"), options, machine=replace(machine, states=states))[0]


@cache
def fighting_ground() -> FightGround:
    """What matches on it share."""
    return fight_ground(fighting_bundle())
