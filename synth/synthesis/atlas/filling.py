"""The values of an atlas beyond those of its enumerations: names, ride-alongs, analogues, coordinates and folding.

A row of an enumeration becomes a row of the atlas; columns that a kind of type does not have stay empty.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import lru_cache
from typing import Any, get_args

import numpy as np

from enumerate.contracted.binary_links import orbits_of
from enumerate.strings.panel_strings import chain_scd
from graphs.edit.analogues import generalised_form, planar_analogue, spherical_analogue
from graphs.errors import SynthedraError
from graphs.files.formats import mechanism_of_id
from graphs.files.patterns.fold import fold_text
from graphs.identity.chains import automorphisms_of, chain_id
from graphs.identity.drawings import map_id
from graphs.mechanism.sc import SCGraph, arrangement_of
from graphs.reduce.ride_alongs import reduce
from synth.analysis.motion.driven_motion import MotionOptions
from synth.analysis.motion.motion import motion_of
from synth.catalogue.realisation._realise import Kind, Realisation, realise
from synth.synthesis.atlas.columns import name_of_type

_FRAMES = 24
"""Frames of the motion by which the largest fold angle is measured."""


def coordinates_of(code: str) -> dict[str, Any]:
    """Return the values of an SCD graph with coordinates, by its id; or that it was not realised."""
    realised = _realised(code)
    if realised is None:
        return {"realised": False}
    figures = realised.figures.to_json()
    return {
        "realised": True,
        "flat": realised.kind == "sheet",
        "least_angle_deg": figures["least_angle_deg"],
        "edge_ratio": figures["edge_ratio"],
        "fold_file": fold_text(realised.sheet),
        **_folded(realised),
    }


def _realised(code: str) -> Realisation | None:
    """Return a type as a flat sheet, or else in space; None if neither was found."""
    for kind in get_args(Kind):
        with suppress(SynthedraError):
            return realise(mechanism_of_id(code), kind=kind)
    return None


def _folded(realised: Realisation) -> dict[str, Any]:
    """Return the largest fold angle of its motion, degrees, and the reason for its end."""
    try:
        motion = motion_of(realised.configuration, MotionOptions(frames=_FRAMES), collisions=True)
    except SynthedraError as error:
        return {"fold_deg": None, "fold_end": str(error)}
    reached = float(np.degrees(np.abs(motion.path.angles).max(initial=0.0)))
    return {"fold_deg": round(reached, 6), "fold_end": motion.path.stopped or "as far as it was driven"}


_REMEMBERED = 4096
"""SC graphs whose reduction is kept in memory: all placements of open edges on one share it."""
Values = dict[str, Any]


def filled(kind: str, listed: Mapping[str, Any], *, realised: bool) -> Values:
    """Return the values of a row of an atlas from a row of the enumeration of its kind (or from a string).

    With `realised`, SCD graphs get coordinates, and are folded.
    """
    values = _FILLED[kind](listed)
    if kind == "scd" and realised:
        values |= coordinates_of(values["id"])
    return {"kind": kind, "name": name_of_type(kind, values["id"]), **values}


def _of_chain(row: Mapping[str, Any]) -> Values:
    chain = mechanism_of_id(row["code"])
    links = len(chain)
    number = {link: place for place, link in enumerate(chain)}
    _, generators, _ = automorphisms_of(links, [(number[a], number[b]) for a, b in chain.joints.values()])
    orbits = orbits_of(np.array([range(links), *generators], np.int64))
    return {**_common(row), "grounds": tuple(np.flatnonzero(orbits == np.arange(links)).tolist())}


def _of_sc(row: Mapping[str, Any]) -> Values:
    graph = mechanism_of_id(row["code"])
    return {
        **_common(row),
        **_ride_alongs(row["code"]),
        "planar_analogue": _id_or_none(planar_analogue, graph),
        "spherical_analogue": _id_or_none(spherical_analogue, graph),
        "general_form": _id_or_none(generalised_form, graph),
    }


def _id_or_none(make: Callable[[SCGraph], SCGraph], graph: SCGraph) -> str | None:
    """Return the id of another form of a mechanism; None where there is none, as for one with a spatial loop."""
    with suppress(SynthedraError):
        return map_id(make(graph))
    return None


def _of_scd(row: Mapping[str, Any]) -> Values:
    return {
        **_common(row),
        **_ride_alongs(row["sc"]),
        "all_explicit": row["implicit"] == 0,
        "max_sides": len(row["sides"]) + 2,  # the first number counts links of 3 sides
    }


@lru_cache(_REMEMBERED)
def _ride_alongs(code: str) -> Values:
    reduction = reduce(mechanism_of_id(code))
    return {
        "ride_alongs": len(reduction.steps),
        "reduced": chain_id(reduction.graph),
        "arrangement": arrangement_of(mechanism_of_id(code)),
    }


def _of_order(row: Mapping[str, Any]) -> Values:
    chain = mechanism_of_id(row["chain"])
    loops = len(chain.joints) - len(chain) + 1
    return {
        **_common(row),
        "id": f"{row['chain']}:{'-'.join(row['order'])}",  # joints are numbered as in the chain of the id
        "links": len(chain),
        "joints": len(chain.joints),
        "loops": loops,
        "dof": len(chain.joints) - 3 * loops,
    }


def _of_string(row: Mapping[str, Any]) -> Values:
    string = row["string"]
    return {
        "id": string.canonical.text,
        "links": string.creases + 1,
        "joints": string.creases,
        "dof": string.dof,
        "stands_for": string.mechanism,
        "panels": map_id(chain_scd(string)),
        "distance": string.distance,
        "modes": string.count_modes(),
        "comment": string.comment,
    }


def _common(row: Mapping[str, Any]) -> Values:
    """Return a row of an enumeration with the columns of the atlas, which has none for kinds of types."""
    return {"id": row.get("code"), "chain_id": row.get("chain"), "sc_id": row.get("sc"), **row}


_FILLED: dict[str, Callable[[Mapping[str, Any]], Values]] = {
    "chain": _of_chain, "sc": _of_sc, "scd": _of_scd, "order": _of_order, "string": _of_string,
}  # fmt: skip
