from synth.analysis.advice.advice import (
    Advice as Advice,
    AdviceTable as AdviceTable,
    Creased as Creased,
    Locked as Locked,
    advise as advise,
)
from synth.analysis.advice.diagonals import Diagonal as Diagonal
from synth.analysis.advice.locks import GeneralConfiguration as GeneralConfiguration, cheapest_sets as cheapest_sets
