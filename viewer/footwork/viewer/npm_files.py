"""What the page takes from npm: three.js and MessagePack, of the versions and digests in package-lock.json.

A wheel carries them (hatch_build.py); elsewhere npm fetches them once, into a cache. The build runs this file by
itself, so it imports nothing of ours.
"""

import hashlib
import shutil
import subprocess
import tempfile
from pathlib import Path

WEB = Path(__file__).parent / "web"
PACKED = WEB / "vendor"
"""Where a wheel has them."""
FILES = {
    "three.module.js": "three/build/three.module.js",
    "three.core.js": "three/build/three.core.js",
    "three.LICENSE": "three/LICENSE",
    "msgpack.min.js": "@msgpack/msgpack/dist.umd/msgpack.min.js",
    "msgpack.LICENSE": "@msgpack/msgpack/LICENSE",
}
_LISTS = ("package.json", "package-lock.json")
_NPM_SECONDS = 120.0


class NpmError(Exception):
    """The files are not there and could not be fetched; the message says why and what helps."""


def npm_files(cache: Path) -> Path:
    """The folder that holds ``FILES``: the wheel's own, or one in ``cache``, which is filled by npm once.

    Raises:
        NpmError: where npm is missing or fails.
    """
    lock = hashlib.sha256((WEB / "package-lock.json").read_bytes()).hexdigest()[:16]
    for folder in (PACKED, cache / f"page-{lock}"):
        if all((folder / name).is_file() for name in FILES):
            return folder
    return fetch(cache / f"page-{lock}")


def fetch(into: Path) -> Path:
    """Fill the folder ``into`` by ``npm ci``; it appears whole or not at all.

    Raises:
        NpmError: where npm is missing or fails.
    """
    npm = shutil.which("npm")
    if npm is None:
        raise NpmError("the page needs three.js, which npm fetches: install Node.js with npm (https://nodejs.org)")
    into.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=into.parent) as made:
        work, kept = Path(made, "npm"), Path(made, "kept")
        work.mkdir()
        kept.mkdir()
        for name in _LISTS:
            shutil.copy(WEB / name, work)
        _install(npm, work)
        for name, source in FILES.items():
            shutil.copy(work / "node_modules" / source, kept / name)
        shutil.rmtree(into, ignore_errors=True)
        kept.rename(into)
    return into


def _install(npm: str, folder: Path) -> None:
    command = [npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"]
    try:
        done = subprocess.run(  # noqa: S603 our own command
            command, cwd=folder, capture_output=True, text=True, timeout=_NPM_SECONDS, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NpmError(f"npm could not fetch three.js: {error}") from None
    if done.returncode != 0:
        said = " ".join(line for line in done.stderr.splitlines() if "error" in line)[:300]
        raise NpmError(f"npm could not fetch three.js: {said or f'exit status {done.returncode}'}")
