from graphs.loops.classes import (
    CentreClass as CentreClass,
    centre_classes as centre_classes,
    class_of_loop as class_of_loop,
)
from graphs.loops.loop import (
    Centre as Centre,
    Loop as Loop,
    added_independent as added_independent,
    check_independent as check_independent,
    cut_into_cycles as cut_into_cycles,
    cyclic_order as cyclic_order,
    dependent_loop as dependent_loop,
    in_span_of as in_span_of,
    signed_cycle as signed_cycle,
    split_dependent as split_dependent,
)
