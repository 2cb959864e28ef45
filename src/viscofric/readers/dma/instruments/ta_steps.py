"""Steps of a TA Instruments file, whichever layout they stand in: their signals, and which are frequency sweeps."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.arrays import Array


#: What a column holds -> its names, in small letters.
ROLES = {
    "temperature": re.compile(r"(sample )?temperature"),
    "angular frequency": re.compile(r"ang(ular|\.)? frequency"),
    "frequency": re.compile(r"frequency"),
    "storage modulus": re.compile(r"((tensile|shear|young's) )?storage modulus( [eg]')?|[eg]'"),
    "loss modulus": re.compile(r"((tensile|shear|young's) )?loss modulus( [eg](''|\"))?|[eg](''|\")"),
    "tan delta": re.compile(r"tan ?\(?(delta|δ)\)?"),
    "strain": re.compile(r"oscillation strain"),
    "oscillation torque": re.compile(r"oscillation torque"),
    "oscillation force": re.compile(r"oscillation force"),
}

#: Steps that change the amplitude are no frequency sweeps even where they do so at several frequencies.
_AMPLITUDE = re.compile(r"amplitude|(strain|stress|force|displacement) sweep", re.IGNORECASE)
#: Measured frequencies of one set frequency differ by less than this (relative); no sweep is as narrow.
_SAME_FREQUENCY = 0.05


@dataclass(frozen=True, eq=False)
class Signal:
    """One column of a step.

    Parameters
    ----------
    heading, unit : str
        As printed.
    values : (n,) array
        As printed; NaN where a cell is empty or no finite number.
    """

    heading: str
    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class Step:
    """One step of an instrument's programme.

    Parameters
    ----------
    name : str
        As printed.
    signals : dict
        Those columns that have a role in `ROLES`, by role.
    places : tuple of str
        Where each point stands: ``"line 18"``.
    named_by_instrument : bool
        Whether the name tells the technique; a name that the user gave tells nothing.
    """

    name: str
    signals: Mapping[str, Signal]
    places: tuple[str, ...]
    named_by_instrument: bool = True

    @property
    def frequency(self) -> Signal | None:
        """The angular frequency, or where there is none the frequency."""
        return self.signals.get("angular frequency") or self.signals.get("frequency")

    @property
    def has_moduli(self) -> bool:
        """Whether E' and E'' (or tan δ) stand beside a frequency."""
        return (
            self.frequency is not None
            and "storage modulus" in self.signals
            and ("loss modulus" in self.signals or "tan delta" in self.signals)
        )

    @property
    def is_frequency_sweep(self) -> bool:
        """Whether the step holds moduli at several frequencies, or is named a frequency sweep."""
        technique = self.name.lower() if self.named_by_instrument else ""
        if self.frequency is None or not self.has_moduli or _AMPLITUDE.search(technique):
            return False
        values = self.frequency.values[self.frequency.values > 0]
        several = values.size > 0 and values.max() > (1.0 + _SAME_FREQUENCY) * values.min()
        return bool(several or (values.size and "frequency" in technique))


def roles(names: Sequence[str]) -> dict[str, int]:
    """Return the place of the first column of each role in `ROLES` that there is.

    One variable may stand in a file twice, in two units; the first serves as well as the second.
    """
    places: dict[str, int] = {}
    for place, name in enumerate(names):
        plain = " ".join(re.sub(r"[’′‘`´]", "'", name).replace("″", "''").lower().split())
        for role, pattern in ROLES.items():
            if pattern.fullmatch(plain):
                places.setdefault(role, place)
    return places
