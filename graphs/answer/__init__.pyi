from graphs.answer.conversion import Reconstruction as Reconstruction, convert as convert, reconstruct as reconstruct
from graphs.answer.identity import Identity as Identity, identify as identify
from graphs.answer.mechanisms import mobility as mobility
from graphs.answer.report import MobilityAnswer as MobilityAnswer
