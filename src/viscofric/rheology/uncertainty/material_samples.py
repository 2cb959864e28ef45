"""Samples of a material, and their statistics: bands, standard errors; the residuals that errors are drawn from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscofric.arguments import insist_on_function
from viscofric.arrays import Array, Integers
from viscofric.datasets import Dataset, dataset
from viscofric.notes import Note
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.quality import KnownFrequencies, covers
from viscofric.showing import Items, Plotted, Rows
from viscofric.units import Quantity, in_si, share

# A systematic misfit is correlated over neighbouring points, and no bootstrap of noise shows it.

#: Fewest points of an isotherm for a scatter of its own.
LEAST_POINTS = 3
#: A point of larger leverage shows no error.
LARGEST_LEVERAGE = 0.9
#: A larger correlation of neighbours would be an offset of the whole isotherm, which its own shift absorbs.
MOST_ALIKE = 0.95


class Residuals:
    """Residuals of ln E' and ln E'', or of ln of a step response, about a fit; errors drawn with the same statistics.

    Errors are drawn from a normal distribution, with each isotherm's own scatter, correlated between E' and E'' as the
    residuals are, and between neighbouring points of an isotherm by an autoregression of first order.  Residuals
    themselves are not resampled, in blocks or otherwise: the fit has removed all that is smooth from them, the part of
    the errors that it follows.

    Rows are points, isotherm by isotherm in ascending frequency: `values` (N, m) of E' and E''; `isotherm` (N,), the
    isotherm's number, ascending from 0 without gaps; `leverage` (N, m), the part of each point's error that the fit has
    followed, 0 to 1, by which residuals are smaller than errors.

    The scatter of each isotherm is shrunk towards the common one, unless they differ by more than chance: G. K. Smyth,
    Stat. Appl. Genet. Mol. Biol. 3 (2004) 3.
    """

    def __init__(self, values: Array, isotherm: Integers, leverage: Array) -> None:
        counts = np.bincount(isotherm)
        values = values / np.sqrt(1.0 - np.minimum(leverage, LARGEST_LEVERAGE))
        squares = np.stack([np.bincount(isotherm, weights=column**2) for column in values.T], axis=1)
        variances = np.stack([_moderated(column, counts) for column in squares.T], axis=1)
        #: Standard deviation of ln E' and ln E'' in every point, (N, 2).
        self.scale = np.sqrt(variances)[isotherm]
        unit = values / np.where(self.scale > 0.0, self.scale, 1.0)
        follows = isotherm[1:] == isotherm[:-1]
        total = np.sum(unit**2, axis=0) + 1e-300
        #: Correlation of neighbours along an isotherm, of E' and of E'', (2,); below zero is chance.
        self.alike = np.clip(np.sum((unit[1:] * unit[:-1])[follows], axis=0) / total, 0.0, MOST_ALIKE)
        #: Correlation of E' with E'' in one point.
        self.together = 0.0
        if len(total) > 1:
            self.together = float(np.sum(unit[:, 0] * unit[:, 1]) / np.sqrt(np.prod(total)))
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        self._steps = [starts[counts > step] + step for step in range(1, int(counts.max()))]

    def draw(self, random: np.random.Generator, samples: int) -> Array:
        """Return errors of ln E' and ln E'', (samples, N, 2), in the order of the residuals."""
        errors = random.standard_normal((samples, *self.scale.shape))
        if errors.shape[-1] > 1:
            rest = np.sqrt(max(1.0 - self.together**2, 0.0))
            errors[..., 1] = self.together * errors[..., 0] + rest * errors[..., 1]
        if np.any(self.alike > 0.0):
            fresh = np.sqrt(1.0 - self.alike**2)
            for rows in self._steps:
                errors[:, rows] = self.alike * errors[:, rows - 1] + fresh * errors[:, rows]
        return np.asarray(self.scale * errors)


def _moderated(squares: Array, counts: Integers) -> Array:
    """Return variances of isotherms, shrunk towards the common one s0² of freedom ν0: (ν0 s0² + Σ r²)/(ν0 + n)."""
    common = float(squares.sum() / counts.sum())
    known = (counts >= LEAST_POINTS) & (squares > 0.0)
    if common <= 0.0 or known.sum() < LEAST_POINTS:
        return np.full(len(counts), common)
    freedom = prior_freedom(np.log(squares[known] / counts[known]), counts[known])
    if np.isinf(freedom):
        return np.full(len(counts), common)
    return np.asarray((freedom * common + squares) / (freedom + counts))


