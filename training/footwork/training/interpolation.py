"""Interpolated segments: motion between every pair of segments that the same feet carry (Safonova and Hodgins 2005)."""

import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.training.blended_poses import figure_of
from footwork.training.chain_filling import KEPT, OFF_GRAVITY, SLIDING, Filled, Sources, filled, filled_poses
from footwork.training.chain_plan import Plan, plan_of
from footwork.training.chains import CONTEXT, NO_SEGMENT, Chains, chain_parts
from footwork.training.graph_options import MAX_WEIGHTS
from footwork.training.nodes import Nodes, nodes_of
from footwork.training.pairing import pairs_of
from footwork.training.room import require_room
from footwork.training.segments import Segments, segments_of
from footwork.training.source_tracks import Tracks, tracks_of
from footwork.training.timing import Timing
from footwork.training.weight_counts import needed_weights, pair_distances, weights_of_pairs

# measured: 0.6 kB to interpolate a row, and what the search for transitions holds of it
_BYTES_PER_ROW = 1500
_ROWS_MOVED = 1 << 16


def interpolated(
    clips: Sequence[Clip],
    behaviours: tuple[str, ...],
    weights: int = 9,
    pairing: str = "ratio",
    threshold: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> tuple[Chains, dict[str, Any]]:
    """Clips, and all segments between theirs that keep to physics, as chains.

    A chain is left out that does not fall at g within GRAVITY_TOLERANCE although a source of it does, or in which a
    standing foot is more than LARGEST_SLIDE off its place.

    Args:
        clips: of one body at 30 frames a second, with contacts.
        behaviours: the behaviours that commands may ask for.
        weights: how many weights n between two segments: 1 / (n + 1), ..., n / (n + 1).
        pairing: which pairs, see ``pairs_of``.
        threshold: where given, pairs have only as many weights, up to ``weights``, as hops under it need.
        progress: told the share of the work done.

    Returns:
        the chains
        a report, JSON-able: segments, pairs, chains kept and rejected by reason, nodes, rows and seconds

    Raises:
        InputError: as ``nodes_of``, for an unknown rule, weights outside 1..MAX_WEIGHTS, a body without masses.
    """
    began = time.perf_counter()
    nodes = nodes_of(clips, behaviours)
    segments = segments_of(clips)
    pairs = pairs_of(segments, pairing)
    sources = Sources(figure_of(nodes.skeleton), segments, tracks_of(clips), nodes.arrays["contacts"])
    counts = _weights(segments, sources.tracks, pairs, weights, threshold)
    plan = plan_of(segments, sources.tracks, np.repeat(pairs, counts, axis=0), weights_of_pairs(counts))
    _require_room(plan.timing)
    result = filled(sources, plan, progress or (lambda share: None))
    chains = _kept(nodes, clips, plan, result)
    report = {"pairing": pairing, "weights": weights, "weights_a_pair": float(counts.mean()) if len(counts) else 0.0}
    report |= {"pairs": len(pairs)}
    report |= _of_segments(segments) | _of_chains(result.verdict)
    report |= {"nodes": chains.node_count, "rows": chains.row_count, "seconds": time.perf_counter() - began}
    return chains, report


def _weights(
    segments: Segments, tracks: Tracks, pairs: NDArray[np.intp], most: int, threshold: float | None
) -> NDArray[np.intp]:
    """How many weights each pair has.  # (P,)"""
    if not 1 <= most <= MAX_WEIGHTS:
        raise InputError(f"{most} weights, expected 1 to {MAX_WEIGHTS}", "interpolation")
    if threshold is None:
        return np.full(len(pairs), most)
    move = plan_of(segments, tracks, pairs, np.full(len(pairs), 0.5)).move
    return needed_weights(pair_distances(segments, tracks, pairs, move), threshold, most)


def _require_room(timing: Timing) -> None:
    """Refuse chains that memory has no room for, before any is made."""
    rows = int(timing.frames.sum()) + 2 * CONTEXT * len(timing.frames)
    instead = "use fewer clips, fewer weights or a stricter pairing"
    require_room(_BYTES_PER_ROW * rows, f"{rows} rows of interpolated motion", instead)


def poses_of(
    clips: Sequence[Clip], chains: Chains, which: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The poses of all rows of some chains, context included, one chain after the other: those of ``chains.places``.

    Args:
        clips: those that the chains were made of.
        chains: the chains.
        which: chains to give, in any order.  # (K,)

    Returns:
        root positions, metres  # (R, 3)
        local rotations, joint 0 in the world  # (R, J, 4)
    """
    which = np.asarray(which, dtype=np.intp)
    rows = chains.length[which] + 2 * chains.context[which]
    starts = np.cumsum(rows) - rows
    root, rotations = np.empty((rows.sum(), 3)), np.empty((rows.sum(), chains.skeleton.joint_count, 4))
    captured = chains.first[which] == NO_SEGMENT
    for clip, own in zip(which[captured], starts[captured], strict=True):
        end = own + clips[clip].frame_count
        root[own:end], rotations[own:end] = clips[clip].root_position, clips[clip].rotations
    mixed = which[~captured]
    contacts = chains.contacts[: chains.original_count]
    sources = Sources(figure_of(chains.skeleton), segments_of(clips), tracks_of(clips), contacts)
    pairs = np.stack([chains.first[mixed], chains.second[mixed]], axis=1)
    plan = plan_of(sources.segments, sources.tracks, pairs, chains.chain_weight[mixed])
    filled_poses(sources, plan, starts[~captured], root, rotations)
    return root, rotations


def _kept(nodes: Nodes, clips: Sequence[Clip], plan: Plan, result: Filled) -> Chains:
    """The clips and the chains that are not left out."""
    keep = result.verdict == KEPT
    fields = chain_parts(nodes, clips)
    fields["places"] = _compacted(result.places, result.first_row, keep)
    frames = _compacted(result.frames, result.first_node, keep)
    for name, of_chains in {
        "length": plan.timing.frames,
        "context": np.full(len(keep), CONTEXT),
        "first": plan.pairs[:, 0],
        "second": plan.pairs[:, 1],
        "chain_weight": plan.weights,
    }.items():
        fields[name] = np.append(fields[name], of_chains[keep])
    first_heavier = np.repeat(fields["chain_weight"], fields["length"]) >= 0.5
    heavier = np.where(first_heavier, frames[:, 0], frames[:, 1])
    arrays = nodes.arrays
    fields |= {name: arrays[name][heavier] for name in ("label", "behaviour")}
    fields |= {name: arrays[name][frames[:, 0]] for name in ("clip", "frame")}
    fields |= {f"other_{name}": arrays[name][frames[:, 1]] for name in ("clip", "frame")}
    fields["contacts"] = arrays["contacts"][frames].all(axis=1)
    return Chains(**fields)


def _compacted(values: NDArray, starts: NDArray[np.intp], keep: NDArray[np.bool_]) -> NDArray:
    """Read-only ``values`` without those of chains not kept, moved together in place: there is no room for a copy.

    Args:
        values: what stands before the chains, then theirs.
        starts: of each chain, and the end.  # (C + 1,)
        keep: chains to keep.  # (C,)
    """
    end = int(starts[0])
    edges = np.flatnonzero(np.diff(keep.astype(np.int8), prepend=0, append=0))
    for start, stop in starts[edges].reshape(-1, 2):
        # numpy copies what overlaps, so little at a time
        for at in range(start, stop, _ROWS_MOVED) if start > end else ():
            more = min(_ROWS_MOVED, stop - at)
            values[end + at - start : end + at - start + more] = values[at : at + more]
        end += stop - start
    left = values[:end]
    left.flags.writeable = False
    return left


def _of_segments(segments: Segments) -> dict[str, int]:
    return {
        "segments": segments.count,
        "flights": int(segments.airborne.sum()),
        "ballistic_flights": int(segments.ballistic.sum()),
    }


def _of_chains(verdict: NDArray[np.int8]) -> dict[str, int]:
    return {
        "chains": len(verdict),
        "kept": int((verdict == KEPT).sum()),
        "rejected_for_gravity": int((verdict == OFF_GRAVITY).sum()),
        "rejected_for_slide": int((verdict == SLIDING).sum()),
    }
