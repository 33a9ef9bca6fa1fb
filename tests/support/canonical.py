"""Canonical labels of SC graphs (bliss), to compare mechanisms up to isomorphism."""

from __future__ import annotations

import bliss_bind

from graphs.sc import SCGraph


def canonical_code(sc: SCGraph) -> tuple:
    """Return the same code for two mechanisms exactly if links, joints and centre classes correspond.

    Nodes of the coloured graph: links (the ground link apart), joints, and for each class a node joined to
    the joints on its axes, coloured by its kind and number of loops. So the choice of a basis of loops within
    a class does not show.
    """
    colours, edges, number = [], [], {}

    def node(thing, colour):
        number[thing] = len(colours)
        colours.append(colour)

    for link in sc.nodes:
        node(("link", link), (0, link == sc.ground))
    for joint, ends in sc.joints.items():
        node(("joint", joint), (1,))
        edges += [(number["joint", joint], number["link", end]) for end in ends]
    for k, one in enumerate(sc.centre_classes()):
        closing = sum(loop >= len(sc.loops) for loop in one.loops)
        node(("class", k), (2, one.centre.value, len(one.loops), closing))
        edges += [(number["class", k], number["joint", joint]) for joint in one.joints]
    palette = {colour: i for i, colour in enumerate(sorted(set(colours), key=repr))}
    graph = bliss_bind.Graph()
    graph.set_splitting_heuristic(bliss_bind.Graph.SplittingHeuristic.shs_fm)
    for colour in colours:
        graph.add_vertex(palette[colour])
    for a, b in edges:
        graph.add_edge(a, b)
    labels, _ = graph.canonical_form()
    form = sorted(tuple(sorted((labels[a], labels[b]))) for a, b in edges)
    return tuple(sorted(zip(labels, map(repr, colours), strict=True))), tuple(form), sc.spatial_loops
