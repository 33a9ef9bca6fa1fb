from synth.motion.walk.step import Allowance as Allowance, PathEvent as PathEvent
from synth.motion.walk.walking import DrivenGoal as DrivenGoal, Event as Event, Walk as Walk
