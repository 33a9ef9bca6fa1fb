from synth.simulation.assembly import (
    Assembly as Assembly,
    AssemblyOptions as AssemblyOptions,
    assembly_of as assembly_of,
)
from synth.simulation.writing import write_model as write_model
