from synth.analysis.motion.singular.sampling import freedoms_at as freedoms_at
from synth.analysis.motion.singular.second_order import Rigidity as Rigidity, rigidity_of as rigidity_of
