"""Work that may be done, counted and not timed."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Allowance"]


@dataclass(slots=True)
class Allowance:
    """Work that a search may do altogether, such as the steps of all its paths.

    Where panels are all but nothing branches are endless. Work is counted, not timed, so that answers are the same
    on slow and on fast machines.

    Attributes
    ----------
    left : float
        Steps, or other units of work.

    Examples
    --------
    >>> some = Allowance(1)
    >>> some.take(), some.take()
    (True, False)
    """

    left: float

    def take(self, work: float = 1) -> bool:
        """Take a step, or some work, if it is left."""
        self.left -= work
        return self.left >= 0

    @property
    def used_up(self) -> bool:
        """Whether more was asked for than there was."""
        return self.left < 0
