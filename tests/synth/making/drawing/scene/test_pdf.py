"""PDF of many pages: contents packed when a page is done, and whole."""

import re
import tracemalloc
import zlib

import pytest

from synth.making.drawing.scene.shapes import Layer, Line, Polygon
from synth.making.drawing.scene.writing import Scene

pytest.importorskip("reportlab")


def test_pages_are_kept_packed():
    """Memory grows by what the file grows, not by the text of the pages."""
    from synth.making.drawing.scene.writing import pdf_bytes

    row = [(i % 97, i % 89) for i in range(2500)]
    scene = Scene(100, 100, (Layer("a", (Line(row),)),))
    held = []

    def pages():
        for _ in range(5):
            yield scene
            held.append(tracemalloc.get_traced_memory()[0])

    tracemalloc.start()
    try:
        data = pdf_bytes(pages())
    finally:
        tracemalloc.stop()
    texts = [zlib.decompress(found) for found in re.findall(rb"stream\r?\n(.*?)endstream", data, re.DOTALL)]
    assert len(texts) == 5
    assert texts[0].count(b" l") > 2400
    assert (held[-1] - held[1]) / 3 < 0.6 * len(texts[0])


def test_what_is_under_a_shadow_shows_through():
    """The state in which a polygon is filled is the last one that the page sets before it."""
    from synth.making.drawing.scene.writing import pdf_bytes

    corners = [(10, 10), (90, 10), (90, 90)]
    shapes = (Polygon(corners, "front"), Polygon(corners, "shadow", opacity=0.25), Polygon(corners, "back"))
    data = pdf_bytes([Scene(100, 100, (Layer("a", shapes),))])
    opacities = dict(re.findall(rb"/(gRLs\d+) <<\s*/ca ([\d.]+)", data))
    (stream,) = re.findall(rb"stream\r?\n(.*?)endstream", data, re.DOTALL)
    filled, now = [], 1.0
    for found in re.finditer(rb"/(gRLs\d+) gs|\sf\*?\s", zlib.decompress(stream)):
        if found[1]:
            now = float(opacities[found[1]])
        else:
            filled.append(now)
    assert filled[-3:] == [1.0, 0.25, 1.0]
