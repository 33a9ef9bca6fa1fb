"""A page that folds: any mechanism on one self-contained page, its motion computed in the browser.

`shown` makes the data of the page of a mechanism, `linkage` the part about its linkage. `pages` puts pages
together of data and the script that `building` makes of the sources in `web`. Theory: docs/theory/viewer.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
