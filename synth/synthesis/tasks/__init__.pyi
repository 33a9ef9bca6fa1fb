from synth.synthesis.tasks._task import task as task
from synth.synthesis.tasks.dimensioning import (
    Candidate as Candidate,
    CandidateSearch as CandidateSearch,
    HalvingRound as HalvingRound,
    candidates_of as candidates_of,
    random_member as random_member,
)
from synth.synthesis.tasks.ranking import (
    RankedDesign as RankedDesign,
    RankedTypes as RankedTypes,
    ranked_types as ranked_types,
)
from synth.synthesis.tasks.record import FORMS as FORMS, SYSTEMS as SYSTEMS, RolePair as RolePair, Task as Task
from synth.synthesis.tasks.report import (
    report_page as report_page,
    write_designs as write_designs,
    write_pages as write_pages,
    write_report as write_report,
)
from synth.synthesis.tasks.structure import (
    CandidateType as CandidateType,
    PlacedType as PlacedType,
    TaskStructure as TaskStructure,
    placements_of as placements_of,
    structure_of as structure_of,
)
from synth.synthesis.tasks.task_files import read_task as read_task, task_schema as task_schema
