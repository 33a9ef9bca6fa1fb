from graphs.creasing.edits import (
    SheetEdit as SheetEdit,
    crease_sheet as crease_sheet,
    lock_crease as lock_crease,
    remove_crease as remove_crease,
)
from graphs.creasing.named import joint_of_sheet_named as joint_of_sheet_named
from graphs.creasing.panels import take_off_panels as take_off_panels
