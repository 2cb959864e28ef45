"""Plain tables (CSV) of sweeps, master curves and spectra, for any other program and for `read_dma` again."""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from viscofric.files import write_atomically
from viscofric.units import CELSIUS_ZERO, celsius

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from viscofric.data import IsothermalSweeps, MasterCurve
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


def write_sweeps(sweeps: IsothermalSweeps, path: str | Path) -> Path:
    """Write the points of sweeps as a table that `read_dma` reads; strain amplitudes are not in it.

    Parameters
    ----------
    sweeps : IsothermalSweeps
        As read; moduli as measured, in MPa, headed E or G.
    path : str or Path
        Replaced if it exists.

    Raises
    ------
    DataFileError
        If it cannot be written.
    """
    letter = "E" if sweeps.deformation == "tension" else "G"
    headings = ["temperature (degC)", "frequency (Hz)", f"{letter}' (MPa)", f"{letter}'' (MPa)"]
    rows = (
        (celsius(one.temperature), frequency / (2 * math.pi), storage / 1e6, loss / 1e6)
        for one in sweeps.isotherms
        for frequency, storage, loss in zip(one.angular_frequency, one.storage_modulus, one.loss_modulus, strict=True)
    )
    return _write(path, headings, rows)


def write_master_curve(curve: MasterCurve, path: str | Path) -> Path:
    """Write a master curve: reduced angular frequency, tensile moduli, and the isotherm each point comes from."""
    headings = ["reduced angular frequency (rad/s)", "E' (Pa)", "E'' (Pa)", "isotherm (degC)"]
    columns = (curve.angular_frequency, curve.storage_modulus, curve.loss_modulus, curve.temperature - CELSIUS_ZERO)
    remark = f"reference temperature {celsius(curve.reference):z.6g} degC"
    return _write(path, headings, np.column_stack(columns), remark)


def write_spectrum(spectrum: RetardationSpectrum, path: str | Path) -> Path:
    """Write the retardation modes: 1/E(ω) = 1/E_inf + Σ C/(1 + iωτ)."""
    remark = f"E0 = {spectrum.E0!r} Pa, E_inf = {spectrum.E_inf!r} Pa; 1/E = 1/E_inf + sum of C/(1 + i omega tau)"
    return _write(path, ["retardation time tau (s)", "C (1/Pa)"], np.column_stack((spectrum.tau, spectrum.C)), remark)


def _write(
    path: str | Path, headings: Sequence[str], rows: Iterable[Sequence[float]], remark: str | None = None
) -> Path:
    """Write rows with as many digits as tell the numbers apart."""
    text = io.StringIO()
    if remark is not None:
        text.write(f"# {remark}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows([f"{float(number):.10g}" for number in row] for row in rows)
    target = Path(path)
    write_atomically(target, text.getvalue().encode())
    return target
