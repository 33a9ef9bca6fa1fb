from synth.realisation.on_cone import OnOneCone as OnOneCone, realise_on_cone as realise_on_cone
from synth.realisation.realised import Realised as Realised, realise as realise
from synth.realisation.special.search import SpecialSearch as SpecialSearch
