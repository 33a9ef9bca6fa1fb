from synth.making.thickening._thicken import Collisions as Collisions, ThickSheet as ThickSheet, thicken as thicken
from synth.making.thickening.heights import (
    HingeHeights as HingeHeights,
    ThickVertex as ThickVertex,
    bennett_rows as bennett_rows,
    hinge_heights as hinge_heights,
    thick_vertices as thick_vertices,
)
from synth.making.thickening.plates import ThickPlates as ThickPlates, thick_plates as thick_plates
from synth.making.thickening.techniques import TechniqueFigures as TechniqueFigures
