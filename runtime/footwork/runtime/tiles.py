"""Tiles: numbers of many characters, or joints, side by side, so that compiled loops take several at once.

A tile is a flat array of rows of ``TILE`` numbers, a row a quantity, a column a character or joint; ``at`` is where a
quantity's first row begins. The compiler works on several columns at once only while it can tell all rows apart and
nothing in the loop is called: rows lie a constant apart, loops are over ``range(min(count, TILE))``, what they call is
inlined and divides without asking (``error_model="numpy"``), and they hold no sine or other call.
"""

import numba

TILE = 32
"""Columns: two legs of so many characters fit the nearest cache. Of 16 and fewer the compiler takes one at a time."""


@numba.njit(cache=True, nogil=True, forceinline=True)
def load3(tile, at, k):
    """The vector in column k of the three rows from ``at`` on."""
    return tile[at + k], tile[at + TILE + k], tile[at + 2 * TILE + k]


@numba.njit(cache=True, nogil=True, forceinline=True)
def load4(tile, at, k):
    """The quaternion in column k of the four rows from ``at`` on."""
    return tile[at + k], tile[at + TILE + k], tile[at + 2 * TILE + k], tile[at + 3 * TILE + k]


@numba.njit(cache=True, nogil=True, forceinline=True)
def store3(tile, at, k, v):
    """Put a vector there."""
    tile[at + k], tile[at + TILE + k], tile[at + 2 * TILE + k] = v


@numba.njit(cache=True, nogil=True, forceinline=True)
def store4(tile, at, k, q):
    """Put a quaternion there."""
    tile[at + k], tile[at + TILE + k], tile[at + 2 * TILE + k], tile[at + 3 * TILE + k] = q
