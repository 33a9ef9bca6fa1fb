"""A page that folds: any mechanism on one self-contained page, its motion computed where it is looked at.

`shown` makes the data of the page of a mechanism: `solver_data` what the solver is told, `bodies` what is seen,
`ways` how it may begin. `page` puts pages together of data and the script that `script` finds; `web` holds the
sources of that, `build` makes it of them. Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.viewer.pages import page as page
    from synth.viewer.shown import Shown as Shown
    from synth.viewer.shown import shown_of as shown_of
else:
    __getattr__, __dir__, __all__ = offered(__name__, {"pages": "page", "shown": "Shown shown_of"})
