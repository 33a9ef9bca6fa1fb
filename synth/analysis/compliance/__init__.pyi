from synth.analysis.compliance.compliance_states import (
    DrivenJoint as DrivenJoint,
    States as States,
    StateTable as StateTable,
    states as states,
)
from synth.analysis.compliance.joint_limits import JointLimits as JointLimits, limits as limits
from synth.analysis.compliance.members import Members as Members, State as State
from synth.analysis.compliance.springs import (
    Mass as Mass,
    Masses as Masses,
    SpringArrays as SpringArrays,
    Springs as Springs,
    sheet_masses as sheet_masses,
)
