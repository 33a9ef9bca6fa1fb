"""SC and SCD graphs as native documents."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.native.names import count_or_names, head, is_count, names, written
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph, SpecialGeometry
from graphs.mechanism.scd import SCDGraph
from graphs.types import JointId, LinkId

__all__ = ["read_sc", "read_scd", "sc_document"]

_SC_KEYS = ("ground", "closing", "special")


def read_sc(value: Mapping[str, Any], check: Checker) -> SCGraph:
    """Read an SC graph from its document."""
    check.mapping(value, "", ("format", "version", "links", "joints", "loops"), _SC_KEYS)
    parts = _ScParts(value, check)
    return check.build(
        lambda: SCGraph(
            parts.links,
            parts.joints,
            parts.loops,
            closing=parts.closing,
            ground=parts.ground,
            special=parts.special,
        ),
        parts.place_of,
    )


def read_scd(value: Mapping[str, Any], check: Checker) -> SCDGraph:
    """Read an SCD graph from its document."""
    check.mapping(value, "", ("format", "version", "links", "joints", "loops", "rotation"), (*_SC_KEYS, "outer"))
    parts = _ScParts(value, check)
    if not isinstance(value["rotation"], dict):
        check.fail("rotation", value["rotation"], "an object: link to its sides")
    of_text = {str(link): link for link in parts.links}
    rotation: dict[LinkId, list[JointId | None]] = {}
    for text, sides in value["rotation"].items():
        place = f"rotation[{json.dumps(text[:40])}]"
        if text not in of_text:
            raise FileError(check.path, place, f"{shown(text)} is no link", "the links")
        rotation[of_text[text]] = [
            None if side is None else check.name(side, f"{place}[{i}]", "a joint id, or null for an open edge")
            for i, side in enumerate(check.list(sides, place, what="a list of sides"))
        ]
    outer = None
    if "outer" in value:
        face = check.mapping(value["outer"], "outer", ("joint", "side"))
        outer = (check.name(face["joint"], "outer.joint"), check.text(face["side"], "outer.side"))
    return check.build(
        lambda: SCDGraph(
            parts.links,
            parts.joints,
            parts.loops,
            rotation=rotation,
            outer=outer,
            closing=parts.closing,
            ground=parts.ground,
            special=parts.special,
        ),
        parts.place_of,
    )


class _ScParts:
    """What SC and SCD files have in common."""

    def __init__(self, value: Mapping[str, Any], check: Checker) -> None:
        self.check = check
        self.links = names(value["links"], "links", check)
        self.joints = self._joints(value["joints"])
        self.loops = self._loops(value["loops"], "loops")
        self.closing = self._loops(value.get("closing", []), "closing")
        self.ground = check.name(value["ground"], "ground", "a link") if "ground" in value else None
        self.special = self._special(value["special"]) if "special" in value else None
        self.index = {joint: i for i, joint in enumerate(self.joints)}

    def _special(self, value: Any) -> SpecialGeometry:
        self.check.mapping(value, "special", ("freedoms", "conditions"))
        freedoms = self.check.integer(value["freedoms"], "special.freedoms", 1)
        listed = self.check.list(value["conditions"], "special.conditions", what="a list of texts")
        texts = [self.check.text(text, f"special.conditions[{i}]") for i, text in enumerate(listed)]
        return self.check.build(
            lambda: SpecialGeometry(freedoms, texts), lambda _: "special.conditions", "special"
        )

    def _joints(self, value: Any) -> dict[JointId, tuple[LinkId, LinkId]]:
        joints: dict[JointId, tuple[LinkId, LinkId]] = {}
        for i, item in enumerate(self.check.list(value, "joints", what="a list of joints")):
            place, ends = f"joints[{i}]", item
            joint: str | int = i
            if isinstance(item, dict):
                self.check.mapping(item, place, ("id", "links"))
                joint, ends = self.check.name(item["id"], f"{place}.id"), item["links"]
            pair = self.check.list(ends, place, 2, "two links")
            if joint in joints:
                raise FileError(self.check.path, place, f"the id {shown(joint)} occurs twice", "distinct ids")
            joints[joint] = (
                self.check.name(pair[0], f"{place}[0]", "a link"),
                self.check.name(pair[1], f"{place}[1]", "a link"),
            )
        return joints

    def _loops(self, value: Any, key: str) -> list[Loop]:
        listed = self.check.list(value, key, what="a list of loops")
        return [self._loop(item, f"{key}[{i}]") for i, item in enumerate(listed)]

    def _loop(self, item: Any, place: str) -> Loop:
        self.check.mapping(item, place, ("joints", "centre"), ("name", "at"))
        around = self.check.list(item["joints"], f"{place}.joints", what="a list of joint ids")
        ids = tuple(self.check.name(j, f"{place}.joints[{k}]", "a joint id") for k, j in enumerate(around))
        if item["centre"] not in [centre.value for centre in Centre]:
            self.check.fail(f"{place}.centre", item["centre"], "finite, infinite or none")
        name, at = (self.check.text(item[k], f"{place}.{k}") if k in item else None for k in ("name", "at"))
        return self.check.build(lambda: Loop(ids, Centre(item["centre"]), name, at), self.place_of, place)

    def place_of(self, part: tuple[str, object]) -> str:
        """Return the JSON path of a part of the graph."""
        key, which = part
        if key == "joints":
            return f"joints[{self.index[which]}]"
        if key in ("loops", "closing"):
            return f"{key}[{which}]"
        return f"rotation[{json.dumps(str(which)[:40])}]" if key == "rotation" else key


def sc_document(sc: SCGraph) -> dict[str, Any]:
    """Return the native document of an SC or SCD graph."""
    result = head("scd" if isinstance(sc, SCDGraph) else "sc") | {
        "links": count_or_names(sc.nodes),
        "joints": _joint_list(sc),
        "loops": list(map(_loop_document, sc.loops)),
    }
    if sc.closing:
        result["closing"] = list(map(_loop_document, sc.closing))
    if sc.ground is not None:
        result["ground"] = written(sc.ground)
    if sc.special is not None:
        result["special"] = {"freedoms": sc.special.freedoms, "conditions": list(sc.special.conditions)}
    if isinstance(sc, SCDGraph):
        result["rotation"] = {
            str(written(link)): [None if s is None else written(s) for s in sides]
            for link, sides in sc.rotation.items()
        }
        if sc.outer is not None:
            result["outer"] = {"joint": written(sc.outer[0]), "side": sc.outer[1]}
    return result


def _joint_list(sc: SCGraph) -> list[Any]:
    if is_count(sc.joints):
        return [[written(a), written(b)] for a, b in sc.joints.values()]
    return [{"id": written(j), "links": [written(a), written(b)]} for j, (a, b) in sc.joints.items()]


def _loop_document(loop: Loop) -> dict[str, Any]:
    result: dict[str, Any] = {"joints": [written(j) for j in loop.joints], "centre": loop.centre.value}
    if loop.name is not None:
        result["name"] = loop.name
    if loop.at is not None:
        result["at"] = loop.at
    return result
