"""A check: what was tested, the verdict, the number with its limit, and a sentence for people."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, Self, TypeAlias

from viscofric.notes import Reader, note_of

Verdict: TypeAlias = Literal["passed", "noted", "warning", "failed"]
_VERDICTS: dict[bool | None, Verdict] = {True: "passed", False: "warning", None: "noted"}


@dataclass(frozen=True)
class Check:
    """One check."""

    name: str
    verdict: Verdict  # "noted" where it cannot be judged
    sentence: str  # the check in words, with its numbers
    value: float | None = None  # the number that was compared, where there is one
    limit: float | None = None  # the largest that passes

    @classmethod
    def of(
        cls, name: str, holds: bool | None, sentence: str, value: float | None = None, limit: float | None = None
    ) -> Self:
        """Return a check that passed, one with a warning, or one that cannot be judged (None)."""
        return cls(name, _VERDICTS[None if holds is None else bool(holds)], sentence, value, limit)

    @property
    def holds(self) -> bool | None:
        """Whether it passed; None where it cannot be judged."""
        return None if self.verdict == "noted" else self.verdict == "passed"

    @property
    def code(self) -> str:
        """Code of the sentence."""
        return note_of(self.sentence).code

    @property
    def values(self) -> Mapping[str, Any]:
        """Numbers of the sentence by name."""
        return note_of(self.sentence).values

    def record(self, reader: Reader) -> dict[str, Any]:
        """Return the check as JSON, its sentence in the words of a reader."""
        words = note_of(self.sentence).words(reader)
        return {"name": self.name, "verdict": self.verdict, "value": self.value, "limit": self.limit, "words": words}

    def __str__(self) -> str:
        return str(self.sentence)
