from synth.realisation.space.lifting import lifted as lifted
from synth.realisation.space.receding import receded as receded
