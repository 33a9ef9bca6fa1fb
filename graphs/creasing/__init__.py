"""Crease patterns edited: creases locked, added along a line, removed, panels taken off; patterns again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.creasing.edits import SheetEdit as SheetEdit
    from graphs.creasing.edits import crease_sheet as crease_sheet
    from graphs.creasing.edits import lock_crease as lock_crease
    from graphs.creasing.edits import remove_crease as remove_crease
    from graphs.creasing.named import joint_of_sheet_named as joint_of_sheet_named
    from graphs.creasing.panels import take_off_panels as take_off_panels
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "edits": "SheetEdit crease_sheet lock_crease remove_crease",
            "named": "joint_of_sheet_named",
            "panels": "take_off_panels",
        },
    )
