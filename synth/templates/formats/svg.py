"""Pages as SVG in millimetres: a group, which programs show as a layer, for each kind of line."""

from __future__ import annotations

from xml.sax.saxutils import escape

from synth.drawing.scene.writing import svg_group
from synth.templates.lines import LOOKS, Stroke, Text
from synth.templates.page import Page, Picture

__all__ = ["svg_of_page"]

_BASELINE = 0.35
_DIGITS = 6


def svg_of_page(page: Page) -> str:
    """Return a page as SVG; a unit of its coordinates is a millimetre.

    >>> from synth.templates.paper import Paper
    >>> print(svg_of_page(Page(Paper(200, 300), (Stroke("CUT", (10, 10), (60, 10)),), ())).splitlines()[2])
    <line x1="10" y1="290" x2="60" y2="290"/>
    """
    width, height = page.paper.width, page.paper.height
    rows = [
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'width="{width:g}mm" height="{height:g}mm" viewBox="0 0 {width:g} {height:g}">'
    ]
    for kind, look in LOOKS.items():
        strokes = [stroke for stroke in page.strokes if stroke.kind == kind]
        if not strokes:
            continue
        dash = f' stroke-dasharray="{" ".join(f"{part:g}" for part in look.dash)}"' if look.dash else ""
        rows.append(
            f'<g id="{kind}" inkscape:groupmode="layer" inkscape:label="{kind}" fill="none" '
            f'stroke="{look.colour}" stroke-width="{look.width:g}" stroke-linecap="round"{dash}>'
        )
        rows += [_line(stroke, height) for stroke in strokes]
        rows.append("</g>")
    if page.texts:
        rows.append('<g id="TEXT" inkscape:groupmode="layer" inkscape:label="TEXT" font-family="sans-serif">')
        rows += [_text(text, height, page.ink) for text in page.texts]
        rows.append("</g>")
    if page.picture is not None:
        rows.append(_picture(page.picture, height))
    return "\n".join([*rows, "</svg>"]) + "\n"


def _line(stroke: Stroke, height: float) -> str:
    (x1, y1), (x2, y2) = stroke.start, stroke.end
    return f'<line x1="{_put(x1)}" y1="{_put(height - y1)}" x2="{_put(x2)}" y2="{_put(height - y2)}"/>'


def _text(text: Text, height: float, ink: str) -> str:
    x, y = text.at
    anchor = ' text-anchor="middle"' if text.middle else ""
    low = height - y + _BASELINE * text.size
    return (
        f'<text x="{_put(x)}" y="{_put(low)}" font-size="{text.size:g}" fill="{ink}"{anchor}>'
        f"{escape(text.words)}</text>"
    )


def _picture(picture: Picture, height: float) -> str:
    scene, (left, low) = picture.scene, picture.corner
    wide, high = (picture.scale * side for side in (scene.width, scene.height))
    head = (
        f'<svg x="{_put(left)}" y="{_put(height - low - high)}" width="{_put(wide)}" height="{_put(high)}" '
        f'viewBox="0 0 {_put(scene.width)} {_put(scene.height)}" stroke-linejoin="round" stroke-linecap="round">'
    )
    return "\n".join([head, svg_group(scene), "</svg>"])


def _put(number: float) -> str:
    """Write a number to a millionth of a millimetre, without zeros at its end."""
    return f"{round(number, _DIGITS) + 0.0:.{_DIGITS}f}".rstrip("0").rstrip(".")
