from synth.realisation.special.answer import SpecialSearch as SpecialSearch
from synth.realisation.special.search import SpecialWishes as SpecialWishes, search_special as search_special
