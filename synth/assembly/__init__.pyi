from synth.assembly.answer import Position as Position, Positions as Positions
from synth.assembly.found import positions as positions
from synth.assembly.general import general_positions as general_positions
