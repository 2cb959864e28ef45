"""One assumption behind predicted friction, checked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.notes import note_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray

    from viscofric.notes import Reader


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

    def to_dataset(self) -> xarray.Dataset:
        """Return the check as a labelled data set along ``assumption``; see `assumptions_dataset`."""
        return assumptions_dataset((self,))

    def __str__(self) -> str:
        return self.sentence


def assumptions_dataset(checks: Sequence[AssumptionCheck], reader: Reader = "python") -> xarray.Dataset:
    """Return checks as a labelled data set along ``assumption``, their sentences in the words of a reader.

    `value` is NaN where it is not known; `holds` is 1, 0, or −1 where it cannot be judged.
    """
    from viscofric.datasets import dataset

    return dataset(
        "assumption",
        {
            "assumption_name": ([check.name for check in checks], "1", "what is taken for granted"),
            "value": ([math.nan if check.value is None else check.value for check in checks], "1", "what is judged"),
            "limit": ([check.limit for check in checks], "1", "largest value at which the assumption holds well"),
            "holds": (
                [-1 if check.holds is None else int(check.holds) for check in checks],
                "1",
                "whether it does (1), does not (0), or cannot be told (-1)",
            ),
            "sentence": ([note_of(check.sentence).words(reader) for check in checks], "1", "the same in words"),
        },
    )


def verdict(low: float, high: float, limit: float) -> bool | None:
    """Whether a value that lies between two is within its limit; None if that depends."""
    if high <= limit:
        return True
    return False if low > limit else None
