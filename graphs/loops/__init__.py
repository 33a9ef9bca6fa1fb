"""Loops of a mechanism: what a loop is, the space of cycles, and which loops share a centre."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.loops.classes import CentreClass as CentreClass
    from graphs.loops.classes import centre_classes as centre_classes
    from graphs.loops.classes import class_of_loop as class_of_loop
    from graphs.loops.cycle_space import added_independent as added_independent
    from graphs.loops.cycle_space import check_independent as check_independent
    from graphs.loops.cycle_space import cut_into_cycles as cut_into_cycles
    from graphs.loops.cycle_space import dependent_loop as dependent_loop
    from graphs.loops.cycle_space import in_span_of as in_span_of
    from graphs.loops.cycle_space import signed_cycle as signed_cycle
    from graphs.loops.cycle_space import split_dependent as split_dependent
    from graphs.loops.loop import Centre as Centre
    from graphs.loops.loop import Loop as Loop
    from graphs.loops.loop import cyclic_order as cyclic_order
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "classes": "CentreClass centre_classes class_of_loop",
            "cycle_space": (
                "added_independent check_independent cut_into_cycles dependent_loop in_span_of "
                "signed_cycle split_dependent"
            ),
            "loop": "Centre Loop cyclic_order",
        },
    )
