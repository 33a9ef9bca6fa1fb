from synth.analysis.members._sweep import STATES as STATES, Sweep as Sweep, sweep as sweep
from synth.analysis.members.circuits import circuits_of as circuits_of
from synth.analysis.members.member_dimensions import arcs_of as arcs_of