def prior_freedom(log_variances: Array, freedom: Array | Integers) -> float:
    """Return the degrees of freedom ν0 of the common variance, infinite where variances differ by chance only."""
    # The variance of ln s² (n,) is ψ'(ν/2) by chance, with ν degrees of freedom (n,), and ψ'(ν0/2) besides.
    from scipy.special import polygamma

    return freedom_of_scatter(float(np.var(log_variances, ddof=1) - np.mean(polygamma(1, 0.5 * freedom))))


def freedom_of_scatter(variance: float, least: float = 2e-3, most: float = 1e4) -> float:
    """Return the degrees of freedom f of sample variances with a variance of ln s², which is ψ′(f/2).

    Below `least` it is that, above `most` infinite.
    """
    from scipy.optimize import brentq
    from scipy.special import polygamma

    if variance <= polygamma(1, 0.5 * most):
        return np.inf
    if variance >= polygamma(1, 0.5 * least):
        return least
    return 2.0 * float(brentq(lambda half: float(polygamma(1, half)) - variance, 0.5 * least, 0.5 * most))


#: Number of neighbours along an isotherm over which residuals are averaged: noise averages out, a misfit does not.
NEIGHBOURS = 5
#: The misfit is the excess of the averages' squares over this many times the variance that noise leaves in them.
NOISE = 3.0
#: The misfit at a frequency is that of all points within this distance, whatever their isotherm.
WINDOW = 0.5  # decades
#: Smallest misfit for a note: sweeps of one sample repeat no better.
WORTH_A_NOTE = 0.02  # decades


@dataclass(frozen=True, eq=False)
class SystematicMisfit:
    """Root mean square of the misfit of a fit beyond noise."""

    log10_frequency: Array  # (n,), log10 of the reduced angular frequencies, ascending
    # (n, 2), of log10 E' and of log10 E'' there, decades; beyond the ends it keeps its value. Both are that of log10 of
    # the response where the spectrum was fitted to step tests.
    size: Array
    cause: str = ""  # the likely one, in words

    def __repr__(self) -> str:
        return f"SystematicMisfit(up to {float(self.size.max()):.2g} decades)"

    def at(self, log10_frequency: Array) -> Array:
        """Return the size at frequencies, in their shape and (2,), decades."""
        return np.stack([np.interp(log10_frequency, self.log10_frequency, one) for one in self.size.T], axis=-1)

    @property
    def notes(self) -> tuple[str, ...]:
        """Return a note on the misfit, if it is large enough for one."""
        worst = np.unravel_index(int(np.argmax(self.size)), self.size.shape)
        largest = float(self.size[worst])
        if largest < WORTH_A_NOTE:
            return ()
        modulus = ("E'", "E''")[worst[1]]
        sentence = Note(
            "fit-misses-data",
            f"The fit misses the measured moduli by more than noise, {modulus} by up to {largest:.2g} decades "
            f"({100.0 * (10.0**largest - 1.0):.2g} %) near {10.0 ** self.log10_frequency[worst[0]]:.1g} rad/s, with "
            f"the same sign at neighbouring points; likely because {self.cause}. The bands of E', E'' and predicted "
            "friction are widened accordingly; those of other quantities include the noise only.",
            values={
                "cause": self.cause,
                "modulus": modulus,
                "decades": largest,
                "angular_frequency": float(10.0 ** self.log10_frequency[worst[0]]),
            },
        )
        return (sentence,)


