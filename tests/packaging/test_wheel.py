"""The built wheel in an empty virtual environment brings a working ``footwork`` command."""

import json
import os
import shutil
import subprocess
import sys
import venv
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest

from footwork.motion.bvh import write_bvh
from footwork.training.embedded import embedded_clips
from footwork.viewer.npm_files import FILES

ROOT = Path(__file__).resolve().parents[2]


def run(*command: object, cwd: Path, env: Mapping[str, str] | None = None) -> str:
    words = [str(part) for part in command]
    done = subprocess.run(words, capture_output=True, text=True, cwd=cwd, env=env, check=False)
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
    assert "footwork/viewer/web/index.html" in names


@pytest.mark.skipif(shutil.which("npm") is None, reason="npm is not installed")
def test_the_wheel_brings_what_the_page_takes_from_npm(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {f"footwork/viewer/web/vendor/{name}" for name in FILES} <= names


@pytest.fixture
def motions(tmp_path) -> tuple[Path, Path]:
    """A step's worth of capture that shows all that a player may ask for, as far as its labels say."""
    folder, labels = tmp_path / "steps", tmp_path / "labels.csv"
    folder.mkdir()
    walk = next(clip for clip in embedded_clips() if clip.name == "walk_normal")
    write_bvh(folder / "walk.bvh", walk.cut(20, 60))
    rows = [f"steps,walk.bvh,{10 * k},{10 * k + 10},{label}" for k, label in enumerate(("idle", "walk", "run", "jump"))]
    labels.write_text("\n".join(["set,file,start_frame,end_frame,label", *rows]) + "\n")
    return folder, labels


@pytest.mark.timeout(400)
def test_an_empty_environment_gets_the_command(wheel, motions, tmp_path):
    folder, labels = motions
    venv.create(tmp_path / "venv")
    scripts = tmp_path / "venv" / "bin"
    pip = (sys.executable, "-m", "pip", "--python", scripts / "python", "--disable-pip-version-check")
    run(*pip, "install", "--quiet", "--no-compile", wheel, cwd=tmp_path)
    demo = (scripts / "footwork", "demo", "--headless", "--seconds", "1", "--json", "--cache", tmp_path / "cache")
    # Kernels run as plain Python: whether anything is missing shows all the same, without compiling all of them anew.
    plain = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    report = json.loads(run(*demo, "--motions", folder, "--labels", labels, cwd=tmp_path, env=plain))
    assert report["ticks"] >= 30
