from synth.analysis.motion.branches import Search as Search, branches_of as branches_of, first_branch as first_branch
from synth.analysis.motion.closure import ClosureEquations as ClosureEquations
from synth.analysis.motion.derivatives import (
    AxisChange as AxisChange,
    AxisDependence as AxisDependence,
    BodyTree as BodyTree,
    Sensitivity as Sensitivity,
    dependence_on_axes as dependence_on_axes,
    derivatives_by_parameters as derivatives_by_parameters,
    spatial as spatial,
)
from synth.analysis.motion.germ import Branch as Branch, Branches as Branches
from synth.analysis.motion.linkage import (
    Linkage as Linkage,
    link_motions as link_motions,
    linkage_of_axes as linkage_of_axes,
    linkage_of_sheet as linkage_of_sheet,
)
from synth.analysis.motion.path import Path as Path, PathOptions as PathOptions, driven_path as driven_path
from synth.analysis.motion.singular.second_order import Rigidity as Rigidity, rigidity_of as rigidity_of
