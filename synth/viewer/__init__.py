"""A page that folds: any mechanism on one self-contained page, its motion computed where it is looked at.

`shown` makes the data of the page of a mechanism: `solver_data` what the solver is told, `bodies` what is seen,
`ways` how it may begin. `page` puts pages together of data and the script that `script` finds; `web` holds the
sources of that, `build` makes it of them. Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
