"""Packs what the live view's page takes from npm into the wheel; without npm the wheel is built without it."""

import importlib.util
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

VIEWER = "viewer/footwork/viewer"


class PageFilesHook(BuildHookInterface):
    """Runs npm into a temporary folder and adds its files to the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Before a wheel is built; an editable install fetches them when they are first needed."""
        if self.target_name != "wheel" or version != "standard":
            return
        npm_files = _loaded(Path(self.root, VIEWER, "npm_files.py"))
        self._folder = tempfile.TemporaryDirectory()
        try:
            packed = npm_files.fetch(Path(self._folder.name, "vendor"))
        except npm_files.NpmError as error:
            self.app.display_warning(f"{error}; the wheel has no live view until npm is there")
            return
        for path in packed.iterdir():
            build_data["force_include"][str(path)] = f"footwork/viewer/web/vendor/{path.name}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Once it is built."""
        if hasattr(self, "_folder"):
            self._folder.cleanup()


def _loaded(path: Path) -> Any:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise ImportError(path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
