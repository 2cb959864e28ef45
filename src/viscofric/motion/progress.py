"""One progress of several marches whose number is not known before: each takes a part of what remains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(eq=False)
class Progress:
    """Progress of all marches, told as a time between the start and the end of their history."""

    whole: Callable[[float, float], object]
    start: float
    end: float
    part: float  # of what remains, that the present march takes
    next_part: float  # and each of the next
    begun: float = 0.0
    furthest: float = 0.0

    def __call__(self, reached: float, end: float) -> None:
        """State the time that the present march has reached."""
        share = (reached - self.start) / (end - self.start)
        self.furthest = max(self.furthest, self.begun + self.part * (1.0 - self.begun) * share)
        self.whole(self.start + self.furthest * (self.end - self.start), self.end)

    def next(self) -> None:
        """Begin with another march."""
        self.begun += self.part * (1.0 - self.begun)
        self.part = self.next_part

    def end_all(self) -> None:
        """State that all marches are done."""
        self.whole(self.end, self.end)
