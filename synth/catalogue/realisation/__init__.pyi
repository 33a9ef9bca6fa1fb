from synth.catalogue.realisation._realise import (
    Realisation as Realisation,
    realise as realise,
    sheet_of_type as sheet_of_type,
)
from synth.catalogue.realisation.on_cone import ConeRealisation as ConeRealisation, realise_on_cone as realise_on_cone
from synth.catalogue.realisation.special.search import SpecialSearch as SpecialSearch
