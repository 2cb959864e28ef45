"""What a study tells of its progress, to people and to programs."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Protocol, TypeAlias

if TYPE_CHECKING:
    Value: TypeAlias = str | int | float | bool


@dataclass(frozen=True)
class Event:
    """One thing that happened.

    Attributes
    ----------
    event : str
        ``"stage"``: a stage began or took a step; ``"solving"``: a contact is begun; ``"solved"``: it is solved and
        stored; ``"stored"``: it had been before; ``"damaged"``: what had been stored cannot be used; ``"failed"``: it
        could not be solved; ``"waiting"``: a cluster has no workers for the time being.
    stage : str, optional
        Of the study: "measurement", "material", "contacts", "report" …
    done, total : int, optional
        Steps of the stage; of contacts, the cases that are known and those that are asked for.
    solves : int, optional
        Contacts solved for that, so far: many cases may come from few of them, or a case from several.
    label : str, optional
        The contact, for people.
    key : str, optional
        The contact, for programs: the name of its file.
    seconds : float, optional
        What it took.
    reason : str, optional
        Why it failed, what is wrong with what was stored, or what is waited for.
    """

    event: str
    stage: str | None = None
    done: int | None = None
    total: int | None = None
    solves: int | None = None
    label: str | None = None
    key: str | None = None
    seconds: float | None = None
    reason: str | None = None

    def as_dict(self) -> dict[str, Value]:
        """Return what is known of it."""
        told = ((field.name, getattr(self, field.name)) for field in fields(self))
        return {name: value for name, value in told if value is not None}


class Progress(Protocol):
    """What hears of a study's progress."""

    def __call__(self, event: Event) -> object:
        """Hear of one event."""


def silent(event: Event) -> None:
    """Hear, and say nothing."""
