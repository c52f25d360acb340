"""Every ``sh`` and ``python`` block of the documentation runs as it stands, in order, a folder for each document.

A document that begins with ``<!-- runs after OTHER.md -->`` runs in the folder of that one, with what it made.
"""

import os
import re
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
AFTER = re.compile(r"\A<!-- runs after (\S+) -->$", re.MULTILINE)
BLOCK = re.compile(r"^```(sh|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN = {"sh": ["bash", "-euo", "pipefail", "-c"], "python": [sys.executable, "-c"]}


def environment(cache: Path) -> dict[str, str]:
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    return os.environ | {"PATH": path, "XDG_CACHE_HOME": str(cache), "EXAMPLES": str(ROOT / "examples")}


def chains() -> list[list[Path]]:
    """Documents that run one after the other."""
    found = [[document] for document in DOCUMENTS]
    for document in DOCUMENTS:
        if after := AFTER.search(document.read_text()):
            own = next(chain for chain in found if chain[0] == document)
            other = next(chain for chain in found if chain[-1].name == after[1])
            other.extend(own)
            found.remove(own)
    return found


@pytest.mark.timeout(500)
@pytest.mark.parametrize("documents", chains(), ids=lambda chain: chain[0].name)
def test_the_examples_of_documents_run(documents, tmp_path):
    for document in documents:
        for language, code in BLOCK.findall(document.read_text()):
            status, said = run([*RUN[language], code], tmp_path)
            assert status == 0, f"{document.name}:\n{code}\n{said}"


def run(command: list[str], folder: Path) -> tuple[int, str]:
    """The exit status of a block and what it said; nothing that it started in the background outlives it."""
    said = folder / "said.txt"
    with said.open("w") as into:
        shell = subprocess.Popen(
            command, cwd=folder, env=environment(folder), stdout=into, stderr=into, start_new_session=True
        )
        try:
            return shell.wait(), said.read_text(errors="replace")
        finally:
            with suppress(ProcessLookupError):
                os.killpg(shell.pid, signal.SIGKILL)
            shell.wait()


def test_there_are_examples_to_run():
    assert any(BLOCK.search(document.read_text()) for document in DOCUMENTS)
