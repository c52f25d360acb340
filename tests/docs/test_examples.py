"""Every ``sh`` and ``python`` block of the documentation runs as it stands, in order, a folder for each document."""

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
BLOCK = re.compile(r"^```(sh|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN = {"sh": ["bash", "-euo", "pipefail", "-c"], "python": [sys.executable, "-c"]}


def environment(cache: Path) -> dict[str, str]:
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    return os.environ | {"PATH": path, "XDG_CACHE_HOME": str(cache), "EXAMPLES": str(ROOT / "examples")}


@pytest.mark.timeout(500)
@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_the_examples_of_a_document_run(document, tmp_path):
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
