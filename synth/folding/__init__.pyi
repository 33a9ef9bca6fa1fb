from synth.folding.assigned import assign_branch as assign_branch
from synth.folding.derivatives import SheetDerivatives as SheetDerivatives
from synth.folding.motion import fold as fold
