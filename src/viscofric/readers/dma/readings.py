"""What a reader of one DMA format hands on: the points of a file in SI units, not yet sorted into isotherms."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Remedy
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from viscofric.arrays import Array, Indices, Integers, Mask
    from viscofric.data import Deformation, Isotherm


#: What to do with a master curve where sweeps are read, and with sweeps where a master curve is.
AS_MASTER_CURVE = Remedy(
    "; use read_master_curve with its reference temperature.",
    run_file="; name it as master_curve, with its reference_temperature.",
    page="; under “Data” choose “A master curve” as the source, and drop it there.",
    field="material.dma",
)
AS_SWEEPS = Remedy(
    "; use read_dma.",
    run_file="; name it as dma.",
    page="; under “Data” choose “Sweeps of a DMA or rheometer” as the source, and drop it there.",
    field="material.master_curve",
)


@dataclass(frozen=True, eq=False)
class Readings:
    """Points of frequency sweeps as one file holds them, neither sorted nor judged yet.

    Rows that are no points of a frequency sweep may be left out already; `notes` tells of them.

    Parameters
    ----------
    source : str
        The file, as the user named it.
    format : str
        What it was taken for, in words: ``"TA Instruments TRIOS text (LIMS export)"``.
    places : tuple of str
        Where each point stands, for notes: ``"line 18"``, ``"sheet 'Exported Data', row 4"``.
    temperature : (n,) array
        As measured at the sample, K.
    angular_frequency : (n,) array
        rad/s.
    storage_modulus, loss_modulus : (n,) array
        As printed, of any sign, Pa.
    deformation : {"tension", "shear"} or None
        None where the file does not say it.
    said_by : str
        What in the file says so: ``"the heading G' (MPa)"``.
    strain_amplitude : (n,) array, optional
        Of the oscillation, as a fraction (0.01 is 1 %); NaN where a point has none.
    step : (n,) array of int, optional
        Number of the step of the instrument's programme that each point belongs to.
    notes : tuple of str
        What was doubtful or passed over while reading: one sentence each.
    unit_is_asked : bool
        Whether the moduli have no unit but the one that the user gave.
    """

    source: str
    format: str
    places: tuple[str, ...]
    temperature: Array
    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    deformation: Deformation | None = None
    said_by: str = ""
    strain_amplitude: Array | None = None
    step: Integers | None = None
    notes: tuple[str, ...] = ()
    unit_is_asked: bool = False

    def __len__(self) -> int:
        return len(self.temperature)


#: So many are named where many share a note.
_SHOWN = 3


@dataclass(frozen=True, eq=False)
class Points:
    """What several `Readings` hold, in the order in which it was read.

    Parameters
    ----------
    places : tuple of str
        Where each point stands, the file's name included where there are several.
    temperature, angular_frequency, storage_modulus, loss_modulus : (n,) array
        K, rad/s, Pa; as printed.
    strain_amplitude : (n,) array
        Fraction, NaN where unknown.
    file : (n,) array of int
        Which file each point comes from.
    step : (n,) array of int
        Step of the instrument's programme; meaningless where `has_step` is false.
    has_step : (n,) array of bool
        Whether the file tells steps.
    """

    places: tuple[str, ...]
    temperature: Array
    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    strain_amplitude: Array
    file: Integers
    step: Integers
    has_step: Mask

    def __len__(self) -> int:
        return len(self.places)

    def named(self, indices: Iterable[int]) -> str:
        """Name the places of points, the first few of many: ``"lines 18, 20, 31 and 9 more"``."""
        places = [self.places[index] for index in indices]
        shown, more = places[:_SHOWN], max(0, len(places) - _SHOWN)
        parted = [re.fullmatch(r"(?P<before>.*?)(?P<what>line|row|point) (?P<number>\d+)", place) for place in shown]
        alike = {(one["before"], one["what"]) for one in parted if one}
        if len(places) > 1 and len(alike) == 1 and all(parted):
            before, what = alike.pop()
            shown = [one["number"] for one in parted if one]
            return f"{before}{what}s {listed(shown, more)}"
        return listed(shown, more)


@dataclass(frozen=True, eq=False)
class Sorted:
    """One isotherm and where its points come from.

    Parameters
    ----------
    isotherm : Isotherm
        Sorted and averaged.
    rows : (m,) array of int
        All its points in the order of reading.
    origins : tuple of (k,) array of int
        The points that each frequency was averaged from.
    """

    isotherm: Isotherm
    rows: Indices
    origins: tuple[Indices, ...]


def joined(readings: Sequence[Readings]) -> Points:
    """Put the points of all files in one row."""
    several = len(readings) > 1
    counts = [len(one) for one in readings]
    places = [
        f"{Path(one.source).name} {place}" if several else place
        for one in readings
        for place in (one.places or tuple(f"point {n + 1}" for n in range(len(one))))
    ]
    nothing = [np.full(count, np.nan) for count in counts]
    return Points(
        places=tuple(places),
        temperature=np.concatenate([one.temperature for one in readings]),
        angular_frequency=np.concatenate([one.angular_frequency for one in readings]),
        storage_modulus=np.concatenate([one.storage_modulus for one in readings]),
        loss_modulus=np.concatenate([one.loss_modulus for one in readings]),
        strain_amplitude=np.concatenate(
            [
                none if one.strain_amplitude is None else one.strain_amplitude
                for one, none in zip(readings, nothing, strict=True)
            ]
        ),
        file=np.repeat(np.arange(len(readings)), counts),
        step=np.concatenate([np.zeros(len(one), dtype=np.int64) if one.step is None else one.step for one in readings]),
        has_step=np.repeat([one.step is not None for one in readings], counts),
    )


def listed(shown: Sequence[str], more: int = 0) -> str:
    """Join words by commas and a last "and"."""
    if more:
        return f"{', '.join(shown)} and {more} more"
    return f"{', '.join(shown[:-1])} and {shown[-1]}" if len(shown) > 1 else "".join(shown)


def at(temperatures: Sequence[float]) -> str:
    """Name temperatures (K) in °C, the first few of many: ``"at 0.0, 10.0, 20.0 °C and 2 more temperatures"``."""
    shown = [f"{celsius(kelvin):z.1f}" for kelvin in temperatures[:_SHOWN]]
    more = len(temperatures) - len(shown)
    if more:
        return f"at {', '.join(shown)} °C and {more} more temperature{'s' if more > 1 else ''}"
    return f"at {listed(shown)} °C"
