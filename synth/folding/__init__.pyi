from synth.folding.configuration import layers_at as layers_at
from synth.folding.derivatives import SheetDerivatives as SheetDerivatives
from synth.folding.motion import assign_branch as assign_branch, fold as fold
