"""Mobility by count: the equations of the papers, one function each.

Wiener 2016, Eqs. 1 to 4 and 8; Wampler, Larson, Erdman 2007, Eqs. 5 to 10. Beside them the loop form and the count
of closed surfaces. All are formulas: they hold for a generic realisation of a type, and not for every type
(docs/theory/mobility-by-count.md). :mod:`graphs.count.report` says which of them apply to a mechanism.
"""

from collections.abc import Iterable

from graphs.mechanism.polyhedron import PolyhedronModel


def traditional_cgk(links: int, freedoms: Iterable[int], constraint_space: int) -> int:
    """Chebychev-Gruebler-Kutzbach: M = lambda (N - 1) - sum (lambda - f) (Wiener 2016 and Wampler 2007, Eq. 1).

    The text below Wiener's Eq. 1 swaps the words spherical and spatial; his Table 1 is right.

    Parameters
    ----------
    links : int
        N, the fixed link included.
    freedoms : iterable of int
        f of each joint: 1 for revolute, 3 for spherical.
    constraint_space : int
        lambda: 3 if all axes pass through one centre (spherical, planar), 6 in space.

    Examples
    --------
    >>> traditional_cgk(6, [1] * 6, 3), traditional_cgk(6, [1] * 6, 6)  # a six-bar loop, spherical and spatial
    (3, 0)
    """
    return constraint_space * (links - 1) - sum(constraint_space - f for f in freedoms)


def modified_cgk(links: int, joints: int, constraint_space: int, freedoms: int | None = None) -> int:
    """Modified C-G-K: M = lambda (N - J - 1) + sum f (Wiener 2016, Eq. 2).

    It holds for spherical systems, whether or not loops share their centre, where Eq. 1 presumes one centre.

    Parameters
    ----------
    links, joints : int
        N, the fixed link included, and J.
    constraint_space : int
        lambda of every loop: 3 with a centre, 6 without.
    freedoms : int, optional
        Sum of the freedoms f of all joints; J, if all are revolute.

    Examples
    --------
    >>> modified_cgk(6, 7, 3)  # Watt's six-bar with one centre or with two
    1
    >>> modified_cgk(4, 4, 6, 1 + 3 + 3 + 1)  # R-S-S-R
    2
    """
    return constraint_space * (links - joints - 1) + (joints if freedoms is None else freedoms)


def spherical_system(links: int, joints: int) -> int:
    """Spherical systems: M = 3 (N - 1) - 2 J (Wiener 2016, Eq. 3; Wampler 2007, Eq. 2).

    Parameters
    ----------
    links, joints : int
        N, the fixed link included, and J. Every loop has a centre.

    Examples
    --------
    >>> spherical_system(8, 10)
    1
    """
    return 3 * (links - 1) - 2 * joints


def polyhedron_equation(vertices: int, implicit_centres: int, edges: int) -> int:
    """Polyhedron model: M = 3 (V + C) - E - 6, with E = E_ext + E_int (Wiener 2016, Eq. 4).

    Parameters
    ----------
    vertices, implicit_centres : int
        V, vertices of the links; one that several links share counts once. C, loops (not classes) whose centre the
        links do not reach.
    edges : int
        E_ext, the joints and open edges, and E_int, 2 n - 6 of each link of n sides.

    Examples
    --------
    >>> polyhedron_equation(6, 0, 11), polyhedron_equation(9, 1, 23)  # Wiener, Table 3, rows 1 and 3
    (1, 1)
    """
    return 3 * (vertices + implicit_centres) - edges - 6


def loop_form(freedoms: int, centred_loops: int, spatial_loops: int) -> int:
    """Loop form: M = sum f - 3 L_sph - 6 L_spat, over independent loops.

    For a connected SCD graph it equals :func:`polyhedron_equation` identically.

    Parameters
    ----------
    freedoms : int
        Sum of the freedoms of all joints: J, if all are revolute.
    centred_loops, spatial_loops : int
        Independent loops with a centre and without.

    Examples
    --------
    >>> loop_form(11, 1, 1)  # the hybrid ten-bar of Wiener 4.1.4.6
    2
    """
    return freedoms - 3 * centred_loops - 6 * spatial_loops


def closed_surface(joints: int, faces: int, spatial_loops: int, centres: Iterable[int]) -> int:
    """Closed surfaces, every face with a centre: M = J - 3 F - 6 L_spat + 6.

    By duality the joint axes are the bars of a framework whose joints are the centres: motions of the one are
    stresses of the other, of dimension J - (3 F - 6).

    Parameters
    ----------
    joints, faces, spatial_loops : int
        J, F with the closing faces, and loops left over (handles).
    centres : iterable of int
        Distinct centres of each closed surface. Six conditions too many are counted if three or more centres are
        not in line, 5 if there are two, 3 if there is one.

    Examples
    --------
    >>> closed_surface(24, 10, 0, [10])  # the cap of the inflatable cube (Wiener 3.3.6)
    0
    """
    surplus = sum({0: 0, 1: 3, 2: 5}.get(number, 6) for number in centres)
    return joints - 3 * faces - 6 * spatial_loops + surplus


def wampler_rods(vertices: int, rods: int) -> int:
    """Vertices and rods: M = 3 V - E - 6 (Wampler 2007, Eq. 5).

    Parameters
    ----------
    vertices, rods : int
        V and E, those of the fixed link too.

    Examples
    --------
    >>> wampler_rods(5, 8)  # Fig. 9, a spherical four-bar
    1
    """
    return 3 * vertices - rods - 6


