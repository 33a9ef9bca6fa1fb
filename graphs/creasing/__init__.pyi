from graphs.creasing.edits import (
    SheetEdit as SheetEdit,
    crease_sheet as crease_sheet,
    joint_of_sheet_named as joint_of_sheet_named,
    lock_crease as lock_crease,
    remove_crease as remove_crease,
    take_off_panels as take_off_panels,
)
