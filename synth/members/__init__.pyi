from synth.members.circuits import circuits_of as circuits_of
from synth.members.dimensions import arcs_of as arcs_of
from synth.members.sweeping import STATES as STATES, Sweep as Sweep, sweep as sweep
