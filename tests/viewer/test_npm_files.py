"""What the page takes from npm: as packed, from the cache, or fetched; and what is said where it cannot be had."""

import stat
from pathlib import Path

import pytest

from footwork.cli.main import BAD_INPUT, main
from footwork.viewer.npm_files import FILES, NpmError, npm_files


def npm_that(path, script: str) -> None:
    npm = path / "npm"
    npm.write_text(f"#!/bin/sh\n{script}\n")
    npm.chmod(npm.stat().st_mode | stat.S_IXUSR)


@pytest.fixture
def only(tmp_path, monkeypatch):
    """A folder that is alone on the path, before the usual one for a script's own commands."""
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def test_a_missing_npm_is_said_and_the_text_view_offered(only, tmp_path, monkeypatch, capsys):
    with pytest.raises(NpmError, match=r"install Node\.js"):
        npm_files(tmp_path / "cache")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert main(["play", "tcp://127.0.0.1:1"]) == BAD_INPUT
    said = capsys.readouterr().err
    assert "install Node.js" in said
    assert "--text" in said


def test_npm_that_fails_is_quoted_and_leaves_nothing_behind(only, tmp_path):
    npm_that(only, "echo 'npm error network connection refused' >&2; exit 7")
    with pytest.raises(NpmError, match="connection refused"):
        npm_files(tmp_path / "cache")
    assert not list((tmp_path / "cache").iterdir())


def test_they_are_fetched_once(only, tmp_path):
    made = [f"mkdir -p node_modules/{Path(source).parent}; echo x > node_modules/{source}" for source in FILES.values()]
    making = "; ".join(["export PATH=/usr/bin:/bin", *made])
    npm_that(only, making)
    folder = npm_files(tmp_path / "cache")
    assert sorted(path.name for path in folder.iterdir()) == sorted(FILES)
    npm_that(only, "exit 1")
    assert npm_files(tmp_path / "cache") == folder
