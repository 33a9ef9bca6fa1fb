from enumerate.addenda import Addendum as Addendum, addenda as addenda
from enumerate.chains.jobs import chains as chains, count_chains as count_chains
from enumerate.sc.jobs import count_sc_graphs as count_sc_graphs, sc_graphs as sc_graphs
from enumerate.scd.jobs import count_scd_graphs as count_scd_graphs, scd_graphs as scd_graphs
from enumerate.strings.panel_strings import (
    ChainString as ChainString,
    count_strings as count_strings,
    strings as strings,
)
from graphs.answer.conversion import reconstruct as reconstruct
from graphs.answer.identity import TypeClasses as TypeClasses, identify as identify, types_of as types_of
from graphs.convert.table import Mechanism as Mechanism
from graphs.errors import (
    FileError as FileError,
    InvariantError as InvariantError,
    SynthedraError as SynthedraError,
    UnsolvableError as UnsolvableError,
)
from graphs.files.accepted import MechanismLike as MechanismLike
from graphs.files.formats import read as read, write as write
from graphs.joints.linkage import JointedLinkage as JointedLinkage, JointKind as JointKind, JointPlace as JointPlace
from graphs.loops.loop import Centre as Centre, Loop as Loop
from graphs.mechanism.polyhedron import PolyhedronModel as PolyhedronModel
from graphs.mechanism.sc import SCGraph as SCGraph
from graphs.mechanism.scd import SCDGraph as SCDGraph
from graphs.mechanism.sheet import Sheet as Sheet
from graphs.mechanism.solids import HingedSolids as HingedSolids
from graphs.mechanism.surfaces import Cone as Cone, Cylinder as Cylinder, SurfaceLinkage as SurfaceLinkage
from graphs.mechanism.vertex_edge import VertexEdgeGraph as VertexEdgeGraph
from graphs.reduce.ride_alongs import reduce as reduce
from synth.advice.advice import advise as advise
from synth.assembly.modes import positions as positions
from synth.atlas.opened import open_atlas as open_atlas
from synth.candidates.job import Filter as Filter
from synth.candidates.listing import (
    conical_candidates as conical_candidates,
    count_conical_candidates as count_conical_candidates,
)
from synth.compliance.compliance_states import DrivenJoint as DrivenJoint, states as states
from synth.compliance.joint_limits import limits as limits
from synth.compliance.springs import Mass as Mass, Masses as Masses, SpringArrays as SpringArrays, Springs as Springs
from synth.conformed.linkages import surface_behaviours as surface_behaviours
from synth.conversion import convert as convert
from synth.designing.cone_design import design_on_cone as design_on_cone
from synth.designing.designs import design as design
from synth.drawing.mechanisms.pictures import draw as draw
from synth.editing import edit as edit
from synth.first_look import FirstLook as FirstLook, look as look
from synth.folding.configuration import layers_at as layers_at
from synth.folding.motion import fold as fold
from synth.guidance.fourbars import four_bars as four_bars
from synth.guidance.guiding import guiding_dyads as guiding_dyads
from synth.guidance.order import analyse_order as analyse_order
from synth.guidance.orientations import Orientations as Orientations
from synth.guidance.sixbars import six_bars as six_bars
from synth.layering.answer import layers as layers
from synth.members.sweeping import sweep as sweep
from synth.moving.motion import in_configuration as in_configuration, move as move
from synth.moving.on_surface import move_on_surface as move_on_surface
from synth.notebook import load_ipython_extension as load_ipython_extension
from synth.overconstraint.explanation import explain as explain
from synth.patterns.generated import generate as generate
from synth.realisation.on_cone import realise_on_cone as realise_on_cone
from synth.realisation.realised import realise as realise
from synth.simulation.writing import write_model as write_model
from synth.surfaces.linkages import map_linkage as map_linkage
from synth.surfaces.loop_maps import (
    cones_of_loops as cones_of_loops,
    map_to_cones as map_to_cones,
    map_to_cylinders as map_to_cylinders,
)
from synth.tasks.answer import task as task
from synth.templates.hinges import Hinges as Hinges
from synth.templates.of_mechanism import template as template
from synth.templates.writing import write_template as write_template
from synth.thickening.thickened import thicken as thicken
from synth.verdict.judged import mobility as mobility
from synth.viewer.pages import view as view
