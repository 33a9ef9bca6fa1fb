"""STEP for CAD: each body a part of exact solids, an assembly with their placements, hinge axes as curves.

ISO 10303-21 (the file) and AP214 (what is in it): plates are prisms of planes and lines, bars have a cylinder and
two circles, shells have parts of cones and cylinders. Millimetres. A part has the axes of the assembly, and its
origin at the hinge that carries it.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.geometry import frame_about, unit
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.making.simulation.assembly import Assembly
from synth.making.simulation.bodies import Bar, Plate, Polyhedron, Shape, Shell, springs_and_moments

_MILLIMETRES = 1000.0
_ACCURACY = 1e-7
"""Points nearer than this are one for whoever reads the file, millimetres."""
_HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('synthedra'),'2;1');
FILE_NAME('mechanism.step','',(''),(''),'','synthedra','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
"""


def step_bytes(assembly: Assembly) -> bytes:
    """Return an assembly as STEP; UnsolvableError if its bodies are thinner than points of a file are apart."""
    if _MILLIMETRES * assembly.thickness <= _ACCURACY:
        thickness = f"the thickness is {_MILLIMETRES * assembly.thickness:.2g} mm"
        raise UnsolvableError(f"{thickness}, and STEP files are accurate to {_ACCURACY:g} mm; try a larger size")
    file = _File()
    whole = file.product("mechanism")
    parts = []
    for number, body in enumerate(assembly.bodies):
        origin = assembly.origin(number)
        solids = [_solid(file, shape, origin) for shape in body.shapes]
        frame = file.placement(np.zeros(3))
        items = ",".join([frame, *solids])
        represented = file.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION({_text(body.name)},({items}),{file.context})")
        parts.append((body.name, file.product(body.name), represented, frame, _MILLIMETRES * origin))
    if assembly.hinges:
        lines = [_axis(file, hinge.name, hinge.end(-1.0), hinge.end(1.0)) for hinge in assembly.hinges]
        curves = file.add(f"GEOMETRIC_CURVE_SET('hinge axes',({','.join(lines)}))")
        frame = file.placement(np.zeros(3))
        kind = "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION"
        represented = file.add(f"{kind}('hinge axes',({frame},{curves}),{file.context})")
        parts.append(("hinge axes", file.product("hinge axes"), represented, frame, np.zeros(3)))
    _assemble(file, whole, parts)
    return (_HEAD + "".join(file.lines) + "ENDSEC;\nEND-ISO-10303-21;\n").encode("ascii")


class _File:
    """The lines of a file, and what all of it shares."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._context = self.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')")
        self.add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{self._context})")
        self._products = self.add(f"PRODUCT_CONTEXT('',{self._context},'mechanical')")
        self._design = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{self._context},'design')")
        length = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid = self.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        measure = f"LENGTH_MEASURE({_real(_ACCURACY)}),{length},'distance_accuracy_value','confusion accuracy'"
        uncertain = self.add(f"UNCERTAINTY_MEASURE_WITH_UNIT({measure})")
        self.context = self.add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertain}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid}))REPRESENTATION_CONTEXT('',''))"
        )

    def add(self, text: str) -> str:
        """Add an entity; return its name."""
        name = f"#{len(self.lines) + 1}"
        self.lines.append(f"{name}={text};\n")
        return name

    def product(self, name: str) -> str:
        """Add a product; return its definition."""
        product = self.add(f"PRODUCT({_text(name)},{_text(name)},'',({self._products}))")
        self.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part','',({product}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
        return self.add(f"PRODUCT_DEFINITION('design','',{formation},{self._design})")

    def shape(self, definition: str, represented: str | None) -> str:
        """Say what shape a product, or a use of it, has."""
        shape = self.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        if represented is not None:
            self.add(f"SHAPE_DEFINITION_REPRESENTATION({shape},{represented})")
        return shape

    def point(self, point: Floats) -> str:
        """Return a point, millimetres."""
        return self.add(f"CARTESIAN_POINT('',{_reals(point)})")

    def placement(self, origin: Floats, axes: Floats | None = None) -> str:
        """Return a frame whose axes are columns; by default those of the world."""
        x, z = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)) if axes is None else (axes[:, 0], axes[:, 2])
        along, across = (self.add(f"DIRECTION('',{_reals(axis)})") for axis in (z, x))
        return self.add(f"AXIS2_PLACEMENT_3D('',{self.point(origin)},{along},{across})")

    def line(self, start: Floats, end: Floats) -> str:
        """Return the line from a point to another."""
        along = self.add(f"DIRECTION('',{_reals(unit(end - start))})")
        vector = self.add(f"VECTOR('',{along},1.)")
        return self.add(f"LINE('',{self.point(start)},{vector})")

    def face(self, edges: Sequence[tuple[str, bool]], surface: str, *, outward: bool = True) -> str:
        """Return a face within edges, each with whether it goes along; a surface's normal goes outward or inward."""
        around = [self.add(f"ORIENTED_EDGE('',*,*,{edge},{'.T.' if along else '.F.'})") for edge, along in edges]
        loop = self.add(f"EDGE_LOOP('',({','.join(around)}))")
        bound = self.add(f"FACE_OUTER_BOUND('',{loop},.T.)")
        return self.add(f"ADVANCED_FACE('',({bound}),{surface},{'.T.' if outward else '.F.'})")

    def solid(self, faces: Sequence[str]) -> str:
        """Return the solid within closed faces."""
        shell = self.add(f"CLOSED_SHELL('',({','.join(faces)}))")
        return self.add(f"MANIFOLD_SOLID_BREP('',{shell})")


