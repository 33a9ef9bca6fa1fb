from synth.analysis.assembly.modes import (
    AssemblyMode as AssemblyMode,
    PositionSet as PositionSet,
    PositionTable as PositionTable,
    positions as positions,
)
