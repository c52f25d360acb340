"""Files come whole, with the digest that they should have, or not at all, whatever the server does."""

import hashlib
import resource
import subprocess
import sys
from collections.abc import Iterator
from http.client import HTTPMessage
from io import BytesIO
from pathlib import Path
from urllib.request import Request

import pytest

from footwork.errors import InputError
from footwork.training.fetching import Fetcher, _Redirections
from misbehaving_server import Misbehaving, misbehaving

BODY = bytes(range(256)) * 400
DIGEST = hashlib.sha256(BODY).hexdigest()
FETCHER = Fetcher(insecure=True, pause=0.01, timeout=0.3)


@pytest.fixture(scope="module")
def server() -> Iterator[Misbehaving]:
    with misbehaving(BODY) as running:
        yield running


@pytest.fixture(autouse=True)
def forget(server: Misbehaving):
    server.asked.clear()


def fetch(server: Misbehaving, way: str, folder: Path, fetcher: Fetcher = FETCHER) -> list[int]:
    """What was seen on the way; the file is there and whole after it."""
    seen: list[int] = []
    assert fetcher.fetch(f"{server.address}/{way}/file", folder / "file", len(BODY), DIGEST, seen.append)
    assert [path.name for path in folder.iterdir()] == ["file"]
    assert (folder / "file").read_bytes() == BODY
    return seen


@pytest.mark.parametrize(
    ("way", "requests"),
    [("good", 1), ("cut", 3), ("cut_whole", 3), ("moody", 3), ("slow", 2), ("onward", 1)],
)
def test_a_file_comes_whole(server: Misbehaving, tmp_path: Path, way: str, requests: int):
    seen = fetch(server, way, tmp_path)
    assert seen[-1] == len(BODY)
    assert server.times(f"/{way}/file") == requests


def test_what_broke_off_goes_on_from_there(server: Misbehaving, tmp_path: Path):
    third = len(BODY) // 3 + 1
    fetch(server, "cut", tmp_path)
    assert [wanted for _, wanted in server.asked] == [None, f"bytes={third}-", f"bytes={2 * third}-"]


@pytest.mark.parametrize(
    ("way", "wanted"),
    [
        ("good", ["bytes=1000-"]),
        ("whole", ["bytes=1000-"]),
        ("elsewhere", ["bytes=1000-"]),
        ("unsatisfiable", ["bytes=1000-", None]),
    ],
)
def test_a_later_call_goes_on_or_begins_anew(server: Misbehaving, tmp_path: Path, way: str, wanted: list):
    (tmp_path / ".file.part").write_bytes(BODY[:1000])
    fetch(server, way, tmp_path)
    assert [asked for _, asked in server.asked] == wanted


def test_what_lies_there_from_another_file_is_fetched_anew_the_next_time(server: Misbehaving, tmp_path: Path):
    (tmp_path / ".file.part").write_bytes(b"x" * 1000)
    with pytest.raises(InputError, match="has the digest"):
        fetch(server, "good", tmp_path)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / ".file.part").write_bytes(BODY + b"more")
    fetch(server, "good", tmp_path)


def test_a_file_that_is_there_is_not_asked_for_and_a_changed_one_is(server: Misbehaving, tmp_path: Path):
    url = f"{server.address}/good/file"
    fetch(server, "good", tmp_path)
    assert not FETCHER.fetch(url, tmp_path / "file", len(BODY), DIGEST)
    assert len(server.asked) == 1
    (tmp_path / "file").write_bytes(b"changed")
    assert FETCHER.fetch(url, tmp_path / "file", len(BODY), DIGEST)
    assert (tmp_path / "file").read_bytes() == BODY


REFUSED = {
    "wrong": ("has the digest .*, expected .*: another file than the one known", 1),
    "longer": (f"is {len(BODY) + 1} bytes long, expected {len(BODY)}", 1),
    "shorter": (f"is {len(BODY) - 1} bytes long, expected {len(BODY)}", 1),
    "endless": (f"is longer than the {len(BODY)} bytes expected", 1),
    "missing": ("the server answers 404", 1),
    "broken": ("the server answers 500 .*; tried 4 times", 4),
    "page": ("answers with a page in place of the file: is a proxy or a login in between", 1),
    "astray": ("leads on to ftp://127.0.0.1/file: is not https", 1),
}


@pytest.mark.parametrize(("way", "said", "requests"), [(way, *rest) for way, rest in REFUSED.items()])
def test_anything_else_is_refused_and_leaves_nothing(server, tmp_path: Path, way: str, said: str, requests: int):
    with pytest.raises(InputError, match=said) as caught:
        fetch(server, way, tmp_path)
    assert f"/{way}/file" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []
    assert server.times(f"/{way}/file") == requests


def test_what_keeps_breaking_stays_beside_for_later(server: Misbehaving, tmp_path: Path):
    with pytest.raises(InputError, match=r"cut after \d+ of \d+ bytes; tried 2 times, a later call goes on"):
        fetch(server, "cut", tmp_path, Fetcher(insecure=True, attempts=2, pause=0.01))
    assert [path.name for path in tmp_path.iterdir()] == [".file.part"]
    assert len(fetch(server, "good", tmp_path)) <= 2
    assert server.asked[-1][1] == f"bytes={2 * (len(BODY) // 3 + 1)}-"


def test_redirections_that_go_in_circles_end(server: Misbehaving, tmp_path: Path):
    with pytest.raises(InputError, match="302"):
        fetch(server, "round_and_round", tmp_path)


def test_addresses_that_are_not_https_need_leave(server: Misbehaving, tmp_path: Path):
    for url in (f"{server.address}/good/file", "file:///etc/passwd", "ftp://a/b", "nonsense"):
        with pytest.raises(InputError, match="is not https, expected it unless told to be insecure"):
            Fetcher().fetch(url, tmp_path / "file", 1, DIGEST)
    with pytest.raises(InputError, match="leads on to http://b: is not https"):
        _Redirections(Fetcher()).redirect_request(Request("https://a"), BytesIO(), 302, "", HTTPMessage(), "http://b")
    assert server.asked == []


def test_nobody_there_is_told(tmp_path: Path):
    with misbehaving(b"") as gone:
        address = gone.address
    with pytest.raises(InputError, match=r"cannot be reached .Connection refused.: is there a network"):
        FETCHER.fetch(f"{address}/good/file", tmp_path / "file", 1, DIGEST)
    with pytest.raises(InputError, match=r"cannot be written .No such file or directory"), misbehaving(BODY) as there:
        FETCHER.fetch(f"{there.address}/good/file", tmp_path / "none" / "file", len(BODY), DIGEST)


def test_a_file_that_finds_no_room_leaves_nothing(server: Misbehaving, tmp_path: Path):
    """Another process, which may write less than the file."""
    script = (
        "from pathlib import Path; from footwork.training.fetching import Fetcher;"
        f"Fetcher(insecure=True).fetch({server.address + '/good/file'!r}, Path({str(tmp_path / 'file')!r}),"
        f" {len(BODY)}, {DIGEST!r})"
    )
    less = len(BODY) // 2
    done = subprocess.run(
        [sys.executable, "-B", "-c", script],  # byte code that finds no room would be left cut short for other tests
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (less, less)),
    )
    assert "InputError" in done.stderr
    assert "cannot be written (File too large); nothing is left of it" in done.stderr
    assert list(tmp_path.iterdir()) == []
