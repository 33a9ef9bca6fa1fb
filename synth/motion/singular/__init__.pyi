from synth.motion.singular.rigidity import Rigidity as Rigidity, rigidity_of as rigidity_of
from synth.motion.singular.sampling import freedoms_at as freedoms_at
