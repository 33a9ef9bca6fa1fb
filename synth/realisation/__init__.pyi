from synth.realisation.on_cone import ConeRealisation as ConeRealisation, realise_on_cone as realise_on_cone
from synth.realisation.realised import Realisation as Realisation, realise as realise, sheet_of_type as sheet_of_type
from synth.realisation.special.search import SpecialSearch as SpecialSearch
