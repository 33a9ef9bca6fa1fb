from graphs.answer.conversion import convert as convert
from graphs.answer.identity import Identity as Identity, identify as identify
from graphs.answer.mechanisms import mobility as mobility
from graphs.answer.reconstruction import Reconstruction as Reconstruction, reconstruct as reconstruct
from graphs.answer.report import MobilityAnswer as MobilityAnswer