def _solid(file: _File, shape: Shape, origin: Floats) -> str:
    if isinstance(shape, Shell):
        return _shell(file, shape, origin)
    if isinstance(shape, Polyhedron):
        return _polyhedron(file, shape, origin)
    return _bar(file, shape, origin) if isinstance(shape, Bar) else _plate(file, shape, origin)


def _polyhedron(file: _File, solid: Polyhedron, origin: Floats) -> str:
    """Return a solid of triangles; each edge is written once, and passed both ways."""
    corners = _MILLIMETRES * (solid.corners - origin)
    vertices = [file.add(f"VERTEX_POINT('',{file.point(corner)})") for corner in corners]
    edges: dict[tuple[int, int], str] = {}
    faces = []
    for triangle in solid.triangles.tolist():
        around = []
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            low, high = min(a, b), max(a, b)
            if (low, high) not in edges:
                line = file.line(corners[low], corners[high])
                edges[low, high] = file.add(f"EDGE_CURVE('',{vertices[low]},{vertices[high]},{line},.T.)")
            around.append((edges[low, high], a == low))
        first, second, third = corners[triangle]
        along = unit(second - first)
        normal = unit(np.cross(second - first, third - first))
        frame = np.column_stack([along, np.cross(normal, along), normal])
        faces.append(file.face(around, file.add(f"PLANE('',{file.placement(first, frame)})")))
    return file.solid(faces)


def _plate(file: _File, plate: Plate, origin: Floats) -> str:
    """Return a prism: corners of the lower face, then of the upper one."""
    axes, count = plate.plane.axes, len(plate.plane.flat)
    middle = plate.plane.origin - origin
    flat = middle + plate.plane.flat @ axes[:, :2].T
    rise = plate.thickness / 2.0 * plate.plane.normal
    corners = _MILLIMETRES * np.concatenate([flat - rise, flat + rise])
    vertices = [file.add(f"VERTEX_POINT('',{file.point(corner)})") for corner in corners]

    def edge(a: int, b: int) -> str:
        line = file.line(corners[a], corners[b])
        return file.add(f"EDGE_CURVE('',{vertices[a]},{vertices[b]},{line},.T.)")

    after = [(place + 1) % count for place in range(count)]
    low = [edge(place, after[place]) for place in range(count)]
    high = [edge(count + place, count + after[place]) for place in range(count)]
    up = [edge(place, count + place) for place in range(count)]
    below = file.add(f"PLANE('',{file.placement(corners[0], np.column_stack([axes[:, 0], -axes[:, 1], -axes[:, 2]]))})")
    above = file.add(f"PLANE('',{file.placement(corners[count], axes)})")
    faces = [
        file.face([(each, False) for each in reversed(low)], below),
        file.face([(each, True) for each in high], above),
    ]
    for place in range(count):
        along = unit(corners[after[place]] - corners[place])
        outward = np.cross(along, plate.plane.normal)
        frame = np.column_stack([along, plate.plane.normal, outward])
        surface = file.add(f"PLANE('',{file.placement(corners[place], frame)})")
        around = [(low[place], True), (up[after[place]], True), (high[place], False), (up[place], False)]
        faces.append(file.face(around, surface))
    return file.solid(faces)


