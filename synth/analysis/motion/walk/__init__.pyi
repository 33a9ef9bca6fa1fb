from synth.analysis.motion.walk.step import Allowance as Allowance, PathEvent as PathEvent
from synth.analysis.motion.walk.walking import DrivenGoal as DrivenGoal, Event as Event, Walk as Walk
