"""Small files of every format, and what becomes of them when a few bytes change."""

from __future__ import annotations

import json
import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import networkx as nx
from oripa import opx_text

from graphs.convert.conversions import to_sc, to_vertex_edge
from graphs.files.formats import READERS, read, write
from synth.making.simulation import write_model

EXTREMES = [b"0", b"-1", b"1e308", b"-1e309", b"NaN", b"null", b"99999999999999999999", b"1e-320", b"2000001", b"true", b'""',
            b"[]", b"{}", b"\xff", b"<", b"&", b"\x00", b"0.1", b"3"]  # fmt: skip

_NATIVE = ["wiener/table3-row3", "wiener/watt", "wiener/concentric-loops", "wampler/fig12", "wampler/crs-platform",
           "surfaces/fig11-stephenson", "surfaces/fig10-four-bar", "hyatt/spherical-four-bar"]  # fmt: skip
_SVG = (
    b'<svg xmlns="http://www.w3.org/2000/svg"><g transform="rotate(30) scale(2 1)" style="stroke:#f00">'
    b'<rect width="9" height="8" stroke="black"/><path d="M0 4h9m-4-4c1 3 3 1 0 8A2 3 4 0 1 9 9z"/>'
    b'<polyline points="1,2 3,4 5,1" stroke="rgb(0,0,255)"/><circle r="3" stroke="blue"/></g></svg>'
)
_DXF = (
    b"0\nSECTION\n2\nTABLES\n0\nLAYER\n2\nA\n62\n1\n6\nDASHED\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
    b"0\nLWPOLYLINE\n8\nCut\n70\n1\n10\n0\n20\n0\n10\n9\n20\n0\n42\n0.3\n10\n9\n20\n8\n10\n0\n20\n8\n"
    b"0\nPOLYLINE\n8\nA\n0\nVERTEX\n10\n0\n20\n0\n0\nVERTEX\n10\n4\n20\n5\n0\nVERTEX\n10\n9\n20\n8\n0\nSEQEND\n"
    b"0\nARC\n8\n0\n62\n5\n10\n0\n20\n0\n40\n4\n50\n0\n51\n90\n0\nCIRCLE\n8\n0\n420\n255\n10\n4\n20\n4\n40\n1\n"
    b"0\nENDSEC\n0\nEOF\n"
)
_OPX = ((1, 0, 0, 9, 0), (1, 9, 0, 9, 8), (1, 9, 8, 0, 8), (1, 0, 8, 0, 0), (2, 0, 0, 9, 8), (3, 9, 0, 0, 8))
_FRAMES = (
    b'{"vertices_coords":[[0,0],[1,0],[1,1],[0,1]],"edges_vertices":[[0,1],[1,2],[2,3],[3,0],[0,2]],'
    b'"edges_assignment":["B","B","B","B","V"],"faces_vertices":[[0,1,2],[0,2,3]],'
    b'"file_frames":[{"frame_inherit":true,"frame_parent":0,"vertices_coords":[[0,0,0],[1,0,0],[1,1,0],[0,0.5,0.5]]}]}'
)


def seeds(data: Path, folder: Path) -> dict[str, list[bytes]]:
    """Return small files of every format, made from the project's own."""
    made: dict[str, list[bytes]] = {suffix: [] for suffix in READERS}

    def wrote(mechanism: object, suffixes: str) -> None:
        for suffix in suffixes.split():
            write(mechanism, folder / f"seed{suffix}", force=True)
            made[suffix].append((folder / f"seed{suffix}").read_bytes())

    patterns = [data / "patterns" / "bird-base.fold", data / "patterns" / "four-bar-vertex.fold"]
    made[".fold"] += [file.read_bytes() for file in patterns]
    made[".fold"].append(_FRAMES)
    made[".json"] += [(data / f"{name}.json").read_bytes() for name in _NATIVE]
    scd = read(data / "wiener" / "table3-row3.json")
    wrote(read(patterns[0]), ".svg .cp .obj .dxf")
    wrote(scd, ".g6 .s6 .graphml .edges .txt")
    wrote(to_vertex_edge(to_sc(scd)), ".json")
    for suffix in (".g6", ".s6"):
        made[suffix].append(made[suffix][0] * 2)
    for name, suffix in (("mjcf", ".xml"), ("urdf", ".urdf"), ("sdf", ".sdf")):
        for file in (data / "linkages" / "bennett.json", data / "joints" / "slider-crank-placed.json"):
            write_model(file, folder / f"seed{suffix}", name, force=True)
            made[suffix].append((folder / f"seed{suffix}").read_bytes())
    made[".svg"].append(_SVG)
    made[".dxf"].append(_DXF)
    made[".opx"].append(opx_text(_OPX).encode())
    made[".edges"].append(b"0 1 {'weight': 3}\n1 2 {}\n2 3 {}\n3 0 {}\n")
    made[".edgelist"] = list(made[".edges"])
    made[".gml"].append("\n".join(nx.generate_gml(nx.relabel_nodes(nx.wheel_graph(6), str))).encode())
    made[".gml"].append(
        b'graph [ multigraph 1 node [ id 0 label "a" ] node [ id 1 label "b" ]'
        b' edge [ source 0 target 1 key "u" type "R" ] edge [ source 1 target 0 key "v" ] ]'
    )
    made[".csv"].append(b',source,target,weight\n0,0,1,1.0\n1,1,2,1.0\n2,"2",3,1.0\n3,3,0,1.0\n')
    return made


