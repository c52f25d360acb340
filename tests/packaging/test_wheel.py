"""The built wheel in an empty virtual environment brings a working ``footwork`` command."""

import json
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def run(*command: object, cwd: Path) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, cwd=cwd, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, ROOT, cwd=folder)
    return next(folder.glob("footwork-*.whl"))


def test_the_wheel_holds_the_library_and_nothing_else(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    outside = [name for name in names if not name.startswith(("footwork/", "footwork-"))]
    assert not outside
    assert "footwork/__init__.py" not in names
    assert "footwork/motion/skeletons/cmu.toml" in names


@pytest.mark.timeout(400)
def test_an_empty_environment_gets_the_command(wheel, tmp_path):
    venv.create(tmp_path / "venv", with_pip=True)
    scripts = tmp_path / "venv" / "bin"
    run(scripts / "python", "-m", "pip", "install", "--quiet", wheel, cwd=tmp_path)
    command = (scripts / "footwork", "demo", "--headless", "--seconds", "1", "--json", "--cache", tmp_path / "cache")
    report = json.loads(run(*command, cwd=tmp_path))
    assert report["ticks"] >= 30
