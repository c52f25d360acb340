"""``footwork keys``: from two empty folders to a client that is let in."""

import json

import pytest

from footwork.cli.main import main
from footwork.protocol.client import Client
from footwork.protocol.curve import CurveKeys, KeyPair
from footwork.protocol.errors import RefusedError
from footwork.runtime.key_folder import KeyFolder
from served import client_of, serving, until


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)

    def printed(*arguments: str) -> dict:
        assert main(["keys", *arguments, "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return printed


def test_a_client_whose_key_is_allowed_plays_and_another_hears_nothing(run):
    run("server", "keys")
    run("client", "alice")
    run("client", "eve")
    run("allow", "keys", "alice.key")
    alice, eve = (CurveKeys.read(f"{name}.key_secret", "keys/server.key") for name in ("alice", "eve"))
    with serving(keys=KeyFolder("keys")) as server:
        with client_of(server, curve=alice) as client:
            client.spawn(0)
            assert next(client.poses()).character == 0
        for curve in (eve, None):
            with pytest.raises(RefusedError, match="no answer to hello"):
                Client(server.address, curve=curve, timeout=0.2)
        until(lambda: server.summary()["denied"] >= 1)
        assert server.summary()["sessions"] == 1


def test_the_list_follows_what_is_allowed_and_revoked(run):
    run("server", "keys")
    bob = KeyPair.new().public.decode()
    run("allow", "keys", bob, "--name", "bob")
    assert run("list", "keys")["clients"] == [{"name": "bob", "public_key": bob}]
    run("revoke", "keys", "bob")
    assert run("list", "keys")["clients"] == []


def test_a_key_is_printed_as_it_is(tmp_path, capsys):
    folder = KeyFolder.create(tmp_path / "keys")
    public = b"[b]" + KeyPair.new().public[3:]
    folder.allow("brackets", public)
    assert main(["keys", "list", str(tmp_path / "keys")]) == 0
    assert public.decode() in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["allow", "keys", "nobody.key"], "cannot be read"),
        (["allow", "nowhere", KeyPair.new().public.decode()], "give it one"),
        (["list", "nowhere"], "cannot be read"),
        (["client", "a/b"], "no name of a key"),
    ],
)
def test_mistakes_are_one_line_and_status_two(tmp_path, monkeypatch, capsys, arguments, said):
    monkeypatch.chdir(tmp_path)
    assert main(["keys", *arguments]) == 2
    assert said in capsys.readouterr().err
