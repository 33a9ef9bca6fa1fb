from synth.assembly.modes import AssemblyMode as AssemblyMode, PositionSet as PositionSet, positions as positions
from synth.assembly.table import PositionTable as PositionTable
