"""Models for simulators written to files: a record for each format, in the table ``MODELS``."""

from collections.abc import Callable, Mapping
from pathlib import Path
from xml.sax.saxutils import escape

from graphs.errors import FileError, InvariantError, shown
from graphs.files.atomic import check_place, write_chunks
from graphs.files.outputs import Format
from graphs.printing import plain
from graphs.types import JointId
from synth.compliance.springs import Springs
from synth.moving.made import Movable
from synth.simulation.assembly import DENSITY, Assembly, AssemblyOptions, assembly_of
from synth.simulation.mjcf import lost_as_mjcf, mjcf_bytes
from synth.simulation.sdf import lost_as_sdf, sdf_bytes
from synth.simulation.step import lost_as_step, step_bytes
from synth.simulation.tables import csv_bytes, lost_as_table
from synth.simulation.urdf import FILE, lost_as_urdf, urdf_files
from synth.simulation.usd import lost_as_usd, usd_bytes

MODELS: dict[str, Format[Assembly]] = {
    "mjcf": Format(".xml", "MJCF, for MuJoCo", mjcf_bytes, lost_as_mjcf),
    "urdf": Format(".urdf", "URDF, for ROS", lambda assembly: urdf_files(assembly)[".urdf"], lost_as_urdf),
    "sdf": Format(".sdf", "SDF, for Gazebo", sdf_bytes, lost_as_sdf),
    "usd": Format(".usda", "USD with physics", usd_bytes, lost_as_usd),
    "step": Format(".step", "STEP, for CAD", step_bytes, lost_as_step),
    "table": Format(".csv", "table of a motion", csv_bytes, lost_as_table),
}
"""Name to the format of a model for simulators, or of its motion."""
_BESIDE: dict[str, Callable[[Assembly], Mapping[str, bytes]]] = {"urdf": urdf_files}
"""Formats of several files: the files by what their names end in, in place of the extension."""


def write_model(
    mechanism: Movable,
    path: str | Path,
    name: str,
    *,
    thickness: float | None = None,
    density: float = DENSITY,
    scale: float | None = None,
    size: float | None = None,
    drive: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    springs: Springs | None = None,
    force: bool = False,
) -> tuple[str, ...]:
    """Write a mechanism as rigid bodies and joints for a simulator, with what closes its loops.

    Parameters
    ----------
    mechanism : anything that `synth.moving.made.configuration_of` takes
    path : str or Path
    name : {"mjcf", "urdf", "sdf", "usd", "step", "table"}
        The format: for MuJoCo (``.xml``), ROS (``.urdf``, with the loops in a file of JSON beside it) or Gazebo
        (``.sdf``), programs that read USD
        (``.usda``), CAD (``.step``); the motion as a table (``.csv``).
    thickness : float, optional
        Of panels, and diameter of bars, millimetres; by default a hundredth of the extent.
    density : float, optional
        Kilograms per cubic metre.
    scale, size : float, optional
        Millimetres per unit of the coordinates, by default 1000: the unit is a metre; or the longest side.
    drive : mapping of joint id to float, optional
        Joints that get actuators, and the angles at which their motion ends, as for `synth.move`. By default the
        joint that moves most.
    branch : int or str, optional
        As for `synth.move`.
    springs : Springs, optional
        Newton metres per radian, and constant moments at joints in newton metres (at slides newtons).
    force : bool, optional
        Overwrite an existing file.

    Returns
    -------
    tuple of str
        Notes on the motion, and what the file does not hold, by kind and number.

    Raises
    ------
    FileError
        If the file cannot be written, exists already, or has another extension than the format.
    InvariantError
        If there is no such format, or a number is out of range.
    UnsolvableError
        If the mechanism has no coordinates, joints cannot be driven, or a panel is not planar.

    Examples
    --------
    >>> import synth
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write_model(synth.generate("miura").mechanism, Path(folder, "miura.xml"), "mjcf")
    ('4 limits of cut hinges',)
    """
    options = AssemblyOptions(thickness, density, scale, size, drive or {}, branch, springs or Springs())
    assembly = write_assembly(mechanism, path, name, options, force=force)
    return (*assembly.notes, *MODELS[name].lost(assembly))


def write_assembly(
    mechanism: Movable, path: str | Path, name: str, options: AssemblyOptions, *, force: bool = False
) -> Assembly:
    """Write a mechanism as `write_model` does, and return its bodies and joints."""
    if name not in MODELS:
        raise InvariantError("format", f"there is no format {shown(name)}", ", ".join(MODELS))
    written = MODELS[name]
    if Path(path).suffix.lower() != written.suffix:
        raise FileError(path, "", f"the extension is not that of {written.name}", written.suffix)
    check_place(Path(path), force=force)
    assembly = assembly_of(mechanism, options)
    if name not in _BESIDE:
        write_chunks(Path(path), [written.to_bytes(assembly)], force=force)
        return assembly
    stem = Path(path).with_suffix("")
    files = {stem.with_name(stem.name + ending): data for ending, data in _BESIDE[name](assembly).items()}
    for place in files:
        check_place(place, force=force)
    for place, data in files.items():
        write_chunks(place, [data.replace(FILE.encode(), _in_xml(stem.name))], force=force)
    return assembly


def _in_xml(name: str) -> bytes:
    """Return the name of a file as a file of XML has it."""
    return escape(plain(name, 100), {'"': "&quot;"}).encode()
