"""Why a search ended."""

from enum import Enum


class StopReason(Enum):
    """Why a search ended; the value is a sentence for whoever reads a report.

    Examples
    --------
    >>> StopReason.SOLVED.converged, StopReason.STEPS.converged
    (True, False)
    """

    SOLVED = "the residual is zero but for rounding"
    SETTLED = "the last step reduced the sum of squares by too small a part to go on"
    STALLED = "no further step reduces the residual, however short it is"
    STEPS = "the number of steps was used up"
    ALLOWANCE = "the allowance of work was used up"
    UNDEFINED = "a step led to where there is no residual"

    @property
    def converged(self) -> bool:
        """Whether the search ended by its criterion, not because it was cut short."""
        return self in (StopReason.SOLVED, StopReason.SETTLED, StopReason.STALLED)
