from synth.overconstraint.explanation import Explanation as Explanation, IdleSet as IdleSet, explain as explain
from synth.overconstraint.redundancy import Tolerance as Tolerance
