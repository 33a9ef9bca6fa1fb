from synth.making.simulation.assembly import (
    Assembly as Assembly,
    AssemblyOptions as AssemblyOptions,
    assembly_of as assembly_of,
)
from synth.making.simulation.writing import write_model as write_model
