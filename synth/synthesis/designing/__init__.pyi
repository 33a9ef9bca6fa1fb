from synth.synthesis.designing.cone_design import (
    ConeDesign as ConeDesign,
    ConeDesigns as ConeDesigns,
    design_on_cone as design_on_cone,
)
from synth.synthesis.designing.designs import (
    Design as Design,
    Designs as Designs,
    DesignSearch as DesignSearch,
    design as design,
)
from synth.synthesis.designing.dimensions import Dimensions as Dimensions, dimensions_of as dimensions_of
from synth.synthesis.designing.placement import DesignPoint as DesignPoint
from synth.synthesis.designing.sizes import (
    BoxSize as BoxSize,
    CellCurvatures as CellCurvatures,
    EdgeLengths as EdgeLengths,
    EqualArcs as EqualArcs,
    EqualLengths as EqualLengths,
    LinkArc as LinkArc,
    PanelCorners as PanelCorners,
    SheetArea as SheetArea,
    SizeRatio as SizeRatio,
    Symmetry as Symmetry,
)
from synth.synthesis.designing.targets import (
    Formula as Formula,
    Mesh as Mesh,
    Polyline as Polyline,
    read_mesh as read_mesh,
)
from synth.synthesis.designing.wish_files import read_wishes as read_wishes
from synth.synthesis.designing.wishes import (
    Goal as Goal,
    JointAngle as JointAngle,
    LinkDirection as LinkDirection,
    LinkOrientation as LinkOrientation,
    PointDistance as PointDistance,
    PointPlace as PointPlace,
    PointsOn as PointsOn,
    TransmissionAngle as TransmissionAngle,
    Wish as Wish,
    WishedConfiguration as WishedConfiguration,
    Wishes as Wishes,
)
