from synth.analysis.overconstraint.explanation import Explanation as Explanation, IdleSet as IdleSet, explain as explain
from synth.analysis.overconstraint.redundancy import Tolerance as Tolerance
