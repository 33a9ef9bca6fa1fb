"""What is built when synthedra is: the script of the page of `synth view`, libraries of C; each only if it can be."""

from __future__ import annotations

import runpy
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class BuildHook(BuildHookInterface[Any]):
    """Builds the script of the page and the libraries before files are collected."""

    def dependencies(self) -> list[str]:
        """Return what has to be installed first."""
        return self._run("synth", "making", "viewer", "building.py")["needed"]()

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build; a warning says why something is not there. With a library a wheel is one for this kind of machine."""
        why = self._run("synth", "making", "viewer", "building.py")["build"]()
        if why:
            self.app.display_warning(f"the page of synth view was not built: {why}")
        compiled = self._run("graphs", "c_libraries.py")
        built = False
        for source in compiled["sources"](Path(self.root)):
            why = compiled["build"](source)
            built |= not why
            if why:
                self.app.display_warning(f"{source.name} was not built, Python does its work: {why}")
        if built and self.target_name == "wheel":
            machine = sysconfig.get_platform().replace("-", "_").replace(".", "_")
            build_data["pure_python"], build_data["tag"] = False, f"py3-none-{machine}"

    def _run(self, *parts: str) -> dict[str, Any]:
        return runpy.run_path(str(Path(self.root, *parts)))
