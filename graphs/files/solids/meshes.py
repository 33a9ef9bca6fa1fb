"""Closed meshes of triangles as STL, Wavefront OBJ and 3MF, an object each, in millimetres.

Binary STL is 80 bytes for people, then triangles as 32-bit numbers. 3MF: *3MF Core Specification* 1.3; equal
meshes give equal files.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from xml.sax.saxutils import quoteattr
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import numpy as np
import numpy.typing as npt

from graphs.geometry import unit
from graphs.printing import plain
from graphs.types import Floats


@dataclass(frozen=True)
class SolidMesh:
    """A solid of one material: corners float[n, 3], millimetres, and triangles of them, int[m, 3].

    Triangles are counter-clockwise seen from outside.
    """

    name: str
    corners: Floats
    triangles: npt.NDArray[np.int64]


_LONGEST = 100  # letters: slicers show names in a list, and ids may have a thousand letters


def obj_of_meshes(meshes: Sequence[SolidMesh]) -> str:
    """Return meshes as OBJ text, in millimetres."""
    rows, before = ["# millimetres"], 1
    for mesh in meshes:
        rows.append(f"o {plain(mesh.name, _LONGEST).replace(' ', '_')}")
        rows += [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.corners.tolist()]
        rows += [f"f {a} {b} {c}" for a, b, c in (mesh.triangles + before).tolist()]
        before += len(mesh.corners)
    return "\n".join(rows) + "\n"


_STL_HEAD = b"binary STL, millimetres".ljust(80)
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def stl_bytes(meshes: Sequence[SolidMesh]) -> bytes:
    """Return meshes as one binary STL file, which does not tell them apart."""
    corners = np.concatenate([mesh.corners[mesh.triangles] for mesh in meshes])
    rows = np.zeros(len(corners), dtype=_TRIANGLE)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    rows["normal"] = unit(normals)
    rows["corners"] = corners
    return _STL_HEAD + len(rows).to_bytes(4, "little") + rows.tobytes()


_XML_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
_TYPES = (
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'
)
_RELATIONS = (
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Target="/3D/3dmodel.model" Id="rel0" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)
_FIRST_DAY = (1980, 1, 1, 0, 0, 0)  # the first date that ZIP has: equal models are to be equal files, whenever written


def three_mf_bytes(meshes: Sequence[SolidMesh]) -> bytes:
    """Return meshes as a 3MF file, in millimetres."""
    objects = "".join(_object(number, mesh) for number, mesh in enumerate(meshes, start=1))
    items = "".join(f'<item objectid="{number}"/>\n' for number in range(1, len(meshes) + 1))
    model = (
        '<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">\n'
        f"<resources>\n{objects}</resources>\n<build>\n{items}</build>\n</model>\n"
    )
    stream = BytesIO()
    with ZipFile(stream, "w", ZIP_DEFLATED) as archive:
        parts = {"[Content_Types].xml": _TYPES, "_rels/.rels": _RELATIONS, "3D/3dmodel.model": model}
        for name, text in parts.items():
            info = ZipInfo(name, _FIRST_DAY)
            info.compress_type = ZIP_DEFLATED
            archive.writestr(info, _XML_HEAD + text)
    return stream.getvalue()


def _object(number: int, mesh: SolidMesh) -> str:
    corners = "".join(f'<vertex x="{x:.9g}" y="{y:.9g}" z="{z:.9g}"/>\n' for x, y, z in mesh.corners.tolist())
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n' for a, b, c in mesh.triangles.tolist())
    return (
        f'<object id="{number}" type="model" name={quoteattr(plain(mesh.name, _LONGEST))}>\n<mesh>\n'
        f"<vertices>\n{corners}</vertices>\n<triangles>\n{triangles}</triangles>\n</mesh>\n</object>\n"
    )
