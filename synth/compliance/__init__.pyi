from synth.compliance.answer import States as States
from synth.compliance.freedoms import State as State
from synth.compliance.limited import limits as limits
from synth.compliance.limits_answer import Limits as Limits
from synth.compliance.members import Members as Members
from synth.compliance.small_motions import Mass as Mass, Masses as Masses, sheet_masses as sheet_masses
from synth.compliance.springs import Springs as Springs
from synth.compliance.stated import Drive as Drive, states as states
