"""A table of a run file: no unknown keys, no changes, and all that does not fit together told at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self, TypeAlias

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

if TYPE_CHECKING:
    from collections.abc import Iterator

#: A key within the table, such as "load" or "load.2", and a sentence about it; "" is the table as a whole.
Problem: TypeAlias = tuple[str, str]


class Table(BaseModel):
    """A table of the run file: no unknown keys, no changes afterwards."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together within the table."""
        yield from ()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        found = list(self.problems())
        if found:
            raise all_at_once(type(self).__name__, found)
        return self


def all_at_once(title: str, problems: list[Problem]) -> ValidationError:
    """Return the error that tells several problems, each at its key."""
    details = [
        InitErrorDetails(
            type=PydanticCustomError("relation", "{words}", {"words": words}),
            loc=tuple(int(part) if part.isdigit() else part for part in key.split(".")) if key else (),
            input=None,
        )
        for key, words in problems
    ]
    return ValidationError.from_exception_data(title, details)
