from synth.verdict.judged import (
    JudgedMobility as JudgedMobility,
    mobility as mobility,
    verdict_of_motion as verdict_of_motion,
)
from synth.verdict.verdict import Verdict as Verdict, Way as Way