def systematic_misfit(log10_frequency: Array, residual: Array, isotherm: Integers, cause: str = "") -> SystematicMisfit:
    """Return the part of residuals that neighbouring points have in common."""
    # `log10_frequency` (N,) is log10 of the reduced angular frequency; `residual` (N, m) is measured minus fitted log10
    # E' and log10 E'', decades; `isotherm` (N,) the number of each point's isotherm. The variance of the noise follows
    # from second differences along each isotherm, in which a smooth misfit vanishes (J. von Neumann et al., Ann. Math.
    # Stat. 12 (1941) 153, with first differences).
    squares, noise = np.zeros_like(residual), np.zeros_like(residual)
    for number in np.unique(isotherm):
        rows = np.flatnonzero(isotherm == number)
        rows = rows[np.argsort(log10_frequency[rows], kind="stable")]
        values = residual[rows]
        width = min(NEIGHBOURS, len(rows))
        if len(rows) < 3:
            squares[rows], noise[rows] = 0.0, 0.0
            continue
        ones = np.ones(width)
        count = np.convolve(np.ones(len(rows)), ones, mode="same")
        means = np.stack([np.convolve(column, ones, mode="same") for column in values.T], axis=1) / count[:, None]
        squares[rows] = means**2
        noise[rows] = np.mean(np.diff(values, 2, axis=0) ** 2, axis=0) / 6.0 / count[:, None]
    grid = np.arange(log10_frequency.min(), log10_frequency.max() + 0.5 * WINDOW, 0.5 * WINDOW)
    size = np.zeros((len(grid), residual.shape[1]))
    for place, centre in enumerate(grid):
        near = np.abs(log10_frequency - centre) <= WINDOW
        if np.any(near):
            size[place] = np.sqrt(np.maximum(np.mean(squares[near] - NOISE * noise[near], axis=0), 0.0))
    return SystematicMisfit(grid, size if size.shape[1] > 1 else np.repeat(size, 2, axis=1), cause)


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
class MaterialSamples(KnownFrequencies, Plotted, Items["Material"]):
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
        Reduced angular frequencies that were measured, rad/s.  Beyond them bands include spectra that end there and
        such that go on (`sample_materials`).
    misfit : SystematicMisfit or None
        What the fitted spectrum misses of the measured moduli beyond noise; None where that is not known.
    gaps : tuple of (float, float)
        Parts of `frequency_range` in which nothing was measured, rad/s.
    """

    materials: tuple[Material, ...]
    C: Array
    tau: Array
    frequency_range: tuple[float, float]
    misfit: SystematicMisfit | None = None
    gaps: tuple[tuple[float, float], ...] = ()

    def _items(self) -> Sequence[Material]:
        return self.materials

    def _shown(self) -> Rows:
        return (
            ("samples", len(self)),
            ("measured", self.frequency_range, "rad/s"),
            *(("not measured", gap, "rad/s") for gap in self.gaps),
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
        """Half of the ranges of E0 and E_inf that hold 68 % of the samples, and standard deviations of C.

        Standard deviations of E0 and E_inf would be those of a few samples: what lies beyond the measured frequencies
        is drawn from a wide distribution.  Neighbouring C are strongly correlated.
        """
        middle = NormalDist().cdf(1.0) - NormalDist().cdf(-1.0)
        ends = (_limits(one, middle) for one in (self.E0, self.E_inf))
        E0, E_inf = (0.5 * float(one.upper - one.lower) for one in ends)
        return StandardErrors(E0, E_inf, np.std(self.C, axis=0, ddof=1))

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

        Of random rubbers with 3 to 8 isotherms, 95 % bands held 94 to 100 % of E' and E'' within the measured
        frequencies, and 88 to 100 % up to five decades beyond, where they are the wider the farther out; with isotherms
        offset by 3 % 89 to 98, and 88 to 100 %.  Fewest were those of spectra of few modes, 58 % of E' three decades
        above (`benchmarks/rheology`).  `to_dataset` states which frequencies were measured.
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
        beyond = reduced[~covers(self.frequency_range, reduced, self.gaps)]
        if not beyond.size:
            return ()
        subject = f"{beyond.size} of {reduced.size} reduced frequencies, {beyond.min():.3g} to {beyond.max():.3g} rad/s"
        values = {
            "points": beyond.size,
            "of": reduced.size,
            "lowest": float(beyond.min()),
            "highest": float(beyond.max()),
        }
        return (self.beyond_note(f"{subject}, lie", **values),)

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
            extrapolated spectrum, or one interpolated in a gap.
        """
        omega = np.ravel(in_si(angular_frequency, "rad/s", "angular_frequency"))
        level = share(level, "level", example=0.95)
        band = self.modulus_band(omega, temperature, level)
        reduced = np.abs(omega) * 10.0 ** self._log10_alpha(temperature)
        within = covers(self.frequency_range, reduced, self.gaps).astype(float)
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
