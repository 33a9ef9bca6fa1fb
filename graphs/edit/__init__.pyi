from graphs.edit.analogues import (
    generalised_form as generalised_form,
    planar_analogue as planar_analogue,
    spherical_analogue as spherical_analogue,
)
from graphs.edit.edits import (
    Edit as Edit,
    add_crease as add_crease,
    add_loop as add_loop,
    add_ride_along as add_ride_along,
    crease_link as crease_link,
    lock_hinge as lock_hinge,
    lock_joint as lock_joint,
    make_explicit as make_explicit,
    make_implicit as make_implicit,
    ride_along as ride_along,
)
from graphs.edit.named import joint_named as joint_named, link_named as link_named
