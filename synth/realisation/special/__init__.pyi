from synth.realisation.special.search import (
    SpecialSearch as SpecialSearch,
    SpecialWishes as SpecialWishes,
    search_special as search_special,
)
