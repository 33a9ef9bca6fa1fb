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
from graphs.convert.conversions import Mechanism as Mechanism
from graphs.errors import (
    FileError as FileError,
    InvariantError as InvariantError,
    SynthedraError as SynthedraError,
    UnsolvableError as UnsolvableError,
)
from graphs.files.formats import read as read, write as write
from graphs.files.mechanism_like import MechanismLike as MechanismLike
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
from synth.analysis.advice.advice import advise as advise
from synth.analysis.assembly.modes import positions as positions
from synth.analysis.compliance.compliance_states import DrivenJoint as DrivenJoint, states as states
from synth.analysis.compliance.joint_limits import limits as limits
from synth.analysis.compliance.springs import (
    Mass as Mass,
    Masses as Masses,
    SpringArrays as SpringArrays,
    Springs as Springs,
)
from synth.analysis.folding.configuration import layers_at as layers_at
from synth.analysis.folding.motion import fold as fold
from synth.analysis.layering._layers import layers as layers
from synth.analysis.members._sweep import sweep as sweep
from synth.analysis.moving.motion import in_configuration as in_configuration, move as move
from synth.analysis.moving.on_surface import move_on_surface as move_on_surface
from synth.analysis.overconstraint.explanation import explain as explain
from synth.analysis.verdict._mobility import mobility as mobility
from synth.catalogue.patterns._generate import generate as generate
from synth.catalogue.realisation._realise import realise as realise
from synth.catalogue.realisation.on_cone import realise_on_cone as realise_on_cone
from synth.conversion import convert as convert
from synth.editing import edit as edit
from synth.first_look import FirstLook as FirstLook, look as look
from synth.linkages.conformed.linkage_behaviour import surface_behaviours as surface_behaviours
from synth.linkages.guidance._guiding_dyads import guiding_dyads as guiding_dyads
from synth.linkages.guidance.fourbars import four_bars as four_bars
from synth.linkages.guidance.order import analyse_order as analyse_order
from synth.linkages.guidance.orientations import Orientations as Orientations
from synth.linkages.guidance.sixbars import six_bars as six_bars
from synth.linkages.surfaces.linkage_maps import map_linkage as map_linkage
from synth.linkages.surfaces.loop_maps import (
    cones_of_loops as cones_of_loops,
    map_to_cones as map_to_cones,
    map_to_cylinders as map_to_cylinders,
)
from synth.making.drawing.mechanisms.pictures import draw as draw
from synth.making.simulation.writing import write_model as write_model
from synth.making.templates.hinges import Hinges as Hinges
from synth.making.templates.of_mechanism import template as template
from synth.making.templates.writing import write_template as write_template
from synth.making.thickening._thicken import thicken as thicken
from synth.making.viewer.pages import view as view
from synth.notebook import load_ipython_extension as load_ipython_extension
from synth.synthesis.atlas.atlas_file import open_atlas as open_atlas
from synth.synthesis.candidates.job import Filter as Filter
from synth.synthesis.candidates.listing import (
    conical_candidates as conical_candidates,
    count_conical_candidates as count_conical_candidates,
)
from synth.synthesis.designing.cone_design import design_on_cone as design_on_cone
from synth.synthesis.designing.designs import design as design
from synth.synthesis.tasks._task import task as task
