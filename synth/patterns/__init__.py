"""Known patterns and linkages made by their parameters: crease patterns, rings of solids, pop-ups, cartons, ...

`generate` makes one by name, `GENERATORS` has them all: parameters with units and ranges, the freedoms that the
source gives, its conditions. Rooms: `creases`, `rings`, `goods`, `platforms`. Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.patterns.catalogue import GENERATORS as GENERATORS
    from synth.patterns.generated import Generated as Generated
    from synth.patterns.generated import generate as generate
    from synth.patterns.generator import Generator as Generator
    from synth.patterns.generator import Parameter as Parameter
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "catalogue": "GENERATORS",
            "generated": "Generated generate",
            "generator": "Generator Parameter",
        },
    )