def _bar(file: _File, bar: Bar, origin: Floats) -> str:
    """Return a cylinder with two circles and a seam."""
    along = unit(bar.end - bar.start)
    first = frame_about(along)[0]
    axes = np.column_stack([first, np.cross(along, first), along])
    radius = _real(_MILLIMETRES * bar.radius)
    ends = _MILLIMETRES * np.array([bar.start - origin, bar.end - origin])
    marks = ends + _MILLIMETRES * bar.radius * first
    vertices = [file.add(f"VERTEX_POINT('',{file.point(mark)})") for mark in marks]
    circles = []
    for end, vertex in zip(ends, vertices, strict=True):
        circle = file.add(f"CIRCLE('',{file.placement(end, axes)},{radius})")
        circles.append(file.add(f"EDGE_CURVE('',{vertex},{vertex},{circle},.T.)"))
    seam = file.add(f"EDGE_CURVE('',{vertices[0]},{vertices[1]},{file.line(marks[0], marks[1])},.T.)")
    below = file.add(f"PLANE('',{file.placement(ends[0], np.column_stack([axes[:, 0], -axes[:, 1], -axes[:, 2]]))})")
    above = file.add(f"PLANE('',{file.placement(ends[1], axes)})")
    round_about = file.add(f"CYLINDRICAL_SURFACE('',{file.placement(ends[0], axes)},{radius})")
    side = [(circles[0], True), (seam, True), (circles[1], False), (seam, False)]
    return file.solid([
        file.face([(circles[0], False)], below), file.face([(circles[1], True)], above), file.face(side, round_about),
    ])  # fmt: skip


def _shell(file: _File, shell: Shell, origin: Floats) -> str:
    """Return a profile swept about an axis: two plane ends, and a face of a cone, a cylinder or a plane for each side.

    The axes of the circles are (third, first, second) of the shell, so that azimuths are theirs. The profile goes
    counter-clockwise in (distance, height), which looks against the azimuth: the first end is passed forwards.
    """
    axes = shell.axes[:, [2, 0, 1]]
    up, profile, middle = axes[:, 2], _MILLIMETRES * shell.profile, _MILLIMETRES * (shell.origin - origin)
    ends = _MILLIMETRES * (shell.at(shell.start + np.array([0.0, shell.width])) - origin)
    vertices = [[file.add(f"VERTEX_POINT('',{file.point(corner)})") for corner in corners] for corners in ends]
    after = [1, 2, 3, 0]

    def side(end: int, corner: int) -> str:
        line = file.line(ends[end, corner], ends[end, after[corner]])
        return file.add(f"EDGE_CURVE('',{vertices[end][corner]},{vertices[end][after[corner]]},{line},.T.)")

    def arc(corner: int) -> str:
        distance, height = profile[corner]
        circle = file.add(f"CIRCLE('',{file.placement(middle + height * up, axes)},{_real(distance)})")
        return file.add(f"EDGE_CURVE('',{vertices[0][corner]},{vertices[1][corner]},{circle},.T.)")

    sides = [[side(end, corner) for corner in range(4)] for end in range(2)]
    arcs = [arc(corner) for corner in range(4)]
    faces = []
    for end, way in enumerate((1.0, -1.0)):
        along = unit(ends[end, 0] - ends[end, 1])
        normal = unit(way * np.cross(ends[end, 1] - ends[end, 0], ends[end, 2] - ends[end, 1]))
        plane = file.add(
            f"PLANE('',{file.placement(ends[end, 0], np.column_stack([along, np.cross(normal, along), normal]))})"
        )
        edges = [(edge, not end) for edge in (sides[end] if not end else reversed(sides[end]))]
        faces.append(file.face(edges, plane))
    for corner in range(4):
        other = after[corner]
        edges = [(sides[0][corner], False), (arcs[corner], True), (sides[1][corner], True), (arcs[other], False)]
        surface, outward = _swept(file, middle, axes, profile[[corner, other]])
        faces.append(file.face(edges, surface, outward=outward))
    return file.solid(faces)


