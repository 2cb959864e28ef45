"""What a reader of one DMA format hands on: the points of a file in SI units, not yet sorted into isotherms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.notes import Remedy

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers
    from viscofric.data import Deformation


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
