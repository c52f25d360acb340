"""Files of CURVE keys."""

import stat

import pytest
import zmq
import zmq.auth

from footwork.errors import InputError
from footwork.protocol.curve import CurveKeys, KeyPair, is_key, read_public, write_public


def test_a_pair_that_is_written_is_read_again_here_and_by_zmq_auth(tmp_path):
    pair = KeyPair.new()
    public, secret = pair.write(tmp_path, "alice")
    assert KeyPair.read(secret) == pair
    assert read_public(public) == pair.public
    assert zmq.auth.load_certificate(secret) == (pair.public, pair.secret)
    assert zmq.auth.load_certificate(public) == (pair.public, None)


def test_what_zmq_auth_wrote_is_read(tmp_path):
    public, secret = zmq.auth.create_certificates(tmp_path, "bob", {"whose": "bob's"})
    assert KeyPair.read(secret).public == read_public(public) == zmq.auth.load_certificate(public)[0]


def test_a_secret_is_for_its_owner_alone_and_shown_nowhere(tmp_path):
    pair = KeyPair.new()
    public, secret = pair.write(tmp_path, "alice")
    assert stat.S_IMODE(secret.stat().st_mode) == 0o600
    assert pair.secret.decode() not in public.read_text()
    assert pair.secret.decode() not in repr(CurveKeys(pair, pair.public))


@pytest.mark.parametrize("there", ["alice.key", "alice.key_secret"])
def test_no_key_is_written_over(tmp_path, there):
    (tmp_path / there).write_text("precious")
    with pytest.raises(InputError, match="is there already"):
        KeyPair.new().write(tmp_path, "alice")
    assert (tmp_path / there).read_text() == "precious"
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("name", ["", "../alice", "a/b", ".hidden", "a" * 65, "a b", "a\n"])
def test_a_name_that_is_no_file_name_is_refused(tmp_path, name):
    with pytest.raises(InputError, match="no name of a key"):
        KeyPair.new().write(tmp_path, name)


@pytest.mark.parametrize(
    "text",
    ["", "curve\n", '    secret-key = "short"\n', b"\xff\xfe" * 99, 'secret-key = "' + "#" * 40 + '"\n'],
)
def test_a_file_without_keys_is_refused(tmp_path, text):
    path = tmp_path / "a.key_secret"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(InputError, match="holds no secret key"):
        KeyPair.read(path)
    with pytest.raises(InputError, match="holds no public key"):
        read_public(path)


def test_keys_of_two_pairs_in_one_file_are_refused(tmp_path):
    pair, other = KeyPair.new(), KeyPair.new()
    _, secret = KeyPair(other.public, pair.secret).write(tmp_path, "mixed")
    with pytest.raises(InputError, match="does not belong"):
        KeyPair.read(secret)


def test_what_cannot_be_read_or_written_is_one_line(tmp_path):
    for path in (tmp_path, tmp_path / "none"):
        with pytest.raises(InputError, match="cannot be read"):
            read_public(path)
    with pytest.raises(InputError, match="cannot be written"):
        write_public(tmp_path / "none" / "a.key", KeyPair.new().public)


def test_what_a_key_looks_like():
    assert is_key(KeyPair.new().public.decode())
    assert not is_key("#" * 40)
    assert not is_key("a" * 39)
    assert not is_key("é" * 40)
