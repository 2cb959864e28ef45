"""One assumption behind predicted friction, checked."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class AssumptionCheck:
    """One assumption behind predicted friction, checked.

    Attributes
    ----------
    name : str
        "half-space", "small contact", "linearity", "uncoupled" or "one temperature".
    value : float or None
        What is judged, a pure number, at most; None where something needed was not given.
    limit : float
        Largest value at which the assumption holds well.
    holds : bool or None
        Whether it does; None where it cannot be told.
    sentence : str
        The same in words, with lengths in mm and temperatures in °C.
    """

    name: str
    value: float | None
    limit: float
    holds: bool | None
    sentence: str

    def __str__(self) -> str:
        return self.sentence


def verdict(low: float, high: float, limit: float) -> bool | None:
    """Whether a value that lies between two is within its limit; None if that depends."""
    if high <= limit:
        return True
    return False if low > limit else None
