"""What a reader of one format hands on: the traction readings of a file in SI units, not yet put with others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from datetime import datetime

    from viscofric.arrays import Array, Integers
    from viscofric.traction import TractionStep


#: Which of an instrument's thermometers gives the temperature of the readings.
Thermometer: TypeAlias = Literal["lube", "pot"]


@dataclass(frozen=True, eq=False)
class TractionReadings:
    """Readings as one file holds them.

    Parameters
    ----------
    source : str
        The file, as the user named it.
    disc_speed, ball_speed, traction_force, load, temperature : (n,) array
        As in `viscofric.traction.TractionRuns`.
    row : (n,) array of int
        Row of the file's tables that a reading stands in: those of one row were taken together.
    replicate : (n,) array of int, optional
        As the file numbers its repetitions.
    zero_force, time, track_radius : (n,) array, optional
        As in `viscofric.traction.TractionRuns`; the time is that since the file's first reading.
    step : (n,) array of int, optional
        As the file numbers its steps.
    steps : tuple of TractionStep
        What the file says of them.
    began : datetime, optional
        When the first reading was taken, by the clock of the instrument.
    notes : tuple of str
        What was doubtful, passed over or assumed: one sentence each.
    """

    source: str
    disc_speed: Array
    ball_speed: Array
    traction_force: Array
    load: Array
    temperature: Array
    row: Integers
    replicate: Integers | None = None
    zero_force: Array | None = None
    time: Array | None = None
    track_radius: Array | None = None
    step: Integers | None = None
    steps: tuple[TractionStep, ...] = ()
    began: datetime | None = None
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.disc_speed)

    def same_as(self, other: TractionReadings) -> bool:
        """Return whether all readings are those of the other file."""
        names = ("disc_speed", "ball_speed", "traction_force", "load", "temperature", "replicate")
        return len(self) == len(other) and all(
            np.array_equal(getattr(self, name), getattr(other, name)) for name in names
        )
