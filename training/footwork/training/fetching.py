"""Fetching a file whose digest is known: resumed where it broke off, and under its name only once it is whole."""

import hashlib
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from http import HTTPStatus
from http.client import HTTPException, HTTPResponse
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import HTTPRedirectHandler, Request, build_opener

from footwork.errors import InputError

ATTEMPTS = 4
PAUSE = 0.5  # seconds before the second attempt, twice as long before each further one
TIMEOUT = 20.0  # seconds without a byte
_PIECE = 1 << 16
_AGAIN = (408, 425, 429, 500, 502, 503, 504)  # answers that may be others in a moment

Seen = Callable[[int], object]
"""Is called with the number of bytes that are there so far."""


class _BrokenError(Exception):
    """The way there broke; another attempt may come further."""


@dataclass(frozen=True)
class Fetcher:
    """How files are fetched.

    Args:
        insecure: whether addresses and redirections that are not https are followed.
        attempts: how often one file is tried.
        pause: seconds before the second attempt, twice as long before each further one.
        timeout: seconds without a byte after which an attempt ends.
    """

    insecure: bool = False
    attempts: int = ATTEMPTS
    pause: float = PAUSE
    timeout: float = TIMEOUT

    def fetch(self, url: str, target: Path, size: int, sha256: str, seen: Seen = lambda _: None) -> bool:
        """Bring a file, unless it is there; returns whether it was fetched.

        What came of an attempt that broke stays beside the target under another name, and the next one goes on from
        there, in this call or in another.

        Args:
            url: its address.
            target: where it goes; its folder exists.
            size: bytes that it has.
            sha256: its digest, hexadecimal.
            seen: is told how much is there.

        Raises:
            InputError: for an address that is not https, unless insecure; one that cannot be reached or answers with
                an error or a page; a file of another size or digest; and where it cannot be written, for want of room
                say. Nothing new bears the target's name then.
        """
        self.require_https(url)
        if target.is_file() and _digest(target) == sha256:
            seen(size)
            return False
        part = target.with_name(f".{target.name}.part")
        for attempt in range(1, self.attempts + 1):
            try:
                self._bring(url, part, size, seen)
                break
            except _BrokenError as broken:
                if attempt == self.attempts:
                    raise InputError(f"{broken}; tried {attempt} times, a later call goes on from there", url) from None
                time.sleep(self.pause * 2 ** (attempt - 1))
        _publish(part, target, sha256, url)
        return True

    def require_https(self, url: str) -> None:
        """Raise InputError for an address that must not be asked."""
        scheme = urlsplit(url).scheme
        if scheme != "https" and not (self.insecure and scheme == "http"):
            raise InputError("is not https, expected it unless told to be insecure", url)

    def _bring(self, url: str, part: Path, size: int, seen: Seen) -> None:
        """Make the part as long as the file, going on where it ends."""
        have = part.stat().st_size if part.is_file() else 0
        if have == size:
            return
        with self._open(url, have if have < size else 0) as answer:
            _require_file(answer, url)
            goes_on = answer.status == HTTPStatus.PARTIAL_CONTENT and _first_byte(answer) == have
            _take(answer, part, have if goes_on else 0, size, url, seen)

    def _open(self, url: str, have: int) -> HTTPResponse:
        """The server's answer, from byte ``have`` on if it can."""
        headers = {"User-Agent": "footwork", "Accept-Encoding": "identity"}
        request = Request(url, headers=headers | ({"Range": f"bytes={have}-"} if have else {}))  # noqa: S310
        try:
            return build_opener(_Redirections(self)).open(request, timeout=self.timeout)
        except HTTPError as error:
            answer = f"the server answers {error.code} {error.reason}"
            error.close()
            if have and error.code == HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE:
                return self._open(url, 0)
            if error.code in _AGAIN:
                raise _BrokenError(answer) from None
            raise InputError(answer, url) from None
        except (OSError, HTTPException) as error:
            reason = getattr(error, "reason", None) or error
            reason = getattr(reason, "strerror", None) or reason
            raise _BrokenError(f"cannot be reached ({reason}): is there a network?") from None


class _Redirections(HTTPRedirectHandler):
    """Follows only where the fetcher may go."""

    def __init__(self, fetcher: Fetcher) -> None:
        self._fetcher = fetcher

    def redirect_request(self, req: Request, fp, code: int, msg: str, headers, newurl: str) -> Request | None:
        """As the base class, for addresses that are https."""
        try:
            self._fetcher.require_https(newurl)
        except InputError as error:
            raise InputError(f"leads on to {error}", req.full_url) from None
        return super().redirect_request(req, fp, code, msg, headers, newurl)


def _require_file(answer: HTTPResponse, url: str) -> None:
    """A proxy, or a login on the way, answers with a page."""
    if answer.headers.get_content_type() == "text/html":
        raise InputError("answers with a page in place of the file: is a proxy or a login in between?", url)


def _first_byte(answer: HTTPResponse) -> int:
    """Where the bytes of a part begin, -1 where that is not told."""
    told = answer.headers.get("Content-Range", "").removeprefix("bytes ").partition("-")[0]
    return int(told) if told.isdecimal() else -1


def _take(answer: HTTPResponse, part: Path, have: int, size: int, url: str, seen: Seen) -> None:
    """Write what comes to the part, from byte ``have`` on."""
    whole = answer.length  # bytes that the answer promises, None where it does not
    if whole is not None and have + whole != size:
        part.unlink(missing_ok=True)
        raise InputError(f"is {have + whole} bytes long, expected {size}: another file than the one known", url)
    try:
        with part.open("r+b" if have else "wb") as file:
            file.truncate(have)
            file.seek(have)
            for piece in _pieces(answer):
                have += len(piece)
                if have > size:
                    raise InputError(f"is longer than the {size} bytes expected", url)
                file.write(piece)
                seen(have)
    except (OSError, InputError) as error:
        part.unlink(missing_ok=True)
        raise error if isinstance(error, InputError) else _unwritten(error, part) from None
    if have < size:
        raise _BrokenError(f"the connection was cut after {have} of {size} bytes")


def _pieces(answer: HTTPResponse) -> Iterator[bytes]:
    """What comes, until the answer ends; a break on the way ends it, too."""
    while True:
        try:
            piece = answer.read1(_PIECE)
        except (OSError, HTTPException):
            return
        if not piece:
            return
        yield piece


def _publish(part: Path, target: Path, sha256: str, url: str) -> None:
    """Give a part that is the file the file's name."""
    found = _digest(part)
    if found != sha256:
        part.unlink()
        raise InputError(f"has the digest {found[:12]}, expected {sha256[:12]}: another file than the one known", url)
    try:
        with part.open("rb") as file:
            os.fsync(file.fileno())
        part.replace(target)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise _unwritten(error, target) from None


def _unwritten(error: OSError, path: Path) -> InputError:
    return InputError(f"cannot be written ({error.strerror}); nothing is left of it", path)


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
