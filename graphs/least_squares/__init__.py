"""Nonlinear least squares: damped steps, many problems at once, shortest steps to where equations hold, the nearest.

Where residuals leave unknowns free, steps are as short as can be: what no residual depends on stays where it was.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
