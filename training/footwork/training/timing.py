"""How long an interpolated segment lasts, and where each of its rows is in its two sources.

A segment of F frames fills F ticks, from half a tick before its first frame to half a tick after its last. In flight
the interpolated duration is the root mean square of the sources', which keeps gravity; else it is the mean (Safonova
and Hodgins 2005).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.training.chains import CONTEXT
from footwork.training.segments import Segments


class Timing(NamedTuple):
    """When the C chains of some pairs and weights run."""

    frames: NDArray[np.int64]  # (C,)
    rate: NDArray[np.float64]  # (C, 2) frames of each source in a frame of the chain
    begin: NDArray[np.float64]  # (C, 2) place of the chain's first frame in each source's clip, frames


def timing_of(segments: Segments, pairs: ArrayLike, weights: ArrayLike) -> Timing:
    """The timing of chains, one for each row of ``pairs`` (C, 2) with the weight of its first source (C,).

    A flight runs at exactly the duration's rate, any other chain at that which fills its whole number of frames, so
    that it meets the chains before and after it evenly.
    """
    frames = segments.frames[np.asarray(pairs)].astype(np.float64)
    flight = segments.airborne[np.asarray(pairs)[:, 0]]
    duration = durations(frames, flight, weights)
    count = np.floor(duration + 0.5)
    rate = frames / np.where(flight, duration, count)[:, None]
    middle = segments.start[np.asarray(pairs)] + 0.5 * (frames - 1.0)
    return Timing(count.astype(np.int64), rate, middle - 0.5 * (count - 1.0)[:, None] * rate)


def durations(frames: ArrayLike, flight: ArrayLike, weights: ArrayLike) -> NDArray[np.float64]:
    """Interpolated durations, frames.

    Args:
        frames: durations of the two sources.  # (C, 2)
        flight: whether no foot carries the body.  # (C,)
        weights: share of the first source.  # (C,)
    """
    frames, w = np.asarray(frames, dtype=np.float64), np.asarray(weights)
    mean = w * frames[:, 0] + (1.0 - w) * frames[:, 1]
    root_mean_square = np.sqrt(w * frames[:, 0] ** 2 + (1.0 - w) * frames[:, 1] ** 2)
    return np.where(flight, root_mean_square, mean)


def row_positions(timing: Timing, chains: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """For every row of some chains, context included: the chain's place in ``chains``, and where the row is.

    Context goes on beyond the chain's ends at one frame of each source a row.

    Returns:
        which of ``chains``  # (R,)
        frames of the first and second source's clip, not yet held inside the clips  # (R, 2)
    """
    count = timing.frames[chains]
    rows = count + 2 * CONTEXT
    which = np.repeat(np.arange(len(chains)), rows)
    step = np.arange(rows.sum()) - np.repeat(np.cumsum(rows) - rows, rows) - CONTEXT
    last = count[which] - 1
    inside = np.clip(step, 0, last)
    own = chains[which]
    return which, timing.begin[own] + inside[:, None] * timing.rate[own] + (step - inside)[:, None]
