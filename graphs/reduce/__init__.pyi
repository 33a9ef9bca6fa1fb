from graphs.reduce.assur import (
    AssurGroup as AssurGroup,
    AssurReduction as AssurReduction,
    assur_groups as assur_groups,
    reduce_assur as reduce_assur,
)
from graphs.reduce.ride_alongs import Reduction as Reduction, ReductionStep as ReductionStep, reduce as reduce
from graphs.reduce.working_graph import RULES as RULES
