"""What is written in which formats: one table for pictures, templates, motions, solids, models and tables.

To add a format, enter it here; commands, their checks before anything is computed, and error messages find it. What
makes the bytes is named by its place, and imported when it is used: to look a suffix up loads no writer. Mechanisms
are written by `graphs.files.formats.WRITERS`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Literal

from graphs.files.outputs import Format, Formats, formats_by_suffix

__all__ = ["EXPORTERS", "Exported"]

Exported = Literal[
    "pictures", "templates", "laser templates", "pictures of motions", "motions", "layer orders", "solids", "models",
    "tables",
]  # fmt: skip
"""Kinds of content. Models for simulators are chosen by name, all others by suffix."""


@dataclass(frozen=True, slots=True)
class Placed:
    """A function by its place, such as ``synth.making.simulation.mjcf:mjcf_bytes``, imported when it is called.

    It takes content and `arguments`; what it returns goes through `then`.
    """

    place: str
    arguments: tuple[Any, ...] = ()
    then: Callable[[Any], Any] | None = None

    @property
    def function(self) -> Callable[..., Any]:
        """The function, imported."""
        module, _, name = self.place.partition(":")
        function: Callable[..., Any] = getattr(import_module(module), name)
        return function

    def __call__(self, content: Any) -> Any:
        """Return what the function makes of content."""
        made = self.function(content, *self.arguments)
        return made if self.then is None else self.then(made)


_SCENES = "synth.making.drawing.scene.writing"
_SOLIDS = "synth.making.templates.solids"
_MOTIONS = "synth.making.drawing.space.motion_files"
_SIMULATION = "synth.making.simulation"
_FLAT_FOLDED = "synth.making.drawing.mechanisms.flat_folded"

_PNG = Format(".png", "PNG", Placed(f"{_SCENES}:png_bytes"), needs="matplotlib.font_manager")
_SVG = Format(".svg", "SVG", Placed(f"{_SCENES}:svg_bytes"))
_PDF = Format(".pdf", "PDF", Placed(f"{_SCENES}:pdf_of_pages"), needs="reportlab")


def _drawn(picture: Format[Any], pages_of: str) -> Format[Any]:
    """Return the format of a picture of content, from the place of the function that draws its pages."""
    return Format(picture.suffix, picture.name, Placed(pages_of, then=picture.to_bytes), needs=picture.needs)


def _model(suffix: str, name: str, stem: str) -> Format[Any]:
    place = f"{_SIMULATION}.{stem}"
    return Format(suffix, name, Placed(f"{place}:{stem}_bytes"), Placed(f"{place}:lost_as_{stem}"))


def _solid(suffix: str, name: str, stem: str) -> Format[Any]:
    return Format(suffix, name, Placed(f"{_SOLIDS}:{stem}_of_solids"), Placed(f"{_SOLIDS}:lost_as_solids"))


def _table(suffix: str, name: str, needs: str = "") -> Format[Any]:
    """Return the format of a table that a sink of the runner writes."""
    return Format(suffix, name, Placed("synth.synthesis.atlas.export:table_bytes", (suffix,)), needs=needs)


_PICTURES_OF_MOTIONS = (
    Format(".gif", "GIF", Placed(f"{_MOTIONS}:gif_bytes"), needs="matplotlib.font_manager"),
    _drawn(_PNG, f"{_MOTIONS}:strip_pages"),
    _drawn(_SVG, f"{_MOTIONS}:strip_pages"),
)

EXPORTERS: Mapping[Exported, Formats[Any]] = {
    "pictures": formats_by_suffix(_PNG, _SVG, _PDF),
    "templates": formats_by_suffix(
        _PDF, _SVG, Format(".dxf", "DXF R12, without pages and assembly instructions",
        Placed("synth.making.templates.writing:dxf_bytes")),
    ),
    "laser templates": formats_by_suffix(
        _SVG, _PDF, Format(".dxf", "DXF R12", Placed("synth.making.templates.writing:laser_dxf_bytes"))
    ),
    "pictures of motions": formats_by_suffix(*_PICTURES_OF_MOTIONS),
    "motions": formats_by_suffix(
        Format(".fold", "FOLD", Placed(f"{_MOTIONS}:fold_bytes")),
        Format(".obj", "OBJ, a file for each pose", Placed(f"{_MOTIONS}:obj_bytes")),
        *_PICTURES_OF_MOTIONS,
    ),
    "layer orders": formats_by_suffix(
        Format(".fold", "FOLD", Placed(f"{_FLAT_FOLDED}:order_bytes")),
        *(_drawn(picture, f"{_FLAT_FOLDED}:order_pages") for picture in (_PNG, _SVG, _PDF)),
    ),
    "solids": formats_by_suffix(
        _solid(".stl", "STL", "stl"),
        _solid(".3mf", "3MF", "three_mf"),
        _solid(".gltf", "glTF, with the motion", "gltf"),
        _solid(".obj", "OBJ", "obj"),
    ),
    "models": {
        "mjcf": _model(".xml", "MJCF, for MuJoCo", "mjcf"),
        "urdf": _model(".urdf", "URDF, for ROS", "urdf"),
        "sdf": _model(".sdf", "SDF, for Gazebo", "sdf"),
        "usd": _model(".usda", "USD with physics", "usd"),
        "step": _model(".step", "STEP, for CAD", "step"),
        "table": Format(
            ".csv", "table of a motion",
            Placed(f"{_SIMULATION}.tables:csv_bytes"), Placed(f"{_SIMULATION}.tables:lost_as_table"),
        ),
    },
    "tables": formats_by_suffix(
        _table(".csv", "CSV"),
        Format(".json", "JSON", Placed("synth.synthesis.atlas.export:json_bytes")),
        _table(".jsonl", "JSON lines"),
        _table(".parquet", "Parquet", needs="pyarrow"),
        _table(".tex", "LaTeX"),
    ),
}  # fmt: skip
"""Kind of content to its formats; pictures of rows of an atlas are a catalogue, and among the pictures."""
