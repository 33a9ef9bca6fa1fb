from synth.overconstraint.answer import Explanation as Explanation, IdleSet as IdleSet
from synth.overconstraint.explained import explain as explain
from synth.overconstraint.tolerances import Tolerance as Tolerance
