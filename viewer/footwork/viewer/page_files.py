"""The files of the page, read once: what is not among them is not there."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

WEB = Path(__file__).parent / "web"
"""Where the page's own files lie."""
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}


@dataclass(frozen=True)
class PageFile:
    """One file as it is sent."""

    media_type: str
    content: bytes


def page_files(vendor: Path) -> Mapping[str, PageFile]:
    """All files by their path in an address; ``vendor`` is the folder of what comes from npm."""
    files = _files(WEB, "/") | _files(vendor, "/vendor/")
    return files | {"/": files["/index.html"]}


def _files(folder: Path, prefix: str) -> dict[str, PageFile]:
    return {
        prefix + path.name: PageFile(_TYPES[path.suffix], path.read_bytes())
        for path in sorted(folder.iterdir())
        if path.suffix in _TYPES and path.is_file()
    }
