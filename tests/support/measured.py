"""Lines as they stand in written templates, in millimetres, read without the project's code; closed meshes."""

from __future__ import annotations

import re
import zlib
from collections import Counter, defaultdict
from xml.etree import ElementTree

import numpy as np

_SVG = "{http://www.w3.org/2000/svg}"
_POINT = 25.4 / 72
COLOURS = {"0 0 0": "CUT", "1 0 0": "MOUNTAIN", "0 0 1": "VALLEY", "1 0 1": "CREASE"}
KINDS = {*COLOURS.values(), "MARKS"}


def lines_of_svg(path):
    """Kind to float[n, 2, 2], and words to places; y upwards from the foot of the page."""
    root = ElementTree.parse(path).getroot()
    wide, high = (float(root.get(side).removesuffix("mm")) for side in ("width", "height"))
    assert root.get("viewBox") == f"0 0 {wide:g} {high:g}"  # a unit is a millimetre
    lines = {}
    for group in root.iter(f"{_SVG}g"):
        paths = [re.split("[MLZ ]", path.get("d"))[1:] for path in group.iter(f"{_SVG}path")]
        if paths and group.get("id") in KINDS:
            lines[group.get("id")] = np.array([0, high, 0, high]) + np.array(paths, dtype=float) * (1, -1, 1, -1)
    words = {text.text: (float(text.get("x")), high - float(text.get("y"))) for text in root.iter(f"{_SVG}text")}
    return {kind: rows.reshape(-1, 2, 2) for kind, rows in lines.items()}, words, (wide, high)


def lines_of_pdf(data):
    """Of each page kind to float[n, 2, 2], by the colour that the stream sets; and the sizes of the pages."""
    boxes = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", data)
    pages = []
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.DOTALL):
        text = zlib.decompress(stream).decode("latin-1")
        lines, kind = defaultdict(list), None
        matrix = re.match(r"1 0 0 1 0 0 cm", text)  # user space is never scaled
        assert matrix
        assert text.count(" cm") == 1
        for found in re.finditer(r"([\d.]+ [\d.]+ [\d.]+) RG|n ([-\d.]+) ([-\d.]+) m ([-\d.]+) ([-\d.]+) l\s+S", text):
            if found[1]:
                kind = COLOURS.get(found[1], "MARKS")
            else:
                lines[kind].append([float(number) * _POINT for number in found.groups()[1:]])
        pages.append({kind: np.array(rows).reshape(-1, 2, 2) for kind, rows in lines.items()})
    return pages, [(float(wide) * _POINT, float(high) * _POINT) for wide, high in boxes]


def lines_of_dxf(text):
    """Layer to float[n, 2, 2]."""
    rows = text.splitlines()
    pairs = list(zip(map(int, rows[::2]), rows[1::2], strict=False))
    lines, now = defaultdict(list), None
    for code, value in pairs:
        if code == 0:
            if now is not None and now["0"] == "LINE":
                lines[now["8"]].append([[float(now["10"]), float(now["20"])], [float(now["11"]), float(now["21"])]])
            now = {}
        if now is not None:
            now[str(code)] = value
    return {layer: np.array(ends) for layer, ends in lines.items()}


def lengths(lines):
    """Lengths of lines, in order."""
    return np.sort(np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1))


def is_watertight(mesh):
    """Whether each side of a triangle is a side of one other, the other way round."""
    sides = Counter(side for a, b, c in mesh.triangles.tolist() for side in ((a, b), (b, c), (c, a)))
    return all(number == 1 and sides[b, a] == 1 for (a, b), number in sides.items())


def volume_of_mesh(mesh):
    """Cubic millimetres; below zero if the mesh is inside out."""
    a, b, c = (mesh.corners[mesh.triangles[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)
