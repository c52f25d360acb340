"""Bundles in shared memory: a copy of the servers' own, sound whatever becomes of the file."""

import subprocess
import sys

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.bundle import write_bundle
from footwork.runtime.shared_bundle import shared_bundle
from toy_bundle import lively_bundle, toy_bundle


@pytest.fixture
def path(tmp_path):
    write_bundle(tmp_path / "b.footwork", toy_bundle())
    return tmp_path / "b.footwork"


def test_a_file_cut_short_in_place_leaves_the_bundle_as_it_was(path, tmp_path):
    bundle = shared_bundle(path, tmp_path / "store")
    with path.open("r+b") as file:
        file.truncate(100)
    for name in ("rotations", "root_position", "target"):
        np.testing.assert_array_equal(getattr(bundle.graph, name), getattr(toy_bundle().graph, name))


def test_servers_of_the_same_bundle_share_one_copy(path, tmp_path):
    for _ in range(2):
        assert shared_bundle(path, tmp_path / "store").digest == toy_bundle().digest
    (copy,) = (tmp_path / "store").iterdir()
    assert copy.name == f"{toy_bundle().digest}.footwork"


def test_a_damaged_copy_is_made_anew(path, tmp_path):
    shared_bundle(path, tmp_path / "store")
    (copy,) = (tmp_path / "store").iterdir()
    copy.write_bytes(b"damaged")
    assert shared_bundle(path, tmp_path / "store").digest == toy_bundle().digest


def test_another_bundle_under_its_name_is_not_taken_for_it(path, tmp_path):
    shared_bundle(path, tmp_path / "store")
    (copy,) = (tmp_path / "store").iterdir()
    write_bundle(copy, lively_bundle())
    assert shared_bundle(path, tmp_path / "store").digest == toy_bundle().digest


def test_what_is_no_bundle_is_copied_nowhere(tmp_path):
    (tmp_path / "b.footwork").write_bytes(b"nothing")
    with pytest.raises(InputError, match="cut short"):
        shared_bundle(tmp_path / "b.footwork", tmp_path / "store")
    assert not (tmp_path / "store").exists()
    (tmp_path / "file").touch()
    write_bundle(tmp_path / "b.footwork", toy_bundle())
    with pytest.raises(InputError, match="cannot be made"):
        shared_bundle(tmp_path / "b.footwork", tmp_path / "file" / "store")


HOLDER = """
import sys
from pathlib import Path
from footwork.runtime.shared_bundle import shared_bundle
bundle = shared_bundle(Path(sys.argv[1]), Path(sys.argv[2]))
print("held", flush=True)
sys.stdin.read()
"""


def test_copies_that_no_server_holds_any_more_are_removed_and_others_stay(path, tmp_path):
    store, other = tmp_path / "store", tmp_path / "other.footwork"
    write_bundle(other, lively_bundle())
    command = [sys.executable, "-c", HOLDER, str(other), str(store)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "held\n"
        mine = shared_bundle(path, store)
        held = {f"{digest}.footwork" for digest in (mine.digest, lively_bundle().digest)}
        assert {copy.name for copy in store.iterdir()} == held
        holder.kill()  # without a word; the system gives its lock up
        holder.wait()
    shared_bundle(path, store)
    assert [copy.name for copy in store.iterdir()] == [f"{mine.digest}.footwork"]
    np.testing.assert_array_equal(mine.graph.target, toy_bundle().graph.target)
