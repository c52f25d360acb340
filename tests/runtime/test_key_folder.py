"""A server's folder of keys."""

import pytest

from footwork.errors import InputError
from footwork.protocol.curve import KeyPair, read_public
from footwork.runtime.key_folder import KeyFolder


@pytest.fixture
def folder(tmp_path):
    return KeyFolder.create(tmp_path / "keys")


def test_a_new_folder_has_a_pair_and_lets_nobody_in(folder, tmp_path):
    assert read_public(folder.public_file) == folder.pair.public == KeyFolder(tmp_path / "keys").pair.public
    assert folder.allowed() == {}
    assert (tmp_path / "keys").stat().st_mode & 0o077 == 0


def test_a_folder_that_was_there_stays_as_open_as_it_was(tmp_path):
    tmp_path.chmod(0o755)
    KeyFolder.create(tmp_path)
    assert tmp_path.stat().st_mode & 0o777 == 0o755
    assert (tmp_path / "server.key_secret").stat().st_mode & 0o077 == 0


def test_who_is_allowed_and_who_no_more(folder):
    alice, bob = KeyPair.new().public, KeyPair.new().public
    folder.allow("alice", alice)
    folder.allow("bob", bob)
    assert folder.allowed() == {alice: "alice", bob: "bob"}
    folder.revoke("alice")
    assert folder.allowed() == {bob: "bob"}


def test_a_name_or_a_key_counts_once(folder):
    public = KeyPair.new().public
    folder.allow("alice", public)
    with pytest.raises(InputError, match="as alice"):
        folder.allow("bob", public)
    with pytest.raises(InputError, match="is there already"):
        folder.allow("alice", KeyPair.new().public)
    assert folder.allowed() == {public: "alice"}


def test_mistakes_are_told(folder, tmp_path):
    with pytest.raises(InputError, match="is there already"):
        KeyFolder.create(tmp_path / "keys")
    with pytest.raises(InputError, match="no client 'eve', it has none"):
        folder.revoke("eve")
    with pytest.raises(InputError, match="cannot be read"):
        KeyFolder(tmp_path)
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="cannot be made"):
        KeyFolder.create(tmp_path / "file" / "keys")
    (tmp_path / "keys" / "allowed" / "eve.key").write_text("nothing")
    with pytest.raises(InputError, match="holds no public key"):
        folder.allowed()
