from synth.assembly.family import general_positions as general_positions
from synth.assembly.modes import AssemblyMode as AssemblyMode, PositionSet as PositionSet, positions as positions
