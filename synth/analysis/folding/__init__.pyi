from synth.analysis.folding.configuration import layers_at as layers_at
from synth.analysis.folding.derivatives import SheetDerivatives as SheetDerivatives
from synth.analysis.folding.motion import assign_branch as assign_branch, fold as fold
