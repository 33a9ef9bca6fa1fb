"""What is built when synthedra is: the script of the page of `synth view`. Where it cannot be, the rest is."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PageHook(BuildHookInterface[Any]):
    """Builds the script of the page before files are collected."""

    def dependencies(self) -> list[str]:
        """Return what has to be installed first."""
        return self._building()["needed"]()

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build; a warning says why there is no page."""
        why = self._building()["build"]()
        if why:
            self.app.display_warning(f"the page of synth view was not built: {why}")

    def _building(self) -> dict[str, Any]:
        return runpy.run_path(str(Path(self.root) / "synth" / "viewer" / "building.py"))
