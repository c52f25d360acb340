"""What decides the last bit of a result, so that machines that work together can be compared."""

import hashlib
import sys
from functools import cache
from importlib.metadata import version
from pathlib import Path

import footwork.motion
import footwork.training

_LIBRARIES = ("footwork", "numpy", "scipy", "numba")


@cache
def fingerprint() -> dict[str, str]:
    """Versions of Python and the libraries that compute, and a digest of footwork's own code, by name."""
    versions = {library: version(library) for library in _LIBRARIES}
    return {"python": f"{sys.version_info.major}.{sys.version_info.minor}", **versions, "code": _digest_of_code()}


def _digest_of_code() -> str:
    digest = hashlib.sha256()
    for package in (footwork.motion, footwork.training):
        folder = Path(package.__path__[0])
        for path in sorted(folder.rglob("*.py")):
            digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:12]
