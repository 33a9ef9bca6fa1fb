from synth.advice.advised import advise as advise
from synth.advice.answer import Advice as Advice, Creased as Creased, Locked as Locked
from synth.advice.diagonals import Diagonal as Diagonal
from synth.advice.general_pose import GeneralPose as GeneralPose
from synth.advice.locks import cheapest_sets as cheapest_sets
