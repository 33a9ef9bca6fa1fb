from synth.motion.walk.step import Allowance as Allowance, PathEvent as PathEvent
from synth.motion.walk.walking import Event as Event, Goal as Goal, Walk as Walk
