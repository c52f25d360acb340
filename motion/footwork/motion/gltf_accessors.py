"""The numbers that a glTF file's accessors name, read from its one run of bytes with every bound checked."""

from dataclasses import dataclass, field

import numpy as np
from msgspec import UNSET
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import gltf_document as g
from footwork.motion.textfile import MAX_SIZE

MAX_NUMBERS = 1 << 25
_TYPES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
_KINDS = {g.FLOAT: "<f4", 5120: "<i1", g.UNSIGNED_BYTE: "<u1", 5122: "<i2", g.UNSIGNED_SHORT: "<u2"}


@dataclass(frozen=True, eq=False)
class Numbers:
    """The accessors of a file.

    Args:
        document: the file's JSON.
        blob: its bytes.
        where: the file, for messages.
    """

    document: g.Document
    blob: bytes
    where: str
    _known: dict[int, NDArray[np.float64]] = field(default_factory=dict)

    def read(self, index: int, kind: str) -> NDArray[np.float64]:
        """The elements of an accessor.  # (count, 1, 3 or 4)

        Args:
            index: of the accessor.
            kind: what it must hold: SCALAR, VEC3 or VEC4.

        Raises:
            InputError: for one that is not there or is of another kind, sparse, outside its view, without elements, or
                with numbers that are not finite and of ordinary size.
        """
        where = f"{self.where}: accessor {index}"
        accessor = _item(self.document.accessors, index, where)
        if accessor.type != kind or accessor.component_type not in _KINDS:
            problem = f"holds {accessor.type[:20]} of {accessor.component_type}, expected {kind} of floats"
            raise InputError(f"{problem} or normalised integers", where)
        if accessor.sparse is not UNSET or accessor.buffer_view is UNSET:
            raise InputError("is sparse or has no view, expected a plain one", where)
        if accessor.count == 0:
            raise InputError("has no elements, expected at least one", where)
        if index in self._known:
            return self._known[index]
        elements = self._elements(accessor, accessor.buffer_view, where)
        if elements.size + sum(known.size for known in self._known.values()) > MAX_NUMBERS:
            raise InputError(f"more than {MAX_NUMBERS} numbers in all: accessors that lie over one another?", where)
        values = elements.astype(np.float64)
        if accessor.component_type != g.FLOAT:
            values = _normalised(values, accessor, where)
        if not (np.abs(values) < MAX_SIZE).all():
            raise InputError(f"holds numbers that are not finite ones under {MAX_SIZE:g}", where)
        self._known[index] = values
        return values

    def _elements(self, accessor: g.Accessor, index: int, where: str) -> NDArray:
        view = _item(self.document.buffer_views, index, where)
        buffer = _item(self.document.buffers, view.buffer, where)
        if view.buffer != 0 or buffer.uri is not UNSET:
            raise InputError("lies in another file, expected everything in this one", where)
        kind = np.dtype(_KINDS[accessor.component_type])
        wide = _TYPES[accessor.type]
        step = kind.itemsize * wide if view.byte_stride is UNSET else view.byte_stride
        needed = accessor.byte_offset + step * (accessor.count - 1) + kind.itemsize * wide
        room = min(view.byte_length, len(self.blob) - view.byte_offset)
        if needed > room or step < kind.itemsize * wide:
            problem = f"{accessor.count} elements need {needed} bytes, its view has {max(room, 0)}"
            raise InputError(problem, where)
        start = view.byte_offset + accessor.byte_offset
        return np.ndarray((accessor.count, wide), kind, self.blob, start, (step, kind.itemsize))


def _normalised(values: NDArray[np.float64], accessor: g.Accessor, where: str) -> NDArray[np.float64]:
    if not accessor.normalized:
        raise InputError("holds integers, expected floats or normalised integers", where)
    most = np.iinfo(np.dtype(_KINDS[accessor.component_type])).max
    return np.maximum(values / most, -1.0)


def _item(items: list, index: int, where: str):
    if index >= len(items):
        raise InputError(f"needs item {index} of {len(items)}, expected one that is there", where)
    return items[index]