def _swept(file: _File, middle: Floats, axes: Floats, side: Floats) -> tuple[str, bool]:
    """Return the surface of a side of a profile about an axis, and whether its normal leaves the solid.

    Normals of cones and cylinders go away from the axis. A cone opens along its axis, so the axis is turned where
    it would be pointed at the other end.
    """
    (distance, height), (wider, higher) = side
    turned = axes * np.array([1.0, -1.0, -1.0])
    place = middle + height * axes[:, 2]
    if abs(higher - height) <= DOUBLE.parallel * abs(wider - distance):
        return file.add(f"PLANE('',{file.placement(place, turned if wider > distance else axes)})"), True
    outward = bool(higher > height)
    if abs(wider - distance) <= DOUBLE.parallel * abs(higher - height):
        return file.add(f"CYLINDRICAL_SURFACE('',{file.placement(place, axes)},{_real(distance)})"), outward
    opens = (wider - distance) * (higher - height) > 0.0
    angle = _real(float(np.arctan2(abs(wider - distance), abs(higher - height))))
    frame = file.placement(place, axes if opens else turned)
    return file.add(f"CONICAL_SURFACE('',{frame},{_real(distance)},{angle})"), outward


def _axis(file: _File, name: str, start: Floats, end: Floats) -> str:
    """Return a hinge as a piece of a line."""
    start, end = _MILLIMETRES * start, _MILLIMETRES * end
    length = _real(float(np.linalg.norm(end - start)))
    trims = f"(PARAMETER_VALUE(0.)),(PARAMETER_VALUE({length})),.T.,.PARAMETER."
    return file.add(f"TRIMMED_CURVE({_text(name)},{file.line(start, end)},{trims})")


def _assemble(file: _File, whole: str, parts: Sequence[tuple[str, str, str, str, Floats]]) -> None:
    """Place parts, (name, product, representation, its frame, origin), in the whole."""
    places = [file.placement(origin) for *_, origin in parts]
    frame = file.placement(np.zeros(3))
    together = file.add(f"SHAPE_REPRESENTATION('mechanism',({','.join([frame, *places])}),{file.context})")
    file.shape(whole, together)
    for number, ((name, product, represented, own, _), place) in enumerate(zip(parts, places, strict=True), 1):
        file.shape(product, represented)
        use = file.add(f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}',{_text(name)},'',{whole},{product},$)")
        shape = file.shape(use, None)
        moved = file.add(f"ITEM_DEFINED_TRANSFORMATION('','',{own},{place})")
        relation = file.add(
            f"(REPRESENTATION_RELATIONSHIP('','',{represented},{together})"
            f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})SHAPE_REPRESENTATION_RELATIONSHIP())"
        )
        file.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{shape})")


def _real(number: float) -> str:
    """Return a number as the format has it: with a point."""
    text = f"{number + 0.0:.17g}"
    mantissa, letter, exponent = text.partition("e")
    return f"{mantissa if '.' in mantissa else mantissa + '.'}{letter and 'E'}{exponent}"


def _reals(numbers: Iterable[float]) -> str:
    return f"({','.join(map(_real, numbers))})"


def _text(text: str) -> str:
    """Return a string as the format has it: quotes doubled, letters beyond ASCII by their numbers."""
    coded = "".join(
        letter * (1 + (letter in "'\\")) if " " <= letter <= "~" else f"\\X4\\{ord(letter):08X}\\X0\\"
        for letter in text
    )
    return f"'{coded}'"


def lost_as_step(assembly: Assembly) -> tuple[str, ...]:
    """Return what STEP does not hold: joints are no part of it, their axes are curves."""
    joints = [f"{numbered(len(assembly.hinges), 'joint')}, but for the axes"] if assembly.hinges else []
    return (*joints, *springs_and_moments(assembly.hinges), *(["the motion"] if len(assembly.path) > 1 else []))
