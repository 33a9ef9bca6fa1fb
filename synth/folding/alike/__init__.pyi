from synth.folding.alike.classes import alike_classes as alike_classes
from synth.folding.alike.closure import AlikeClosure as AlikeClosure
from synth.folding.alike.reaching import Reached as Reached, fold_to as fold_to
