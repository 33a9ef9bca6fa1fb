"""Compliance states: members that bend or rest, mobility with these rigid and those released; springs and masses.

`states` answers. Below it: `members` (the linkage that is left), `freedoms` (of each set of active members),
`springs` (energy on the closed poses), `equilibrium` (balance, load paths), `small_motions` (modes and
frequencies), `stated`, `answer`. `limits` tells where ride-alongs go straight: `limited`, `limits_answer`.
Theory: docs/theory/compliance.md, docs/theory/activating-constraints.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.compliance.answer import States as States
    from synth.compliance.freedoms import State as State
    from synth.compliance.limited import limits as limits
    from synth.compliance.limits_answer import Limits as Limits
    from synth.compliance.members import Members as Members
    from synth.compliance.small_motions import Mass as Mass
    from synth.compliance.small_motions import Masses as Masses
    from synth.compliance.small_motions import sheet_masses as sheet_masses
    from synth.compliance.springs import Springs as Springs
    from synth.compliance.stated import Drive as Drive
    from synth.compliance.stated import states as states
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "answer": "States",
            "freedoms": "State",
            "limited": "limits",
            "limits_answer": "Limits",
            "members": "Members",
            "small_motions": "Mass Masses sheet_masses",
            "springs": "Springs",
            "stated": "Drive states",
        },
    )
