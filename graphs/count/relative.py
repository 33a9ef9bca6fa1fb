"""Relative mobility: what an edit adds to the mobility, from what it adds to the counts.

Source: Wiener 2016, Eqs. 5 to 7 (section 4.2). Theory: docs/theory/mobility-by-count.md.
"""

from __future__ import annotations

__all__ = ["relative_cgk", "relative_polyhedron", "relative_spherical_system"]


def relative_cgk(links: int, joints: int, constraint_space: int) -> int:
    """Modified C-G-K: dM = lambda (dN - dJ) + dJ (Wiener 2016, Eq. 5).

    Parameters
    ----------
    links, joints : int
        dN and dJ: links and joints added, negative if taken away.
    constraint_space : int
        lambda of the loops closed: 3 with a centre, 6 without.

    Returns
    -------
    int

    Examples
    --------
    A spatial chain of three links and four joints between two links:

    >>> relative_cgk(3, 4, 6)
    -2
    """
    return constraint_space * (links - joints) + joints


def relative_spherical_system(links: int, joints: int) -> int:
    """Spherical systems: dM = 3 dN - 2 dJ (Wiener 2016, Eq. 6).

    Parameters
    ----------
    links, joints : int
        dN and dJ: links and joints added, negative if taken away. The loops closed have centres.

    Returns
    -------
    int

    Examples
    --------
    A ride-along addendum (4.2.4), and locking a joint (6.3.2):

    >>> relative_spherical_system(2, 3), relative_spherical_system(-1, -1)
    (0, -1)
    """
    return 3 * links - 2 * joints


def relative_polyhedron(vertices: int, implicit_centres: int, edges: int) -> int:
    """Polyhedron model: dM = 3 (dV + dC) - dE (Wiener 2016, Eq. 7).

    Parameters
    ----------
    vertices, implicit_centres, edges : int
        dV, dC and dE: what is added of each, negative if taken away.

    Returns
    -------
    int

    Notes
    -----
    The example in 4.2.5.2 prints dM = 3 dV - 2 dE; its result, -1, is that of Eq. 7.

    Examples
    --------
    Wiener 4.2.5.2: four tetrahedra between two links of a six-bar.

    >>> relative_polyhedron(6, 0, 11 + 8)
    -1
    """
    return 3 * (vertices + implicit_centres) - edges
