"""ORIPA files, as Java's XMLEncoder writes them: properties sorted, zeros left out."""

from collections.abc import Iterable

HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n<java version="1.8.0_202" class="java.beans.XMLDecoder">\n'
OLD = '<object class="oripa.DataSet"><void property="paperSize"><double>400.0</double></void><void property="lines">'
OLD_END = "</void></object></java>\n"
NEW = (
    '<object class="oripa.DataSet" id="DataSet0"><void class="oripa.DataSet" method="getField">'
    '<string>lines</string><void method="set"><object idref="DataSet0"/>'
)
NEW_END = "</void></void></object></java>\n"


def opx_text(lines: Iterable[tuple[int, float, float, float, float]], *, new: bool = False) -> str:
    """Return the text of an ORIPA file of lines (type, x0, y0, x1, y1), in the old dialect or the new."""
    rows = []
    for number, (kind, x0, y0, x1, y1) in enumerate(lines):
        values = [("type", "int", kind)]
        values += [(name, "double", x) for name, x in (("x0", x0), ("x1", x1), ("y0", y0), ("y1", y1))]
        inner = "".join(
            f'<void property="{name}"><{java}>{x!r}</{java}></void>\n' for name, java, x in values if x != 0
        )
        rows.append(f'<void index="{number}"><object class="oripa.OriLineProxy">\n{inner}</object></void>\n')
    array = f'<array class="oripa.OriLineProxy" length="{len(rows)}">\n{"".join(rows)}</array>'
    return HEAD + (NEW + array + NEW_END if new else OLD + array + OLD_END)
