"""Retardation modes for a table of moduli, as close to it as modes can come."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from viscofric.data import MasterCurve
from viscofric.errors import InputError
from viscofric.rheology.spectra.fit_verdict import judged, solid_modes
from viscofric.rheology.spectra.modulus_misfit import ModulusMisfit
from viscofric.rheology.spectra.nonnegative import lattice, nonnegative_modes
from viscofric.rheology.spectra.sparse import joint_error
from viscofric.rheology.spectra.spectrum_fit import as_spectrum
from viscofric.threads import one_blas_thread

if TYPE_CHECKING:
    from viscofric.rheology.spectra.modulus_table import ModulusTable
    from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Largest joint rms error of log10 E' and log10 E'' that passes for the same material: 12 %.
LARGEST_ERROR = 0.05
#: Ratios of neighbouring retardation times, each lattice tried only near the modes of the one before.  A time between
#: two of the last is met to (ln ratio)²/8 = 2e-4.
RATIOS = (2.0, 2.0**0.25, 2.0**0.0625)
#: A joint error that no finer lattice has to improve.
CLOSE = 1e-6
#: Where a table takes its ends for plateaus, they are fitted over so many decades beyond, at so many points a decade.
PLATEAU_DECADES, PLATEAU_POINTS = 2, 5
#: A table tells of no temperature; what is said about a fit does not depend on it.
ANY_TEMPERATURE = 298.15


@one_blas_thread
def modes_of_table(table: ModulusTable) -> RetardationSpectrum:
    """Fit retardation modes to a table of moduli.

    Parameters
    ----------
    table : ModulusTable
        At least four frequencies.  Where it takes its ends for plateaus, so do the modes.

    Returns
    -------
    RetardationSpectrum
        Its `fit` holds the misfit and what is extrapolated.

    Raises
    ------
    InputError
        If the table is too short or that of a liquid, or no modes describe it: then E' and E'' do not belong to one
        material (they break the relations of Kramers and Kronig), or scatter too much.

    Notes
    -----
    The sum of squares of the errors of ln E' and ln E'' is minimised over C ≥ 0 on a coarse lattice of times, then on
    finer ones near the modes found, so that a few sharp modes are met as well as a broad spectrum.
    """
    curve = _as_curve(table)
    if len(table) < 4:
        raise InputError(
            f"a modulus table of {len(table)} frequencies is too short for retardation modes; give 4 or more."
        )
    misfit = ModulusMisfit(curve.angular_frequency, curve.complex_modulus)
    modes = nonnegative_modes(misfit, lattice(misfit, RATIOS[0]))
    error = joint_error(misfit, modes)
    for coarse, fine in pairwise(RATIOS):
        if error <= CLOSE:
            break
        tau, known = lattice(misfit, fine), modes.tau[modes.C > 0.0]
        near = np.abs(np.log(tau)[:, None] - np.log(known)).min(axis=1, initial=np.inf) <= 1.01 * np.log(coarse)
        closer = nonnegative_modes(misfit, tau[near])
        if (smaller := joint_error(misfit, closer)) < error:
            modes, error = closer, smaller
    if not error <= LARGEST_ERROR:
        solid_modes(misfit, lattice(misfit, RATIOS[0]), curve)  # a liquid is refused by its name
        raise InputError(
            f"no retardation modes describe this table of moduli: the best leave an rms error of {error:.2g} decades "
            f"of E' and E'', more than {LARGEST_ERROR:g}, so that they are not one material's; smooth the table, or "
            "fit a spectrum to its master curve with fit_retardation_spectrum(…)."
        )
    return judged(as_spectrum(modes), curve, method="non-negative")


def what_was_fitted(spectrum: RetardationSpectrum) -> tuple[str, ...]:
    """Say in sentences that modes stand for a table, and how well."""
    fit = spectrum.fit
    if fit is None or fit.rms_storage is None or fit.rms_loss is None:
        return ()
    stands = (
        f"The material is a table of moduli, for which {fit.modes} retardation modes fitted to it stand: rms errors of "
        f"{fit.rms_storage:.2g} decades of E' and {fit.rms_loss:.2g} of E''."
    )
    return (stands, *fit.notes)


def _as_curve(table: ModulusTable) -> MasterCurve:
    omega = table.angular_frequency
    if table.extrapolate == "plateau":
        beyond = 10.0 ** (np.arange(1, PLATEAU_DECADES * PLATEAU_POINTS + 1) / PLATEAU_POINTS)
        omega = np.concatenate([omega[0] / beyond[::-1], omega, omega[-1] * beyond])
    modulus = table.complex_modulus(omega)
    return MasterCurve(omega, modulus.real, modulus.imag, np.full(len(omega), ANY_TEMPERATURE), ANY_TEMPERATURE)
