"""Templates of thick panels: outlines of plies, holes on both sides of each hinge, the parts list."""

import re
from itertools import combinations

import numpy as np
import pytest
import shapely
import shapely.affinity
from commands import run

import synth
from graphs.files.formats import read
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids


@pytest.fixture(scope="module")
def thick():
    return synth.thicken(synth.generate("miura").mechanism, thickness=3.0, scale=60.0, collisions=False)


def test_outlines_are_the_plies(thick):
    template = thick.template()
    area = sum(ply.outline.area for ply in thick.plates.plies)
    assert sum(piece.covered.area for piece in template.pieces) == pytest.approx(area)
    assert len(template.steps) == 1 + 9 + 12


def test_screws_of_both_panels_are_in_line_with_the_hinge(thick):
    for seat in thick.seats():
        one, other = (
            sorted(centre.round(9).tolist() for at, centre in thick.bores[seat.joint] if at == panel)
            for panel in seat.panels
        )
        assert len(one) == len(other) == 2
        start, end = seat.lines[0]
        line = shapely.LineString([start, end])
        for first, second in zip(one, other, strict=True):
            middle = shapely.Point((np.array(first) + np.array(second)) / 2.0)
            assert line.distance(middle) < 1e-8
            assert line.distance(shapely.Point(first)) == pytest.approx(1.5)


def test_bores_are_taken_from_the_solids():
    sheet = synth.generate("miura", rows=2, columns=2).mechanism
    whole, bored = (
        synth.thicken(sheet, thickness=3.0, scale=60.0, collisions=False, hinges=hinges)
        for hinges in ("tape", "screws")
    )
    count = sum(map(len, bored.bores.values()))
    assert count == 16
    # A regular polygon of 12 sides round a circle of 0.9 mm, through plies of 3 mm.
    area = 12 * np.tan(np.pi / 12) * 0.45**2
    assert whole.plates.volume - bored.plates.volume == pytest.approx(count * area * 3.0)
    for thick in (whole, bored):
        for mesh in thick.plates.meshes:
            sides = [tuple(pair) for a, b in ((0, 1), (1, 2), (2, 0)) for pair in mesh.triangles[:, [a, b]].tolist()]
            assert len(set(sides)) == len(sides)
            assert {(b, a) for a, b in sides} == set(sides)
        shapes = sum(volume_of(shape) for shape in thick.solids.shapes)
        assert shapes == pytest.approx(thick.plates.volume)
        assert thick.to_json()["hinges"] == thick.hinges


@pytest.mark.parametrize("how", ["tapered", "offset"])
def test_tapered_and_offset_panels_are_bored(how):
    sheet = synth.generate("miura", rows=2, columns=2).mechanism
    arguments = {"thickness": 3.0, "scale": 60.0, "how": how, "collisions": False}
    whole, bored = (synth.thicken(sheet, hinges=hinges, **arguments) for hinges in ("tape", "screws"))
    count = sum(map(len, bored.bores.values()))
    assert count >= 16
    area = 12 * np.tan(np.pi / 12) * 0.45**2
    # Stand-offs are as high as the levels of the layers lie apart; a tapered panel is 3 mm high.
    assert whole.plates.volume - bored.plates.volume >= 0.99 * count * area * (3.0 if how == "tapered" else 0.06)
    if how == "tapered":
        assert whole.plates.volume - bored.plates.volume == pytest.approx(count * area * 3.0)
    for mesh in bored.plates.meshes:
        sides = [tuple(pair) for a, b in ((0, 1), (1, 2), (2, 0)) for pair in mesh.triangles[:, [a, b]].tolist()]
        assert len(set(sides)) == len(sides)
        assert {(b, a) for a, b in sides} == set(sides)
    assert sum(map(mesh_volume, bored.plates.meshes)) == pytest.approx(bored.plates.volume)
    assert "no room" not in " ".join(bored.template().steps)


