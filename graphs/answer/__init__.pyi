from graphs.answer.conversion import Reconstruction as Reconstruction, convert as convert, reconstruct as reconstruct
from graphs.answer.identity import Identity as Identity, identify as identify
from graphs.answer.mobility import counts_and_ranks as counts_and_ranks
from graphs.answer.report import MobilityAnswer as MobilityAnswer