def mutated(seed: bytes, rng: random.Random) -> bytes:
    """Change a file a little: bytes, which readers refuse most of the time, or values, which they understand."""
    times = rng.choice([1, 1, 1, 2, 3, 8])
    if rng.random() < 0.4:
        return _bytes_changed(seed, rng, times)
    if seed.startswith(b"{"):
        return _document_changed(seed, rng, min(times, 2))
    return _values_changed(seed, rng, times)


def _bytes_changed(seed: bytes, rng: random.Random, times: int) -> bytes:
    """Change bytes, stretches and words."""
    raw = bytearray(seed)
    for _ in range(times):
        if not raw:
            break
        at, kind = rng.randrange(len(raw)), rng.randrange(8)
        length = rng.choice([1, 2, 8, 40])
        if kind == 0:
            raw[at] = rng.randrange(256)
        elif kind == 1:
            del raw[at : at + length]
        elif kind == 2:
            raw[at:at] = raw[max(0, at - length) : at + length]
        elif kind == 3:
            del raw[at:]
        elif kind == 4:
            raw[at:at] = rng.choice(EXTREMES)
        else:  # most of all, numbers and words become others
            words = list(re.finditer(rb"[-\w.]+", bytes(raw)))
            if words:
                word = rng.choice(words)
                other = rng.choice(words).group() if rng.random() < 0.5 else rng.choice(EXTREMES)
                raw[word.start() : word.end()] = other
    return bytes(raw)


def _values_changed(seed: bytes, rng: random.Random, times: int) -> bytes:
    """Change numbers to numbers, and drop, repeat and swap lines."""
    raw = seed
    for _ in range(times):
        numbers = list(re.finditer(rb"(?<![\w.])-?\d+(\.\d+)?(e[-+]?\d+)?(?![\w.])", raw))
        if numbers and rng.random() < 0.7:
            old = rng.choice(numbers)
            new = rng.choice(numbers).group() if rng.random() < 0.5 else str(_other_number(old.group(), rng)).encode()
            raw = raw[: old.start()] + new + raw[old.end() :]
            continue
        lines = raw.splitlines(keepends=True)
        i, j = rng.randrange(len(lines) + 1), rng.randrange(len(lines) + 1)
        lines[i:i] = lines[j : j + 1]
        if rng.random() < 0.7:
            del lines[j : j + 1]
        raw = b"".join(lines)
    return raw


def _other_number(text: bytes, rng: random.Random) -> float:
    """Return a number near another, of its kind, or far from any."""
    if rng.random() < 0.1:
        return rng.choice([1e-320, 1e150, 1e308, 250_000, 0.5])
    if re.fullmatch(rb"-?\d{1,9}", text):
        whole = int(text)
        return rng.choice([whole + 1, whole - 1, -whole, 0, whole // 3, 2 * whole, 3, 40])
    number = float(text)
    return rng.choice([number + 1, -number, 0.0, number / 3, number + 1e-9, number * (1 + 1e-7), 1e-5, 90.0])


def _document_changed(seed: bytes, rng: random.Random, times: int) -> bytes:
    """Change values of a JSON document: items dropped, repeated, swapped, and put in the place of others."""
    document = json.loads(seed)
    for _ in range(times):
        places = list(_places(document))
        holder, key = rng.choice(places)
        kind, value = rng.randrange(8), holder[key]
        if kind == 0:
            del holder[key]
        elif kind == 1 and isinstance(holder, list):
            holder.insert(key, json.loads(json.dumps(value)))
        elif kind == 2:
            others = [within[at] for within, at in places if type(within[at]) is type(value)]
            holder[key] = json.loads(json.dumps(rng.choice(others)))
        elif kind == 3:
            holder[key] = rng.choice([None, True, "", [], {}, 0, -1, 2.5, 1e308, "joints", [[0, 1]], [0, 1, 2]])
        elif isinstance(value, int | float) and not isinstance(value, bool):
            holder[key] = _other_number(str(value).encode(), rng)
        elif isinstance(value, str):
            holder[key] = rng.choice(["finite", "infinite", "none", "F", "C", "V", "B", value * 2])
        elif isinstance(value, list):
            rng.shuffle(value)
        if not document:
            break
    return json.dumps(document).encode()


def _places(value: Any) -> Iterator[tuple[Any, Any]]:
    """Yield where values are in a document: what holds them, and key or index."""
    for key in list(value) if isinstance(value, dict) else range(len(value)):
        yield value, key
        if isinstance(value[key], dict | list):
            yield from _places(value[key])
