from synth.assembly.family import general_positions as general_positions
from synth.assembly.modes import Position as Position, Positions as Positions, positions as positions
