from synth.motion.walk.allowance import Allowance as Allowance
from synth.motion.walk.event import PathEvent as PathEvent
from synth.motion.walk.walking import Event as Event, Goal as Goal, Walk as Walk
