"""The output of a format's reader: traction readings of one file in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.traction import TractionStep

if TYPE_CHECKING:
    from datetime import datetime


#: Which of an instrument's thermometers gives the temperature of the readings.
Thermometer: TypeAlias = Literal["lube", "pot"]


@dataclass(frozen=True, eq=False)
class TractionReadings:
    """Readings of one file; columns as in `viscofric.traction.TractionRuns`."""

    source: str
    disc_speed: Array
    ball_speed: Array
    traction_force: Array
    load: Array
    temperature: Array
    row: Integers  # of the file's tables; readings of one row were taken together
    replicate: Integers | None = None  # as the file numbers its repetitions
    zero_force: Array | None = None
    time: Array | None = None  # since the file's first reading, s
    track_radius: Array | None = None
    step: Integers | None = None  # as the file numbers its steps
    steps: tuple[TractionStep, ...] = ()
    began: datetime | None = None  # time of the first reading by the instrument's clock
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.disc_speed)

    def same_as(self, other: TractionReadings) -> bool:
        """Return whether all readings are those of the other file."""
        names = ("disc_speed", "ball_speed", "traction_force", "load", "temperature", "replicate")
        return len(self) == len(other) and all(
            np.array_equal(getattr(self, name), getattr(other, name)) for name in names
        )
