"""The mechanism of a row of an atlas, to be written to a file; and the panels that were found for it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from enumerate.strings.panel_strings import chain_scd
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.native.documents import dumps
from graphs.files.patterns.fold import sheet_from_fold
from graphs.mechanism.sheet import Sheet
from synth.drawing.catalogue.atlas_types import drawable_of_type

__all__ = ["mechanism_file_of_type", "sheet_of_type"]


def mechanism_file_of_type(row: Mapping[str, Any]) -> str:
    """Return the native file of the mechanism of a row with ``kind`` and ``id``.

    Raise InvariantError if there can be no such type, UnsolvableError if it is an order, which has no angles.
    """
    kind, code = row["kind"], row["id"]
    if kind == "order":
        raise UnsolvableError(f"{shown(code)} is an order without angles: there is no file of it")
    thing = drawable_of_type(kind, code)
    return dumps(chain_scd(thing) if kind == "string" else thing)


def sheet_of_type(values: Mapping[str, Any]) -> Sheet | None:
    """Return the panels of a type, from its values in an atlas by column; None if none were found.

    Raise FileError if the stored file is damaged.
    """
    text, place = values.get("fold_file"), Path(f"fold_file of {values['id']}")
    if text is None:
        return None
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileError(place, "", f"is not JSON: {error}", "a FOLD document; build the atlas again") from None
    return sheet_from_fold(document, place)
