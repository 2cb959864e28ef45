"""A spectrum fitted again to samples of its master curve, by its own method and starting from it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.spectra import regularised, sparse
from viscofric.rheology.spectra.modulus_misfit import Modes
from viscofric.rheology.spectra.nonnegative import lattice_between, nonnegative_modes

if TYPE_CHECKING:
    from viscofric.rheology.spectra.modulus_misfit import Misfit
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


#: Refits start at the fit to the measurement; a tolerance well below the noise is sufficient.
CONVERGED = 1e-3

#: Times closer than this are the same time of the lattice.
SAME = 1e-6  # of ln τ


class Refit:
    """Fits samples of a master curve as a fitted spectrum was, starting from it; InputError if it was not fitted.

    `like` is the misfit of the curve; `lowest` and `highest` are the ends of the angular frequencies of all samples,
    rad/s.  The lattice of times spans them, but each sample uses only its own part of it.
    """

    def __init__(self, spectrum: RetardationSpectrum, like: Misfit, lowest: float, highest: float) -> None:
        if spectrum.fit is None or not spectrum.fit.method or spectrum.fit.from_contact:
            raise InputError(
                "spectrum: was not fitted to a master curve, so that it cannot be fitted to samples of one; "
                "give what fit_retardation_spectrum returned.",
                code="not-fitted",
            )
        self.strength = spectrum.fit.regularisation
        self.on_lattice = spectrum.fit.tau_ratio is not None
        self.start = Modes(1.0 / spectrum.E_inf, np.array(spectrum.C), np.array(spectrum.tau))
        if spectrum.fit.tau_ratio is not None:
            tau = lattice_between(like.ends_of(lowest, highest), spectrum.fit.tau_ratio)
            away = np.abs(np.log(self.start.tau)[:, None] - np.log(tau)).min(axis=1)
            tau = np.sort(
                np.append(tau, self.start.tau[away > SAME])
            )  # the slowest may lie between two times of the lattice
            C = np.zeros(len(tau))
            C[np.abs(np.log(self.start.tau)[:, None] - np.log(tau)).argmin(axis=1)] = self.start.C
            self.start = Modes(self.start.glass, C, tau)

    def __call__(self, misfit: Misfit) -> Modes:
        """Return the fitted modes, always the same number, zeros included."""
        if not self.on_lattice:
            return sparse.moved_modes(misfit, self.start, tidy=False, converged=CONVERGED)
        low, high = misfit.ends
        inside = (np.log(self.start.tau) >= low) & (np.log(self.start.tau) <= high)
        start = Modes(self.start.glass, self.start.C[inside], self.start.tau[inside])
        if self.strength is not None:
            found = regularised.smooth_modes(misfit, start.tau, self.strength, start)
        else:
            found = nonnegative_modes(misfit, start.tau, start, converged=CONVERGED)
        C = np.zeros(len(self.start.tau))
        C[inside] = found.C
        return Modes(found.glass, C, self.start.tau)
