"""Sealed files that are mapped into memory: the same arrays, shared, and safe from being published over."""

from pathlib import Path

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import tensor_file

ARRAYS = {"a": np.arange(12, dtype=np.float32).reshape(3, 4), "b": np.zeros((0, 2), np.int32), "c": np.ones(3, bool)}


def written(path: Path, number: float = 0.0) -> tuple[Path, str]:
    data, digest = tensor_file.seal({**ARRAYS, "d": np.full(5000, number)}, {"number": number})
    tensor_file.publish(path, data)
    return path, digest


def test_a_map_gives_what_reading_gives(tmp_path):
    path, digest = written(tmp_path / "a")
    mapped, read = (tensor_file.unseal(get(path), "a") for get in (tensor_file.map_bytes, tensor_file.read_bytes))
    assert mapped[1:] == read[1:]
    assert mapped[2] == digest
    for name in read[0]:
        np.testing.assert_array_equal(mapped[0][name], read[0][name])
        assert not mapped[0][name].flags.writeable
        assert not mapped[0][name].flags.owndata


def test_publishing_over_a_mapped_file_leaves_the_map_as_it_was(tmp_path):
    path, _ = written(tmp_path / "a", 1.0)
    old = tensor_file.unseal(tensor_file.map_bytes(path), "a")[0]
    written(path, 2.0)
    path.unlink()
    assert (old["d"] == 1.0).all()


def test_the_digest_of_a_map_is_checked(tmp_path):
    path, _ = written(tmp_path / "a")
    data = bytearray(path.read_bytes())
    data[-1] ^= 1
    path.write_bytes(data)
    with pytest.raises(InputError, match="damaged"):
        tensor_file.unseal(tensor_file.map_bytes(path), "a")


def test_what_cannot_be_mapped_is_refused(tmp_path):
    (tmp_path / "empty").touch()
    with pytest.raises(InputError, match="cut short"):
        tensor_file.unseal(tensor_file.map_bytes(tmp_path / "empty"), "empty")
    for path, said in ((tmp_path, "not a regular file"), (tmp_path / "none", "cannot be read")):
        with pytest.raises(InputError, match=said):
            tensor_file.map_bytes(path)