def wampler_points(vertices: int, rods: int, on_plane: int, on_line: int) -> int:
    """Add points on planes and lines: M = 3 V - E - P - 2 L - 6 (Wampler 2007, Eq. 6).

    Parameters
    ----------
    vertices, rods, on_plane, on_line : int
        V and E as of `wampler_rods`; P and L: points that stay on a plane of a link, on a line of one.

    Examples
    --------
    >>> wampler_points(6, 6, 0, 2) - wampler_points(6, 6, 0, 0)  # a cylindric joint: two points on a line
    -4
    """
    return wampler_rods(vertices, rods) - on_plane - 2 * on_line


def wampler_remote(vertices: int, rods: int, on_plane: int, on_line: int, remote: Iterable[int]) -> int:
    """Add remote centres: M = 3 V + sum k S_{+k} - E - P - 2 L - 6 (Wampler 2007, Eqs. 7 and 8).

    Parameters
    ----------
    vertices, rods, on_plane, on_line : int
        As of `wampler_points`.
    remote : iterable of int
        k of each remote centre; Eq. 7 is the case that all are 3.

    Examples
    --------
    >>> wampler_remote(8, 20, 0, 0, [3])  # Fig. 12, a spherical four-bar whose centre lies off its links
    1
    """
    return wampler_points(vertices, rods, on_plane, on_line) + sum(remote)


def wampler_scissors(
    vertices: int, rods: int, on_plane: int, on_line: int, remote: Iterable[int], scissors: int
) -> int:
    """Add scissors: M = 3 V + sum k S_{+k} - E - P - 2 L - 5 X - 6 (Wampler 2007, Eq. 9).

    Parameters
    ----------
    vertices, rods, on_plane, on_line, remote
        As of `wampler_remote`.
    scissors : int
        X: pairs of bars hinged where they cross; their rods are not counted.

    Examples
    --------
    >>> wampler_scissors(8, 0, 0, 0, [4], 4)  # four scissors in a spherical loop
    2
    """
    return wampler_remote(vertices, rods, on_plane, on_line, remote) - 5 * scissors


def wampler_ground_free(
    vertices: int, rods: int, on_plane: int, on_line: int, remote: Iterable[int], scissors: int
) -> int:
    """Leave ground out: M = 3 V + sum k S_{+k} - E - P - 2 L - 5 X (Wampler 2007, Eq. 10).

    Parameters
    ----------
    vertices, rods : int
        V and E without the vertices of the ground link and the rods between them.
    on_plane, on_line, remote, scissors
        As of `wampler_scissors`.

    Examples
    --------
    >>> wampler_ground_free(10, 15, 0, 6, [], 0)  # Fig. 16, a platform on three C-R-S legs
    3
    """
    return wampler_scissors(vertices, rods, on_plane, on_line, remote, scissors) + 6


def mobility_of_model(model: PolyhedronModel) -> int:
    """Return the mobility of a polyhedron model: Eq. 10 where it has a ground link, else Eq. 9.

    Parameters
    ----------
    model : PolyhedronModel

    Examples
    --------
    >>> mobility_of_model(PolyhedronModel(3, [(0, 1), (1, 2), (2, 0)]))
    0
    """
    equation = wampler_scissors if model.ground is None else wampler_ground_free
    return equation(
        model.free_vertices,
        model.counted_rods,
        len(model.on_plane),
        len(model.on_line),
        [centre.k for centre in model.centres],
        len(model.scissors),
    )


def overconstraint(actual: int, generic: int) -> int:
    """Overconstraint: h = M_actual - M (Wiener 2016, Eq. 8).

    Parameters
    ----------
    actual, generic : int
        Degrees of freedom of the mechanism at its configuration, mobility of a generic realisation of its type.

    Examples
    --------
    >>> overconstraint(1, 0)  # a 3 x 3 Miura mesh moves where the count says 0
    1
    """
    return actual - generic


def relative_cgk(links: int, joints: int, constraint_space: int) -> int:
    """Modified C-G-K: dM = lambda (dN - dJ) + dJ (Wiener 2016, Eq. 5).

    Parameters
    ----------
    links, joints : int
        dN and dJ: links and joints added, negative if taken away.
    constraint_space : int
        lambda of the loops closed: 3 with a centre, 6 without.

    Examples
    --------
    >>> relative_cgk(3, 4, 6)  # a spatial chain of three links and four joints between two links
    -2
    """
    return constraint_space * (links - joints) + joints


def relative_spherical_system(links: int, joints: int) -> int:
    """Spherical systems: dM = 3 dN - 2 dJ (Wiener 2016, Eq. 6).

    Parameters
    ----------
    links, joints : int
        dN and dJ: links and joints added, negative if taken away. The loops closed have centres.

    Examples
    --------
    >>> relative_spherical_system(2, 3), relative_spherical_system(-1, -1)  # a ride-along, a locked joint
    (0, -1)
    """
    return 3 * links - 2 * joints


def relative_polyhedron(vertices: int, implicit_centres: int, edges: int) -> int:
    """Polyhedron model: dM = 3 (dV + dC) - dE (Wiener 2016, Eq. 7).

    The example in 4.2.5.2 prints dM = 3 dV - 2 dE; its result, -1, is that of Eq. 7.

    Parameters
    ----------
    vertices, implicit_centres, edges : int
        dV, dC and dE: what is added of each, negative if taken away.

    Examples
    --------
    >>> relative_polyhedron(6, 0, 11 + 8)  # 4.2.5.2: four tetrahedra between two links of a six-bar
    -1
    """
    return 3 * (vertices + implicit_centres) - edges
