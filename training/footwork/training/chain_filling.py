"""Computing interpolated chains many at a time, and telling which of them break physics."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.motion.threads import THREADS
from footwork.training.blended_poses import Figure, blended_poses
from footwork.training.chain_plan import Plan, blend_of
from footwork.training.chains import CONTEXT
from footwork.training.ranges import ranges
from footwork.training.segments import GRAVITY, GRAVITY_TOLERANCE, Segments, accelerations
from footwork.training.source_tracks import Tracks

LARGEST_SLIDE = 0.01  # metres that a standing foot may be off its place
KEPT, OFF_GRAVITY, SLIDING = 0, 1, 2
# a part's arrays stay in the processor's cache
_ROWS_AT_ONCE = 2048


class Filled(NamedTuple):
    """C chains of a plan, laid end to end: N frames, M rows."""

    places: NDArray[np.float64]  # (M, J, 3) world places of all joints, metres
    frames: NDArray[np.int32]  # (N, 2) nearest frame of each source, on the tracks
    verdict: NDArray[np.int8]  # (C,) KEPT, OFF_GRAVITY or SLIDING
    first_row: NDArray[np.intp]  # (C + 1,)
    first_node: NDArray[np.intp]  # (C + 1,)


class Sources(NamedTuple):
    """What chains are computed from."""

    figure: Figure
    segments: Segments
    tracks: Tracks
    contacts: NDArray[np.bool_]  # (F, feet) on the tracks


def filled(sources: Sources, plan: Plan, progress: Callable[[float], None]) -> Filled:
    """All chains of a plan. The captured frames stand before them, as chains of their own would.

    Args:
        sources: what to mix.
        plan: how.
        progress: told the share of the chains that are done.
    """
    result = _room(sources, plan)
    chains = len(plan.pairs)

    def fill(part: tuple[int, int]) -> int:
        _fill(sources, plan, result, *part)
        return part[1]

    with ThreadPoolExecutor(THREADS) as pool:
        for done in pool.map(fill, parts(np.diff(result.first_row))):
            progress(done / chains)
    return result


def parts(rows: NDArray) -> list[tuple[int, int]]:
    """First chain, and the one after the last, of stretches of some thousand rows.

    Args:
        rows: of each chain.  # (C,)
    """
    cuts = np.searchsorted(np.cumsum(rows), np.arange(_ROWS_AT_ONCE, rows.sum(), _ROWS_AT_ONCE))
    edges = np.unique([0, *cuts, len(rows)])
    return [(int(a), int(b)) for a, b in pairwise(edges)]


def _room(sources: Sources, plan: Plan) -> Filled:
    """Room for the results, the captured frames already in it."""
    originals, joints = len(sources.tracks.places), len(sources.figure.joints)
    first_node = originals + np.append(0, np.cumsum(plan.timing.frames))
    first_row = first_node + 2 * CONTEXT * np.arange(len(first_node))
    places = np.empty((first_row[-1], joints, 3))
    places[:originals] = sources.tracks.places
    frames = np.empty((first_node[-1], 2), dtype=np.int32)
    frames[:originals] = np.arange(originals)[:, None]
    return Filled(places, frames, np.zeros(len(plan.pairs), dtype=np.int8), first_row, first_node)


def _fill(sources: Sources, plan: Plan, result: Filled, start: int, end: int) -> None:
    """Compute the chains start..end-1."""
    rows = blend_of(plan, np.arange(start, end))
    poses = blended_poses(sources.figure, sources.tracks, rows)
    result.places[result.first_row[start] : result.first_row[end]] = poses.places
    count = plan.timing.frames[start:end]
    played = ranges(result.first_row[start:end] - result.first_row[start] + CONTEXT, count)
    frames = _nearest(sources, plan.pairs[start:end][rows.chain[played]], rows.position[played])
    result.frames[result.first_node[start] : result.first_node[end]] = frames
    standing = sources.contacts[frames].all(axis=1)
    off_gravity = _off_gravity(sources, plan, poses.centre[played, 1], start, end)
    slide = np.maximum.reduceat(np.where(standing, poses.missed[played], 0.0).max(axis=1), np.cumsum(count) - count)
    verdict = np.where(slide > LARGEST_SLIDE, SLIDING, KEPT)
    result.verdict[start:end] = np.where(off_gravity, OFF_GRAVITY, verdict)


def _off_gravity(sources: Sources, plan: Plan, heights: NDArray, start: int, end: int) -> NDArray[np.bool_]:
    """Which chains do not fall at g although one of their sources does.  # heights (N,) of the centre of mass"""
    falls = plan.airborne[start:end] & sources.segments.ballistic[plan.pairs[start:end]].any(axis=1)
    return falls & (np.abs(accelerations(heights, plan.timing.frames[start:end]) + GRAVITY) > GRAVITY_TOLERANCE)


def _nearest(sources: Sources, pairs: NDArray[np.intp], position: NDArray[np.float64]) -> NDArray[np.int32]:
    """Nearest frames of both sources inside their segments, on the tracks.  # (N, 2), (N, 2) -> (N, 2)"""
    segments = sources.segments
    first = sources.tracks.start[segments.clip[pairs]]
    low, high = first + segments.start[pairs], first + segments.end[pairs] - 1
    return np.clip(np.floor(position + 0.5), low, high).astype(np.int32)


def filled_poses(
    sources: Sources, plan: Plan, first_row: NDArray[np.intp], root: NDArray[np.float64], rotations: NDArray[np.float64]
) -> None:
    """Write the poses of all rows of a plan's chains where each chain's begin.

    Args:
        sources: what to mix.
        plan: how.
        first_row: where each chain's rows begin in the results.  # (C,)
        root: the result.  # (R, 3)
        rotations: the result.  # (R, J, 4)
    """
    rows = plan.timing.frames + 2 * CONTEXT

    def fill(part: tuple[int, int]) -> None:
        poses = blended_poses(sources.figure, sources.tracks, blend_of(plan, np.arange(*part)))
        own = ranges(first_row[slice(*part)], rows[slice(*part)])
        root[own], rotations[own] = poses.root_position, poses.rotations

    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(fill, parts(rows)))