def mesh_volume(mesh):
    sides = mesh.corners[mesh.triangles]
    return np.einsum("ti,ti->", sides[:, 0], np.cross(sides[:, 1], sides[:, 2])) / 6.0


def volume_of(shape):
    sides = np.array(shape.corners)[np.array(shape.triangles)]
    return np.einsum("ti,ti->", sides[:, 0], np.cross(sides[:, 1], sides[:, 2])) / 6.0


def test_the_note_names_heights_holes_and_bevels(thick):
    steps = "\n".join(thick.template().steps)
    assert "Panel 4: glue 3 plies on each other, -3 to 0; 0 to 3; 3 to 6." in steps
    assert (
        "Crease 5, valley, panels 1 and 2: axis at 9, 60 long, 4 holes of 0.9 for screws of at most 0.84, "
        "1.5 from the axis." in steps
    )
    sheet = synth.generate("miura").mechanism
    arguments = {"thickness": 3.0, "scale": 60.0, "angle": np.radians(120.0), "collisions": False}
    bevelled = synth.thicken(sheet, how="tapered", **arguments).template()
    assert len(bevelled.pieces) == 27
    bevels = re.findall(r"bevelled by ([0-9.]+) degrees", " ".join(bevelled.steps))
    assert max(map(float, bevels)) == pytest.approx(60.0)
    apart = synth.thicken(sheet, how="hinge", **arguments)
    assert (apart.to_json()["hinges"], apart.bores) == ("strip", {})
    strips = " ".join(apart.template().steps)
    gaps = [float(gap) for gap in re.findall(r"a strip over a gap of ([0-9.]*[0-9])", strips)]
    assert max(gaps) == pytest.approx(3.0 * np.tan(np.radians(60.0)), abs=1e-3)


def test_the_command_writes_templates(tmp_path):
    source, target = tmp_path / "miura.fold", tmp_path / "parts.dxf"
    synth.write(synth.generate("miura", rows=2, columns=2).mechanism, source)
    options = ("--thickness", "3", "--scale", "60", "--no-collisions")
    assert f"written: {target}" in run("thicken", source, *options, "-o", target).output
    assert {"CUT", "MOUNTAIN", "VALLEY"} <= set(re.findall(r"[A-Z]{3,}", target.read_text()))
    run("thicken", source, *options, "-o", tmp_path / "parts.svg")
    assert "4 holes of 0.9" in " ".join(path.read_text() for path in tmp_path.glob("parts*.svg"))
    assert read(source)


class Cut:
    """A piece as it is cut out: its name, its numbered hinge lines, from the end beside the number, and its holes."""

    def __init__(self, piece, turn, shift):
        def place(point):
            return turn @ np.array(point) + shift

        lines = [(place(s.start), place(s.end)) for s in piece.strokes if s.kind in ("VALLEY", "MOUNTAIN")]
        self.lines, rings = {}, []
        for text in piece.texts:
            at = place(text.at)
            if ":" in text.words:
                panel, level = text.words.split(": ")
                self.panel, (self.low, self.high) = int(panel), map(float, level.split(" to "))
                continue
            both = [ends for one in lines for ends in (one, one[::-1])]
            ends = min(both, key=lambda ends: np.linalg.norm(0.75 * ends[0] + 0.25 * ends[1] - at))
            self.lines[text.words] = np.array(ends)
        for stroke in piece.strokes:
            if stroke.kind == "CUT":
                start, end = place(stroke.start), place(stroke.end)
                if rings and np.allclose(rings[-1][-1], start, atol=1e-9) and not np.allclose(rings[-1][0], start):
                    rings[-1].append(end)
                else:
                    rings.append([start, end])
        closed = [shapely.Polygon(ring) for ring in rings if len(ring) > 3]
        largest = max(closed, key=lambda ring: ring.area)
        self.outline = largest
        self.holes = [np.array(ring.centroid.coords[0]) for ring in closed if ring is not largest]

    def moved(self, own, wanted):
        """Lay it down so that one of its lines comes to lie on a line of what is there."""
        (a, b), (c, d) = self.lines[own], wanted
        (x, y), (u, v) = (b - a) / np.linalg.norm(b - a), (d - c) / np.linalg.norm(d - c)
        turn = np.array([[x * u + y * v, y * u - x * v], [x * v - y * u, x * u + y * v]])
        shift = (c + d) / 2 - turn @ ((a + b) / 2)
        self.lines = {crease: ends @ turn.T + shift for crease, ends in self.lines.items()}
        self.holes = [turn @ hole + shift for hole in self.holes]
        self.outline = shapely.affinity.affine_transform(self.outline, [*turn.ravel(), *shift])


