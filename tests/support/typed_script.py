"""A script that uses every name of the face once; `tests/test_typed_script.py` has mypy infer its types."""

from pathlib import Path
from typing import reveal_type

import numpy as np

import synth

# Mechanisms, read and built
mechanism: synth.Mechanism = synth.read("data/patterns/bird-base.fold")
source: synth.MechanismLike = Path("data/patterns/bird-base.fold")
loop = synth.Loop((0, 1, 2, 3), synth.Centre.FINITE)
chain = synth.SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [loop])
drawn = synth.SCDGraph(["a", "b"], [("a", "b")], rotation={"a": (0, None, None), "b": (0, None, None)})
sheet = synth.Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)))
model = synth.PolyhedronModel(3, [(0, 1), (1, 2), (2, 0)])
vertices = synth.VertexEdgeGraph({"O": ("a", "b", "c", "d")})
solids = synth.HingedSolids(chain, dict.fromkeys(range(4), ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))))
place = synth.JointPlace((0.0, 0.0, 0.0), ((0.0, 0.0, 1.0),))
jointed = synth.JointedLinkage(chain, dict.fromkeys(range(4), synth.JointKind.REVOLUTE), {0: place})
surface = synth.Cone(0.5) if chain.loops else synth.Cylinder(2.0)
linkage = synth.SurfaceLinkage(chain, steps={(0, 1): 1.5, (1, 2): 1.5, (2, 3): 1.5}, surface=surface)
reveal_type(mechanism)
reveal_type((chain, drawn, sheet, model, vertices, solids, jointed, linkage))
reveal_type((loop.centre, sheet.fold_angles, sheet.coordinates, chain.joints, chain.loops, jointed.kinds))
reveal_type((synth.write(mechanism, "out.json"), synth.write_model(mechanism, "model.xml", "mjcf")))

# Answers
seen: synth.FirstLook = synth.look(source)
reveal_type((seen.kind, seen.commands, seen.mobility))
answer = synth.mobility(source)
reveal_type((answer, answer.mobility, answer.verdict, answer.configuration, str(answer)))
reveal_type(synth.identify(mechanism).chain)
groups: synth.TypeClasses = synth.types_of([source, mechanism], by="chain")
reveal_type((groups.classes, groups.repeated, groups.without))
reveal_type(synth.reconstruct(drawn).model)
reveal_type(synth.reduce(chain).graph)
reveal_type(synth.convert(sheet, "sc"))
edited = synth.edit(chain, lock=[0], add_ride_along=[(0, 1)])
reveal_type((edited, edited.mechanism, edited.edits[0].predicted))
reveal_type(synth.explain(source).idle)
reveal_type((synth.layers(source), synth.layers(source).orders, synth.layers_at("half.fold").orders))
reveal_type(synth.advise(source, 1).locks)

# Motion
folded = synth.fold(sheet, drive={0: 1.0})
reveal_type((folded, folded.freedoms, folded.frames(), folded.sheets()))
reveal_type(synth.in_configuration(sheet, "last", angles={0: 1.0}))
designs = synth.design_on_cone(0.4, 1.0, tries=1)
reveal_type((designs, designs.designs, designs.rim))
answer = synth.mobility("k1:Cr")
reveal_type((answer.verdict.text, answer.verdict.freedoms, answer.mobility))
reveal_type(synth.move(solids, frames=3).path.angles)
reveal_type(synth.positions(solids, drive={0: 0.1}).positions)
springs = synth.Springs({0: 2.0})
masses = synth.Masses((synth.Mass(1, 0.2, (0.0, 0.0, 0.0)),))
state = synth.states(solids, joints=[1], springs=springs, drive=synth.DrivenJoint(0, to=1.0), masses=masses)
reveal_type((state, state.now, state.sets, state.classes))
reveal_type(synth.states(solids, joints=[1], springs=synth.SpringArrays({0: [1.0, 2.0]})))

# Lists
for found in synth.chains(links=6, dof=1):
    reveal_type(found)
for graph in synth.sc_graphs(links=6, dof=1):
    reveal_type(graph)
for panels in synth.scd_graphs(links=4, dof=1, max_degree=4):
    reveal_type(panels)
for string in synth.strings(4):
    reveal_type((string, string.text))
addendum: synth.Addendum
for addendum in synth.addenda(chain, 0):
    reveal_type((addendum.kind, addendum.edit.graph))
for row in synth.conical_candidates(chain, filters=[synth.Filter("layers", most=2)]):
    reveal_type(row["layers"])
numbers = [synth.count_chains(links=6, dof=1), synth.count_sc_graphs(links=6, dof=1), synth.count_strings(4)]
numbers += [synth.count_scd_graphs(links=4, dof=1, max_degree=4), synth.count_conical_candidates(chain)]
reveal_type(numbers)

# Realisations, known patterns, cones and cylinders, guidance
reveal_type(synth.generate("miura", fold=0.5).mechanism)
reveal_type(synth.thicken(synth.generate("miura").mechanism, thickness=0.05).angles)
reveal_type(synth.realise(drawn).sheet)
reveal_type(synth.realise(synth.ChainString((2, 1)), mode="D").mobility)
reveal_type(synth.realise(chain, freedoms=1).members)
reveal_type(synth.realise_on_cone(chain).linkage)
reveal_type(synth.map_linkage(linkage).surfaces)
reveal_type([behaviour.way_of(2) for behaviour in synth.surface_behaviours(linkage)])
reveal_type(synth.move_on_surface(linkage).driver)
reveal_type(synth.limits(source, keep=[0]).truss)
reveal_type(synth.map_to_cones([2.1, 1.7, 0.8, 1.5]).cones)
reveal_type((synth.positions(linkage, drive={0: 0.1}), synth.positions(linkage, drive={0: [0.1, 0.2]})))
swept = synth.sweep(linkage, {"arcs": np.ones((2, 4))}, drive={0: [0.0, 0.1]})
reveal_type((swept, swept.angles, swept.state, swept.counts))
reveal_type(synth.cones_of_loops([[2.1, 1.7, 0.8, 1.5]]).status)
reveal_type(synth.map_to_cylinders([4.0, 3.0, 5.0, 1.0]))
orientations = synth.Orientations(np.eye(4))
dyads = synth.guiding_dyads(orientations)
reveal_type(synth.guiding_dyads(np.zeros((0, 5, 3, 3))).count)
reveal_type((dyads, synth.analyse_order(orientations, (0.0, 0.0, 1.0)), synth.four_bars(orientations, dyads.dyads)))
reveal_type(synth.six_bars(orientations, driven="ground").six_bars)

wished = synth.design(linkage, "wishes.json", starts=2)
reveal_type((wished, wished.best, wished.pareto))
able = synth.task("task.json", starts=2)
reveal_type((able, able.best, able.design(able.ranked[0])))
reveal_type(synth.task("task.json", structure_only=True).placed)

# Pictures, templates, pages, the atlas
picture = synth.draw(sheet, colour="none")
reveal_type((picture, picture.width))
template = synth.template(sheet, size=150, hinges=synth.Hinges("living", 8.0))
reveal_type((template, synth.write_template(template, "template.svg")))
page = synth.view(sheet, title="one panel and another")
reveal_type((page, page.html))
reveal_type(synth.open_atlas("types.atlas"))
synth.load_ipython_extension(object())

# Errors
try:
    synth.read("no such file.fold")
except synth.FileError as error:
    reveal_type(error.file)
except (synth.InvariantError, synth.UnsolvableError) as error:
    reveal_type(error)
except synth.SynthedraError as error:
    reveal_type(str(error))
