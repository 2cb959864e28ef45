"""Samples of a material, and their statistics: bands of the moduli, standard errors, bands of derived quantities."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscofric.arguments import insist_on_function
from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.notes import Note
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.quality import beyond_note, covers
from viscofric.rheology.uncertainty.residuals import SystematicMisfit
from viscofric.showing import Items, Plotted, Rows
from viscofric.units import Quantity, in_si, share


class _Limits(NamedTuple):
    lower: NDArray[Any]
    middle: NDArray[Any]
    upper: NDArray[Any]


class Band(_Limits):
    """Lower limit, median and upper limit, arrays of one shape; of complex moduli those of E' and of E'' apart."""

    notes: tuple[Note, ...] = ()  # on doubts about them


class StandardErrors(NamedTuple):
    """Standard errors of E0 (Pa), E_inf (Pa) and of every C (1/Pa)."""

    E0: float
    E_inf: float
    C: Array


@dataclass(frozen=True, eq=False)
class MaterialSamples(Plotted, Items["Material"]):
    """Uncertainty samples of a material, bootstrap or posterior; their spread is the uncertainty.

    Parameters
    ----------
    materials : tuple of Material
        Each with a spectrum and a shift that belong together.
    C : (samples, n) array
        Compliance of every mode, zeros included, 1/Pa.  Samples of `sample_materials` have modes at times of their own;
        here each is shared between the two neighbouring times.
    tau : (samples, n) array
        Retardation times, s; the same in every row, unless the modes are sparse.
    frequency_range : tuple of float
        Reduced angular frequencies that were measured, rad/s.  Beyond them the bands show what smooth continuations of
        the spectrum would do.
    misfit : SystematicMisfit or None
        What the fitted spectrum misses of the measured moduli beyond noise; None where that is not known.
    """

    materials: tuple[Material, ...]
    C: Array
    tau: Array
    frequency_range: tuple[float, float]
    misfit: SystematicMisfit | None = None

    def _items(self) -> Sequence[Material]:
        return self.materials

    def _shown(self) -> Rows:
        return (
            ("samples", len(self)),
            ("measured", self.frequency_range, "rad/s"),
            ("E0", self.E0, "Pa"),
            ("E_inf", self.E_inf, "Pa"),
        )

    @cached_property
    def E0(self) -> Array:
        """Rubber modulus of every sample, (samples,), Pa."""
        return np.array([material.at().E0 for material in self.materials])

    @cached_property
    def E_inf(self) -> Array:
        """Glass modulus of every sample, (samples,), Pa."""
        return np.array([material.at().E_inf for material in self.materials])

    @property
    def standard_errors(self) -> StandardErrors:
        """Standard deviations over the samples; those of neighbouring C are strongly correlated."""
        return StandardErrors(
            float(np.std(self.E0, ddof=1)), float(np.std(self.E_inf, ddof=1)), np.std(self.C, axis=0, ddof=1)
        )

    @property
    def covariance(self) -> Array:
        """Covariance of the C, (n, n), 1/Pa²."""
        return np.atleast_2d(np.cov(self.C, rowvar=False))

    def modulus_band(
        self, angular_frequency: ArrayLike, temperature: Quantity | None = None, level: float = 0.95
    ) -> Band:
        """Return limits that hold E'(ω, T), and limits that hold E''(ω, T), with probability `level` each.

        Parameters
        ----------
        angular_frequency : array_like
            rad/s.
        temperature : float or quantity, optional
            K, or text such as ``"60 degC"``; None means the reference.
        level : float
            Above 0 and below 1.

        Returns
        -------
        Band
            Of complex moduli in the shape of `angular_frequency`, Pa; pointwise, not for the curve as a whole.  Its
            `notes` have `beyond-measured` where frequencies were not measured.

        Notes
        -----
        Where the spectrum misses what was measured by more than noise (`misfit`), this is added as another error of the
        logarithms of E' and E'', independent of those that were drawn.

        Of random rubbers with 3 to 8 isotherms, 95 % bands held 91 to 100 % of E' and E'' within half a decade of the
        ends of the measured frequencies, and up to a decade beyond them 75 to 100 %, but 59 to 88 % of spectra of few
        modes (`benchmarks/rheology`).  With isotherms offset by 3 % they held 95 % of E' and 94 % of E'' inside, 84 to
        95 % within half a decade of the ends, and of power laws, in which shifts take the place of offsets, 69 % of E'
        at the upper end.  Farther out the limits hold nothing that is known.  `to_dataset` states
        which frequencies were measured.
        """
        omega, level = in_si(angular_frequency, "rad/s", "angular_frequency"), share(level, "level", example=0.95)
        moduli = np.array([material.complex_modulus(omega, temperature) for material in self.materials])
        storage, loss = _limits(moduli.real, level), _limits(moduli.imag, level)
        reduced = np.abs(omega) * 10.0 ** self._log10_alpha(temperature)
        if self.misfit is not None and np.any(self.misfit.size):
            missed = NormalDist().inv_cdf(0.5 + 0.5 * level) * self.misfit.at(np.log10(reduced + 1e-300))
            storage, loss = _widened(storage, missed[..., 0]), _widened(loss, missed[..., 1])
        found = Band(*(real + 1j * imaginary for real, imaginary in zip(storage, loss, strict=True)))
        found.notes = self._beyond(reduced)
        return found

    def _beyond(self, reduced: Array) -> tuple[Note, ...]:
        """Return a note on reduced frequencies that were not measured."""
        beyond = reduced[~covers(self.frequency_range, reduced)]
        if not beyond.size:
            return ()
        subject = f"{beyond.size} of {reduced.size} reduced frequencies, {beyond.min():.3g} to {beyond.max():.3g} rad/s"
        values = {
            "points": beyond.size,
            "of": reduced.size,
            "lowest": float(beyond.min()),
            "highest": float(beyond.max()),
        }
        return (beyond_note(self.frequency_range, f"{subject}, lie", "measured", **values),)

    def to_dataset(
        self, angular_frequency: ArrayLike, temperature: Quantity | None = None, level: float = 0.95
    ) -> Dataset:
        """Return the limits of `modulus_band` as a labelled data set.

        Parameters
        ----------
        angular_frequency, temperature, level
            See `modulus_band`.

        Returns
        -------
        xarray.Dataset
            ``storage_modulus_lower``, ``storage_modulus_upper``, ``loss_modulus_lower`` and ``loss_modulus_upper`` (Pa)
            along ``angular_frequency`` (rad/s), and ``within_measured_frequencies``, 0 where the limits belong to an
            extrapolated spectrum.
        """
        omega = np.ravel(in_si(angular_frequency, "rad/s", "angular_frequency"))
        level = share(level, "level", example=0.95)
        band = self.modulus_band(omega, temperature, level)
        within = covers(self.frequency_range, omega * 10.0 ** self._log10_alpha(temperature)).astype(float)
        columns = {"within_measured_frequencies": (within, "1", "whether the frequency was measured")}
        for part, take in {"storage": np.real, "loss": np.imag}.items():
            for end, limit in {"lower": band.lower, "upper": band.upper}.items():
                meaning = f"{end} end of the {100 * level:g} % band of the {part} modulus"
                columns[f"{part}_modulus_{end}"] = (take(limit), "Pa", meaning)
        coordinates = {"angular_frequency": (omega, "rad/s", "angular frequency")}
        return dataset("angular_frequency", columns, coordinates=coordinates)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the bands, one sentence each."""
        return () if self.misfit is None else self.misfit.notes

    def _log10_alpha(self, temperature: Quantity | None) -> float:
        """Mean log10 α of the samples, zero at the reference."""
        shifts = [material.shift for material in self.materials if material.shift is not None]
        if temperature is None or not shifts:
            return 0.0
        return float(np.mean([shift.log10(temperature) for shift in shifts]))

    def spectrum_band(self, level: float = 0.95) -> Band:
        """Return limits of every C, 1/Pa, at the times `tau`.

        Single modes are poorly determined: neighbouring modes compensate each other.

        Parameters
        ----------
        level : float
            Probability that the limits include, between 0 and 1.

        Returns
        -------
        Band
            Lower limit, median and upper limit, (n,) each.
        """
        return _limits(self.C, level)

    def band(self, value: Callable[[Material], ArrayLike], level: float = 0.95) -> Band:
        """Return limits of anything that follows from a material.

        Parameters
        ----------
        value : callable
            Of a `Material`: a number or an array, always of the same shape.
        level : float
            Above 0 and below 1.
        """
        insist_on_function(value, "value", needed=True)
        return _limits(np.array([value(material) for material in self.materials]), level)


def _widened(band: Band, decades: Array) -> Band:
    """Return limits with an independent error of log10 of the values added, where the values are above zero."""
    lower, middle, upper = (np.maximum(one, 1e-300) for one in band)
    down, up = np.log10(middle / lower), np.log10(upper / middle)
    down, up = np.hypot(down, decades), np.hypot(up, decades)
    return Band(middle * 10.0**-down, band.middle, middle * 10.0**up)


def _limits(values: NDArray[Any], level: float) -> Band:
    outside = 0.5 * (1.0 - share(level, "level", example=0.95))
    # Weibull's plotting position: a further sample lies between the limits with exactly this probability.
    return Band(*np.quantile(values, [outside, 0.5, 1.0 - outside], axis=0, method="weibull"))
