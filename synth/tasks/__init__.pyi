from synth.tasks.answer import task as task
from synth.tasks.placements import placements_of as placements_of
from synth.tasks.record import FORMS as FORMS, SYSTEMS as SYSTEMS, RolePair as RolePair, Task as Task
from synth.tasks.structure import (
    CandidateType as CandidateType,
    PlacedType as PlacedType,
    TaskStructure as TaskStructure,
    structure_of as structure_of,
)
from synth.tasks.task_files import read_task as read_task, task_schema as task_schema, write_task as write_task
