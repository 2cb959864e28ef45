"""The output of a format's reader: points of files in SI units, not yet sorted into isotherms."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from viscofric.arrays import Array, Indices, Integers, Mask
from viscofric.data import Deformation, Isotherm
from viscofric.errors import DataFileError
from viscofric.notes import Remedy
from viscofric.showing import several
from viscofric.units import shown_celsius

#: What to do with a master curve in place of sweeps, and with sweeps in place of a master curve.
AS_MASTER_CURVE = Remedy(
    "; use read_master_curve with its reference temperature.",
    "; viscofric material fit --master-curve reads it.",
    run_file="; name it as master_curve, with its reference_temperature.",
    page="; under “Data” choose “A master curve” as the source, and drop it there.",
    field="material.dma",
)
AS_SWEEPS = Remedy(
    "; use read_dma.",
    "; viscofric material read and fit read it.",
    run_file="; name it as dma.",
    page="; under “Data” choose “Sweeps of a DMA or rheometer” as the source, and drop it there.",
    field="material.master_curve",
)
#: What to do with a temperature ramp, or an amplitude sweep, in place of frequency sweeps.
AS_RAMPS = Remedy(
    "; use read_ramps for it.",
    "; `viscofric material ramp` reads it.",
    "; name it as ramps.",
    "; under “Data” choose “Temperature ramps” as the source, and drop it there.",
    "material.dma",
)
AS_AMPLITUDES = Remedy(
    "; use read_amplitude_sweep for it.",
    "; `viscofric material amplitude` reads it.",
    "; name it as amplitude_sweep, beside the source of the material.",
    "; drop it under “Data” alone, beside the source of the material.",
    "material.dma",
)
#: Columns that all readings have.
_MEASURED = ("temperature", "angular_frequency", "storage_modulus", "loss_modulus")


@dataclass(frozen=True, eq=False)
class Readings:
    """Points of frequency sweeps in one file, neither sorted nor checked yet.

    Rows that are not points of a frequency sweep may be left out already; `notes` reports them.
    """

    source: str
    format: str  # in words, such as "TA Instruments TRIOS text (LIMS export)"
    places: tuple[str, ...]  # of each point: "line 18"
    temperature: Array  # (n,), of the sample, K
    angular_frequency: Array  # rad/s
    storage_modulus: Array  # as printed, of any sign, Pa
    loss_modulus: Array  # Pa
    deformation: Deformation | None = None  # None if the file does not state it
    said_by: str = ""  # such as "the heading G' (MPa)"
    strain_amplitude: Array | None = None  # fraction (0.01 is 1 %), NaN if unknown
    step: Integers | None = None  # of the instrument's programme
    notes: tuple[str, ...] = ()
    lacks_unit: bool = False  # the moduli have no unit but the user's

    def __len__(self) -> int:
        return len(self.temperature)

    @property
    def complete(self) -> Mask:
        """Which points have a temperature, a frequency above zero and both moduli, (n,)."""
        known = self.temperature + self.storage_modulus + self.loss_modulus
        return np.isfinite(known) & (self.angular_frequency > 0.0)

    def taken(self, rows: Indices) -> Readings:
        """Return some of the points, in the order of their rows."""
        columns = {name: getattr(self, name) for name in (*_MEASURED, "strain_amplitude", "step")}
        kept: dict[str, Any] = {name: None if one is None else one[rows] for name, one in columns.items()}
        return replace(self, places=tuple(self.places[row] for row in rows), **kept)


def of_one_file(parts: Sequence[Readings], what: str) -> Readings:
    """Join the points of tables of one file, called `what` in an error, without their steps."""
    stating = next((part for part in parts if part.deformation is not None), parts[0])
    if any(part.deformation not in (None, stating.deformation) for part in parts):
        raise DataFileError(stating.source, f"{what} differ in E and G; separate them.", code="deformation-contradicts")
    points = joined(parts)
    measured: dict[str, Any] = {name: getattr(points, name) for name in _MEASURED}
    return replace(
        stating,
        **measured,
        places=tuple(place for part in parts for place in part.places),
        strain_amplitude=points.strain_amplitude if np.any(np.isfinite(points.strain_amplitude)) else None,
        step=None,
        lacks_unit=any(part.lacks_unit for part in parts),
        notes=tuple(dict.fromkeys(note for part in parts for note in part.notes)),
    )


#: Number of places named in one note.
_SHOWN = 3


@dataclass(frozen=True, eq=False)
class Points:
    """The points of several `Readings`, in the order of reading."""

    places: tuple[str, ...]  # with the file's name if there are several
    temperature: Array  # K
    angular_frequency: Array  # rad/s
    storage_modulus: Array  # Pa
    loss_modulus: Array  # Pa
    strain_amplitude: Array  # fraction, NaN if unknown
    file: Integers  # number of the file
    step: Integers  # arbitrary if has_step is false
    has_step: Mask

    def __len__(self) -> int:
        return len(self.places)

    def named(self, indices: Iterable[int]) -> str:
        """Return the places of points, the first few of many: ``"lines 18, 20, 31 and 9 more"``."""
        places = [self.places[index] for index in indices]
        form = re.compile(r"(?P<before>.*?)(?P<what>line|row|point) (?P<number>\d+)")
        parts = [form.fullmatch(place) for place in places[:_SHOWN]]
        alike = {(one["before"], one["what"]) for one in parts if one}
        if len(places) > 1 and len(alike) == 1 and all(parts):
            before, what = alike.pop()
            return f"{before}{what}s {several([*(one['number'] for one in parts if one), *places[_SHOWN:]], _SHOWN)}"
        return several(places, _SHOWN)


@dataclass(frozen=True, eq=False)
class Sorted:
    """One isotherm, sorted and averaged, and the points it consists of."""

    isotherm: Isotherm
    rows: Indices  # all its points in the order of reading
    origins: tuple[Indices, ...]  # the points that each frequency was averaged from


def joined(readings: Sequence[Readings]) -> Points:
    """Join the points of all files."""
    several = len(readings) > 1
    counts = [len(one) for one in readings]
    places = [
        f"{Path(one.source).name} {place}" if several else place
        for one in readings
        for place in (one.places or tuple(f"point {n + 1}" for n in range(len(one))))
    ]
    measured = {name: np.concatenate([getattr(one, name) for one in readings]) for name in _MEASURED}
    amplitudes = [one.strain_amplitude for one in readings]
    unknown = [np.full(count, np.nan) if one is None else one for one, count in zip(amplitudes, counts, strict=True)]
    return Points(
        places=tuple(places),
        **measured,
        strain_amplitude=np.concatenate(unknown),
        file=np.repeat(np.arange(len(readings)), counts),
        step=np.concatenate([np.zeros(len(one), dtype=np.int64) if one.step is None else one.step for one in readings]),
        has_step=np.repeat([one.step is not None for one in readings], counts),
    )


def at(temperatures: Sequence[float]) -> str:
    """Name temperatures (K) in °C, the first few of many: ``"at 0.0, 10.0, 20.0 °C and 2 more temperatures"``."""
    shown = [shown_celsius(kelvin) for kelvin in temperatures[:_SHOWN]]
    more = len(temperatures) - len(shown)
    if more:
        return f"at {', '.join(shown)} °C and {more} more temperature{'s' if more > 1 else ''}"
    return f"at {several(shown)} °C"
