"""Edits of mechanisms: each makes a new graph, and predicts its change of mobility."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.edit.analogues import generalised_form as generalised_form
    from graphs.edit.analogues import planar_analogue as planar_analogue
    from graphs.edit.analogues import spherical_analogue as spherical_analogue
    from graphs.edit.sc import Edit as Edit
    from graphs.edit.sc import add_crease as add_crease
    from graphs.edit.sc import add_loop as add_loop
    from graphs.edit.sc import add_ride_along as add_ride_along
    from graphs.edit.sc import lock_joint as lock_joint
    from graphs.edit.scd import crease_link as crease_link
    from graphs.edit.scd import lock_hinge as lock_hinge
    from graphs.edit.scd import make_explicit as make_explicit
    from graphs.edit.scd import make_implicit as make_implicit
    from graphs.edit.scd import ride_along as ride_along
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "analogues": "generalised_form planar_analogue spherical_analogue",
            "sc": "Edit add_crease add_loop add_ride_along lock_joint",
            "scd": "crease_link lock_hinge make_explicit make_implicit ride_along",
        },
    )
