"""From a wish to dimensions: what may change, what is wished, the search, and designs that are judged.

A mechanism is given with coordinates (`dimensions`), and wishes about its motion (`wishes`, `targets`, read by
`wish_files`). Least squares with exact derivatives (`placement`, `problem`, `search`) change its dimensions and all
configurations at once; the verdict and a traced motion judge what was found (`tracing`, `designs`).

Theory: docs/theory/design.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
