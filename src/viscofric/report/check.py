"""One check of a study's results: its name, its verdict and the numbers behind it, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Verdict: TypeAlias = Literal["passed", "noted", "look at this", "failed"]


@dataclass(frozen=True)
class Check:
    """One check: its name, whether it passed, and a sentence with the numbers."""

    name: str
    verdict: Verdict
    words: str

    @classmethod
    def of(cls, name: str, sound: bool, words: str) -> Check:
        """Return a check that passed, or one to look at."""
        return cls(name, "passed" if sound else "look at this", words)