def test_the_miura_sheet_is_put_together_by_its_note_alone():
    """Pieces are shuffled; only their strokes and words and the note say where they go."""
    thick = synth.thicken(synth.generate("miura").mechanism, thickness=3.0, scale=60.0)
    template = thick.template()
    random = np.random.default_rng(3)
    cut = []
    for number in random.permutation(len(template.pieces)):
        turned = random.uniform(0.0, 2.0 * np.pi)
        turn = np.array([[np.cos(turned), -np.sin(turned)], [np.sin(turned), np.cos(turned)]])
        cut.append(Cut(template.pieces[number], turn, random.uniform(-500.0, 500.0, 2)))
    note = " ".join(template.steps)
    words = re.findall(r"Crease (\d+), \w+, panels (\d+) and (\d+): axis at ([-.\d]+),", note)
    creases = {int(crease): ((int(one), int(other)), float(height)) for crease, one, other, height in words}
    assert len(creases) == 12
    # Begin with a ply of panel 0; lay each piece on a line of a piece that lies: of its panel or over a hinge.
    waiting = sorted(cut, key=lambda one: (one.panel, one.low))
    laid = [waiting.pop(0)]
    while waiting:
        piece, crease, base = next(
            (piece, crease, base)
            for piece in waiting
            for base in laid
            for crease in piece.lines
            if crease in base.lines and {piece.panel, base.panel} <= set(creases[int(crease.split(".")[0])][0])
        )
        piece.moved(crease, base.lines[crease])
        laid.append(piece)
        waiting.remove(piece)
    axes = {}
    for crease, (pair, height) in creases.items():
        own = [piece for piece in laid if piece.panel in pair]
        parts = {word for piece in own for word in piece.lines if int(word.split(".")[0]) == crease}
        # Hinges are in line: each part in all pieces of both panels.
        ends = [np.array([piece.lines[word] for piece in own if word in piece.lines]) for word in sorted(parts)]
        assert max(np.ptp(there, axis=0).max() for there in ends) < 0.01
        a, along = ends[0][0][0], np.subtract(*ends[0][0][::-1])
        along = along / np.linalg.norm(along)
        across = np.array([-along[1], along[0]])
        assert max(abs((there - a) @ across).max() for there in ends) < 0.01
        facing = []
        for panel in pair:  # both have material at the axis, and holes as far from it, opposite each other
            there = [piece for piece in own if piece.panel == panel and piece.low <= height <= piece.high]
            assert there
            holes = [hole - a for piece in there for hole in piece.holes]
            facing.append({round(float(hole @ along), 2) for hole in holes if abs(abs(hole @ across) - 1.5) < 0.01})
        assert len(facing[0] & facing[1]) >= 2
        axes[crease] = ((*a, height), (*along, 0.0))
    # No two panels cover each other at one height, and what was built moves as it should.
    for one, other in combinations(laid, 2):
        if one.panel != other.panel and min(one.high, other.high) - max(one.low, other.low) > 1e-9:
            assert one.outline.intersection(other.outline).area < 0.01
    graph = SCGraph(range(9), {crease: pair for crease, (pair, _) in creases.items()})
    motion = synth.move(HingedSolids(graph, axes), drive={5: np.radians(60.0)}, frames=4)
    assert motion.freedoms == 1
    assert motion.closure < 1e-12
