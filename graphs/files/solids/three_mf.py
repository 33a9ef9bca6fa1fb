"""Meshes as 3MF, an object each: *3MF Core Specification* 1.3. Equal meshes give equal files."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from xml.sax.saxutils import quoteattr
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from graphs.files.solids.mesh import Mesh
from graphs.printing import plain

__all__ = ["three_mf_bytes"]

_LONGEST = 100
_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
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
_FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""The date of all that is in the file: the first that ZIP has."""


def three_mf_bytes(meshes: Sequence[Mesh]) -> bytes:
    """Return meshes as a 3MF file, in millimetres."""
    objects = "".join(_object(number, mesh) for number, mesh in enumerate(meshes, start=1))
    items = "".join(f'<item objectid="{number}"/>\n' for number in range(1, len(meshes) + 1))
    model = (
        '<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">\n'
        f"<resources>\n{objects}</resources>\n<build>\n{items}</build>\n</model>\n"
    )
    stream = BytesIO()
    with ZipFile(stream, "w", ZIP_DEFLATED) as archive:
        for name, text in (
            ("[Content_Types].xml", _TYPES),
            ("_rels/.rels", _RELATIONS),
            ("3D/3dmodel.model", model),
        ):
            info = ZipInfo(name, _FIRST_DAY)
            info.compress_type = ZIP_DEFLATED
            archive.writestr(info, _HEAD + text)
    return stream.getvalue()


def _object(number: int, mesh: Mesh) -> str:
    corners = "".join(f'<vertex x="{x:.9g}" y="{y:.9g}" z="{z:.9g}"/>\n' for x, y, z in mesh.corners.tolist())
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n' for a, b, c in mesh.triangles.tolist())
    return (
        f'<object id="{number}" type="model" name={quoteattr(plain(mesh.name, _LONGEST))}>\n<mesh>\n'
        f"<vertices>\n{corners}</vertices>\n<triangles>\n{triangles}</triangles>\n</mesh>\n</object>\n"
    )
