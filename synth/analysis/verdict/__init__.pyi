from synth.analysis.verdict._mobility import (
    JudgedMobility as JudgedMobility,
    mobility as mobility,
    mobility_of_type as mobility_of_type,
    verdict_of_motion as verdict_of_motion,
)
from synth.analysis.verdict.verdict import MotionBranch as MotionBranch, Verdict as Verdict
