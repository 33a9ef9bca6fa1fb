from synth.verdict.judged import (
    JudgedMobility as JudgedMobility,
    mobility as mobility,
    mobility_of_type as mobility_of_type,
    verdict_of_motion as verdict_of_motion,
)
from synth.verdict.verdict import MotionBranch as MotionBranch, Verdict as Verdict
