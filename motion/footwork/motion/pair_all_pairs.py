"""The windowed cost of all pairs of frames under weights of each pair: matrix products, then sums along diagonals.

A frame's friction is the sum over the feet that stand of what each foot adds. So a pair's weights are a sum of parts
of one frame or the other alone, and all sums over points are matrix products whose depth is P, the few points that
friction reaches, and the number of feet; frames need not be sorted by what stands at them (conventions.md 1).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion.blocks import BLOCK, filled_in_blocks
from footwork.motion.pair_weights import PairWeights
from footwork.motion.pair_window_costs import PARTS, pair_window_costs
from footwork.motion.window import RADIUS


def pair_all_pairs(
    places: NDArray,
    contacts: NDArray,
    lengths: Sequence[int],
    windows: NDArray,
    weights: NDArray,
    pair_weights: PairWeights,
    scale: float,
) -> NDArray[np.float64]:
    """``scale`` times the smallest weighted squared distance of every two frames' windows.  # (N, N)

    Exact and symmetric; one half is computed and mirrored.

    Args:
        places: points of each frame, near the origin so that no accuracy is lost.  # (N, P, 3)
        contacts: which feet stand at each frame.  # (N, feet)
        lengths: frames of each clip; they sum to N.
        windows: the frames of each frame's window.  # (N, LENGTH)
        weights: of a window's frames, symmetric, sum 1.  # (LENGTH,)
        pair_weights: of a pair's points.
        scale: what squared distances are multiplied by.
    """
    used = (pair_weights.mass > 0.0) | pair_weights.friction.any(axis=0)
    places = places[:, used]
    pair_weights = PairWeights(pair_weights.mass[used], pair_weights.friction[:, used])
    standing = contacts.astype(np.float64)
    own = _own_sums(places, standing, windows, weights, pair_weights)

    def stretch(frames: slice, padded: NDArray[np.intp]) -> _Stretch:
        return _stretch(places[padded], standing[padded], pair_weights, own[frames])

    def fill(a: _Stretch, b: _Stretch, block: NDArray, mirrored: NDArray) -> None:
        scratch = np.empty((PARTS, BLOCK))
        pair_window_costs(_products(a, b), weights[RADIUS:], a.own, b.own, scale, scratch, block, mirrored)

    return filled_in_blocks(lengths, windows, stretch, fill)


@dataclass(frozen=True, eq=False)
class _Stretch:
    """At most BLOCK frames of one clip; the factors of products are over M = these and the context around them.

    Of a pair's weights the part of its first frame goes with the left factors and that of its second with the
    right ones; friction of the second is over the S points that friction reaches.
    """

    left: NDArray[np.float64]  # (M, 2P + 2S) x and z by the own weights, then bare
    left_y: NDArray[np.float64]  # (M, P + S + 2 feet) -2 y alike, then squares under each foot's friction, contacts
    right: NDArray[np.float64]  # (2P + 2S, M) x and z bare, then by the own friction
    crossed: NDArray[np.float64]  # (2P + 2S, M) z and -x alike
    right_y: NDArray[np.float64]  # (P + S + 2 feet, M) y alike, then contacts, squares
    standing: NDArray[np.float64]  # (M, feet) contacts
    pressed: NDArray[np.float64]  # (2, M, feet) x and z under each foot's friction
    own: NDArray[np.float64]  # (frames, 4)


def _stretch(points: NDArray, standing: NDArray, weights: PairWeights, own: NDArray) -> _Stretch:
    x, y, z = np.moveaxis(points, -1, 0)
    friction = weights.frictions(standing)
    weighed = weights.mass + friction
    some = weights.friction.any(axis=0)
    squares = np.sum(points**2, axis=-1) @ weights.friction.T
    by_friction = [(values * friction)[:, some] for values in (x, y, z)]
    return _Stretch(
        left=np.concatenate([x * weighed, z * weighed, x[:, some], z[:, some]], axis=1),
        left_y=np.concatenate([-2.0 * y * weighed, -2.0 * y[:, some], squares, standing], axis=1),
        right=np.concatenate([x, z, by_friction[0], by_friction[2]], axis=1).T.copy(),
        crossed=np.concatenate([z, -x, by_friction[2], -by_friction[0]], axis=1).T.copy(),
        right_y=np.concatenate([y, by_friction[1], standing, squares], axis=1).T.copy(),
        standing=standing,
        pressed=np.stack([x @ weights.friction.T, z @ weights.friction.T]),
        own=own,
    )


def _own_sums(
    places: NDArray, standing: NDArray, windows: NDArray, weights: NDArray, pair_weights: PairWeights
) -> NDArray[np.float64]:
    """Of each window under its own weights, sums of x, z and squares, and half the mass and all the friction, which
    of two windows add up to the sum of the pair's weights.  # (N, 4)
    """
    friction = pair_weights.frictions(standing)
    weighed = pair_weights.mass + friction
    x, _, z = np.moveaxis(places, -1, 0)
    values = [x, z, np.sum(places**2, axis=-1)]
    frames = [np.sum(value * weighed, axis=1) for value in values]
    frames.append(0.5 * pair_weights.mass.sum() + friction.sum(axis=1))
    return np.einsum("k,nkc->nc", weights, np.stack(frames, axis=-1)[windows])


def _products(a: _Stretch, b: _Stretch) -> NDArray[np.float64]:
    """Per-frame sums over points, as ``pair_window_costs`` takes them.  # (PARTS, M of a, M of b)"""
    gram = np.empty((PARTS, len(a.left), b.right.shape[1]))
    np.matmul(a.left, b.right, out=gram[0])
    np.matmul(a.left, b.crossed, out=gram[1])
    np.matmul(a.left_y, b.right_y, out=gram[2])
    np.matmul(a.pressed, b.standing.T, out=gram[3:5])
    np.matmul(a.standing, b.pressed.transpose(0, 2, 1), out=gram[5:7])
    return gram
