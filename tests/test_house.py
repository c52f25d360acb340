"""The shape of the house that packaging and the import rules rest on."""

import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
PORTIONS = sorted(ROOT.glob("*/footwork"))


def test_footwork_is_a_namespace_package():
    assert PORTIONS
    assert not [portion for portion in PORTIONS if (portion / "__init__.py").exists()]


def test_every_portion_is_packaged_and_on_every_path():
    tools = PROJECT["tool"]
    folders = [portion.parent.name for portion in PORTIONS]
    assert sorted(tools["hatch"]["build"]["targets"]["wheel"]["packages"]) == [f"{name}/footwork" for name in folders]
    assert sorted(tools["hatch"]["build"]["dev-mode-dirs"]) == folders
    assert set(folders) <= set(tools["pytest"]["ini_options"]["pythonpath"])
    assert set(folders) <= set(tools["pyright"]["include"])


def test_every_part_is_held_by_the_import_rules():
    parts = {f"footwork.{part.name}" for portion in PORTIONS for part in portion.iterdir() if part.is_dir()}
    assert parts - {"footwork.__pycache__"} == set(PROJECT["tool"]["importlinter"]["root_packages"])
