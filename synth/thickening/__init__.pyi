from synth.thickening.collisions import (
    ConvexPieces as ConvexPieces,
    FoldCourse as FoldCourse,
    Meeting as Meeting,
    MovingPieces as MovingPieces,
    distances as distances,
    overlap as overlap,
    pieces_of as pieces_of,
)
from synth.thickening.heights import (
    HingeHeights as HingeHeights,
    ThickVertex as ThickVertex,
    bennett_rows as bennett_rows,
    hinge_heights as hinge_heights,
    thick_vertices as thick_vertices,
)
from synth.thickening.plates import Ply as Ply, ThickPlates as ThickPlates, thick_plates as thick_plates
from synth.thickening.thickened import Collisions as Collisions, ThickSheet as ThickSheet, thicken as thicken
