"""Models for simulators written to files: a record for each format, in the table `EXPORTERS`."""

from collections.abc import Callable, Mapping
from pathlib import Path
from xml.sax.saxutils import escape

from graphs.errors import FileError, InvariantError, shown
from graphs.files.atomic import check_place, write_chunks
from graphs.printing import plain
from graphs.types import JointId
from synth.analysis.compliance.springs import Springs
from synth.analysis.moving._configuration_of import Movable
from synth.exporters import EXPORTERS
from synth.making.simulation.assembly import DENSITY, Assembly, AssemblyOptions, assembly_of
from synth.making.simulation.urdf import FILE, urdf_files

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
    mechanism : anything that `synth.analysis.moving._configuration_of.configuration_of` takes
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
    return (*assembly.notes, *EXPORTERS["models"][name].lost(assembly))


def write_assembly(
    mechanism: Movable, path: str | Path, name: str, options: AssemblyOptions, *, force: bool = False
) -> Assembly:
    """Write a mechanism as `write_model` does, and return its bodies and joints."""
    if name not in EXPORTERS["models"]:
        raise InvariantError("format", f"there is no format {shown(name)}", ", ".join(EXPORTERS["models"]))
    written = EXPORTERS["models"][name]
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
