"""Fitting of shift laws to measured shift factors by generalised least squares, with an estimate of the misfit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol

import numpy as np

from viscofric.arguments import whole_number
from viscofric.arrays import Array, Slopes, Squares, descend
from viscofric.errors import InputError, wrong_argument
from viscofric.notes import Note
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, ParametricLaw, WLFArrhenius
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10
from viscofric.units import shown_celsius

#: Kinds of law as `ShiftFactors.law` takes them.
LAWS = ("wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial")
TITLES = {law.kind: law.title for law in (WLF, Arrhenius, VFT, WLFArrhenius, InversePolynomial)}
#: Laws whose constants are sought by themselves; VFT follows from WLF.
_FITTED: dict[str, Any] = {law.kind: law for law in (Arrhenius, WLF, WLFArrhenius)}
#: Beyond this the WLF law is straight over any measured range and C1 and C2 cannot be separated.
LARGEST_C2 = 1e4  # K
LARGEST_DEGREE = 4


class Family:
    """One kind of law at a reference (K), to be fitted at ascending temperatures (n,) in K."""

    def __init__(self, kind: str, temperatures: Array, reference: float, size: int) -> None:
        self.kind, self.temperatures, self.reference, self.size = kind, temperatures, reference, size
        self.range = float(temperatures[0]), float(temperatures[-1])
        #: Whether the constants are sought through their logarithms; those that are not enter linearly.
        self.positive = kind != "polynomial"
        #: What Akaike's criterion adds to `size`.  The temperature where one law changes into another is no regular
        #: constant: it counts for three (Y. Ninomiya, Ann. Inst. Stat. Math. 67 (2015) 943).
        self.surcharge = 2 if kind == "wlf+arrhenius" else 0

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        """Return the law; with a covariance, as one fitted on these temperatures."""
        if self.kind == "polynomial":
            return InversePolynomial(parameters, self.reference, self.range, covariance)
        fitted = None if covariance is None else self.range
        law: ParametricLaw = _FITTED[self.kind](*parameters, self.reference, covariance, fitted)
        return law

    def start(self, values: Array) -> Array:
        """Return starting values of the constants from log10 α, (n,): a scan, the first by plain least squares."""
        if self.kind == "polynomial":
            return np.ones(self.size)
        trials = [(*_scaled(self.values(np.array(shape)), values), shape) for shape in self._shapes()]
        factor, _, shape = min(trials, key=lambda trial: trial[1])
        if self.kind == "arrhenius" and factor <= 0.0:
            raise InputError("the shift factors rise with temperature: no Arrhenius law describes them.", code="no-law")
        if self.kind != "arrhenius":
            self._insist_on_curvature(factor, shape[1])
        return np.array([factor * shape[0], *shape[1:]])

    def _shapes(self) -> list[tuple[float, ...]]:
        """Return constants to scan, of which the first enters linearly."""
        if self.kind == "arrhenius":
            return [(GAS_CONSTANT * LN10,)]
        if self.kind == "wlf":
            nearest = self.reference - self.range[0]
            return [(1.0, C2) for C2 in nearest + np.geomspace(1.0, LARGEST_C2, 80) if C2 > 0.0]
        middles = 0.5 * (self.temperatures[1:] + self.temperatures[:-1])
        return [(1.0, C2, Tg) for Tg in middles for C2 in np.geomspace(3.0, 1e3, 25)]

    def values(self, parameters: Array) -> Array:
        """Return log10 α, (n,)."""
        return self._valid(parameters)._log10(self.temperatures)

    def gradient(self, parameters: Array) -> Array:
        """Return the derivatives of log10 α by the constants, (n, size)."""
        if self.kind == "polynomial":  # whatever the coefficients, which may be of no law
            inverse = 1.0 / self.temperatures - 1.0 / self.reference
            return np.stack([inverse**power for power in range(1, self.size + 1)], axis=-1)
        return self._valid(parameters)._gradient(self.temperatures)

    def _valid(self, parameters: Array) -> ParametricLaw:
        """Return the law; `InputError` where it has no value at one of the temperatures."""
        law = self.law(parameters)
        law._refuse(self.temperatures)
        return law

    def _insist_on_curvature(self, factor: float, C2: float) -> None:
        if factor > 0.0 and C2 <= 0.5 * LARGEST_C2:
            return
        low, high = map(shown_celsius, self.range)
        shape = "rise with temperature" if factor <= 0.0 else "bend too little, or the wrong way"
        raise InputError(
            f"the shift factors from {low} to {high} °C {shape}: they do not fix the constants of the "
            f"{TITLES[self.kind]} law; take the measured ones, an Arrhenius law, or those of a narrower range of "
            "temperatures.",
            code="no-law",
        )


def family_of(kind: str, temperatures: Array, reference: float, degree: int | None = None) -> Family:
    """Return the family of a kind of law; a polynomial needs its degree."""
    if kind == "polynomial":
        return Family(kind, temperatures, reference, whole_number(degree, "degree", 1, LARGEST_DEGREE))
    return Family(kind, temperatures, reference, len(_FITTED[kind]._constants))


def _scaled(shape: Array, values: Array) -> tuple[float, float]:
    """Return the factor of `shape` that fits `values` best up to a constant, and the squared misfit."""
    shape, values = shape - shape.mean(), values - values.mean()
    factor = float(shape @ values / (shape @ shape))
    return factor, float(np.sum((values - factor * shape) ** 2))


#: Rounding of tabulated values; keeps exact tables from dividing by zero.
SMALLEST_ERROR = 1e-7  # decades
LARGEST_SCATTER = 10.0  # decades; explains anything
#: Least misfit of any law: where α changes by a tenth of a decade per kelvin, it corresponds to an error of 0.03 K in
#: an isotherm's temperature.
SMALLEST_MISFIT = 0.003  # decades
#: Usual misfit of a good law beyond the errors of the factors; the scale of a half-Cauchy density, which excludes no
#: size (A. Gelman, Bayesian Analysis 1 (2006) 515).
USUAL_MISFIT = 0.01  # decades
#: Sizes of a scatter (decades) over which likelihoods are averaged, and their density, in equal steps of the logarithm.
SCATTERS = np.geomspace(SMALLEST_MISFIT, LARGEST_SCATTER, 25)
DENSITY = SCATTERS / (1.0 + (SCATTERS / USUAL_MISFIT) ** 2)
#: Usual distances of the pole of a WLF law below the lowest temperature, each as likely as the others, K.  C2 about Tg
#: is 30 to 100 K for most rubbers (J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed. 1980, Table 11-II), and
#: the lowest temperature is Tg or some tens of kelvin above it.
POLES_BELOW = np.geomspace(40.0, 160.0, 8)
#: Lengths over which deviations from a law are correlated, over the range of temperatures: the deviations that laws
#: leave, such as a change of one law into another, are cubic, or bend more; longer ones are absorbed by the constants.
MISFIT_LENGTHS = (1.0 / 8.0, 1.0 / 4.0, 1.0 / 3.0)
#: Independent part of the variance of correlated deviations, for rounding.
ROUGHNESS = 1e-6
#: Stated errors of which residuals show no more than this part, since the constants absorb the rest, may be too small
#: by any factor.
VISIBLE = 0.01
#: A constant that is uncertain by a factor of a hundred is not determined by the data.
LARGEST_RELATIVE_ERROR = 100.0
ITERATIONS = 50
CONVERGED = 1e-7  # relative fall of the squared misfit


class Model(Protocol):
    """What is fitted to a table."""

    @property
    def positive(self) -> bool:
        """Whether the constants are sought through their logarithms; those that are not enter linearly."""

    @property
    def size(self) -> int:
        """Number of constants."""

    @property
    def surcharge(self) -> int:
        """What Akaike's criterion adds to `size`."""

    def start(self, values: Array, /) -> Array:
        """Return starting values of the constants for values (n,)."""

    def values(self, parameters: Array, /) -> Array:
        """Return the values (n,)."""

    def gradient(self, parameters: Array, /) -> Array:
        """Return their derivatives by the constants, (n, size)."""


@dataclass(frozen=True, eq=False)
class Whitening:
    """From values (n,), or columns (n, k), to m combinations of variance one.

    Beyond their own errors, the combinations may share `axes` (m, k), orthonormal, with errors of these sizes (k,).
    """

    turn: Array
    error: Array
    axes: Array | None = None
    sizes: Array | None = None

    def __call__(self, values: Array) -> Array:
        """Return the combinations (m,), or (m, k)."""
        return self.of_turned(self.turn @ values)

    def of_turned(self, turned: Array) -> Array:
        """Return the combinations of values that are turned already."""
        own = (turned.T / self.error).T
        if self.axes is None or self.sizes is None:
            return np.asarray(own)
        less = 1.0 - 1.0 / np.sqrt(1.0 + self.sizes**2)
        return np.asarray(own - (self.axes * less) @ (self.axes.T @ own))

    @property
    def log_det(self) -> float:
        """Return ln det of the covariance that becomes the identity, without the part of `turn`."""
        shared = 0.0 if self.sizes is None else float(np.sum(np.log1p(self.sizes**2)))
        return 2.0 * float(np.sum(np.log(self.error))) + shared


@dataclass(frozen=True, eq=False)
class Table:
    """Values (n,) to be fitted, and m combinations of them that scatter independently."""

    values: Array
    turn: Array  # (m, n), from values to the combinations
    variance: Array  # (m,), of the combinations, as measured
    log_volume: float  # ln det of what `turn` divides the covariance by, needed in a likelihood

    def __len__(self) -> int:
        return len(self.variance)

    def whitening(self, added: float) -> Whitening:
        """Return what makes combinations of variance one, with an independent variance added to every value."""
        return Whitening(self.turn, np.sqrt(self.variance + added))


@dataclass(frozen=True, eq=False)
class FactorTable(Table):
    """Shift factors (values are log10 α) and their independent differences.

    Only differences of neighbouring factors enter: the error of the reference's own value, common to all, cancels.
    They are rotated so that their measured covariance becomes diagonal, and stays so when independent scatter of
    one size is added to every value.
    """

    temperatures: Array  # (n,), ascending, K
    reference: float  # K, where a law is to be 1
    covariance: Array  # (n, n), of the values as measured

    @classmethod
    def of(
        cls, temperatures: Array, values: Array, covariance: Array, reference: float, scatter_shape: Array | None = None
    ) -> FactorTable:
        """Prepare values (n,) at temperatures (n,), K, with their covariance (n, n).

        Scatter that is added has a covariance in proportion to `scatter_shape` (n, n); None: it is independent.
        """
        differences = np.diff(np.eye(len(temperatures)), axis=0)
        shape = np.eye(len(temperatures)) if scatter_shape is None else scatter_shape
        scatter = np.linalg.cholesky(differences @ shape @ differences.T)
        turn = np.linalg.solve(scatter, differences)
        variance, axes = np.linalg.eigh(turn @ covariance @ turn.T)
        floor = np.maximum(variance, 0.0) + SMALLEST_ERROR**2
        log_volume = 2.0 * float(np.sum(np.log(np.diag(scatter))))
        return cls(values, axes.T @ turn, floor, log_volume, temperatures, reference, covariance)

    def gain(self, constants: Array, gradient: Array, scatter: float) -> Array:
        """Return the changes (k, n) of fitted constants (k,) by the values, from a law's derivatives (n, k)."""
        scale, whiten = np.abs(constants) + np.finfo(float).tiny, self.whitening(scatter**2)
        return np.asarray(scale[:, None] * (np.linalg.pinv(whiten(gradient * scale)) @ whiten(np.eye(len(gradient)))))

    def misfit(self, gradient: Array, left: Array) -> Array:
        """Return the covariance (n, n) of what the values have beyond a law and their errors, as the residuals show.

        `gradient` (n, k) are the derivatives of the law by its constants, `left` (n,) the residuals.
        """
        # No law is exact.  Its misfit is taken to be normal, of unknown shape (`_shapes`) and size (decades, rms of the
        # residuals): both are weighted by how likely they make the residuals, and by the density of `criterion_of` for
        # sizes. The square of the mean size of each shape is taken: the mean square depends on sizes that few residuals
        # hardly exclude.
        if len(self) == gradient.shape[1]:  # the law passes through all values
            return np.zeros((len(left), len(left)))
        law = np.linalg.qr(gradient / np.linalg.norm(gradient, axis=0))[0]
        shapes = self._shapes(law)
        size = np.geomspace(SMALLEST_ERROR, LARGEST_SCATTER, 100)
        likelihood = np.array([self._likelihood(shape, size, law, left) for shape in shapes])
        weight = np.exp(likelihood - likelihood.max()) * size / (1.0 + (size / USUAL_MISFIT) ** 2)
        weight[0] *= max(len(shapes) - 1.0, 1.0)  # independent scatter is as likely as all other shapes together
        share = np.sum(weight, axis=1)
        typical = weight @ size / np.maximum(share, np.finfo(float).tiny)
        return np.asarray(np.tensordot(share / np.sum(share) * typical**2, shapes, axes=1))

    def _shapes(self, law: Array) -> list[Array]:
        """Return covariances (n, n) that a misfit may have: independent, alike at near temperatures, or as stated."""
        # Residuals bend along temperature; constants of other temperatures differ by more than independent scatter
        # explains; stated errors may be too small. Each covariance leaves residuals of rms 1 beside a law, whose
        # constants, with orthonormal derivatives `law`, and level absorb the rest.
        seen = np.linalg.qr(np.column_stack([np.ones(len(law)), law]))[0]
        apart = (self.temperatures[:, None] - self.temperatures) / np.ptp(self.temperatures)
        alike = [np.exp(-0.5 * (apart / length) ** 2) for length in MISFIT_LENGTHS]
        found = []
        for shape in (np.eye(len(law)), *alike, self.covariance):
            visible = np.trace(shape) - np.trace(seen.T @ shape @ seen)
            if visible > VISIBLE * np.trace(shape):  # else errors of a few constants, or none
                scale = (len(self) - law.shape[1]) / visible
                found.append(scale * shape + ROUGHNESS * np.eye(len(law)))
        return found

    def _likelihood(self, shape: Array, size: Array, law: Array, left: Array) -> Array:
        """Return ln of the restricted likelihood of sizes (s,) of a misfit of one shape."""
        # D. A. Harville, J. Am. Stat. Assoc. 72 (1977) 320.
        turned = FactorTable.of(self.temperatures, left, self.covariance, self.reference, shape)
        error = np.sqrt(turned.variance + size[:, None] ** 2)  # (s, m)
        columns, residual = (turned.turn @ law) / error[..., None], (turned.turn @ left) / error
        # Not by the normal equations, which are singular where one factor is known exactly.
        Q, R = np.linalg.qr(columns)
        chi2 = np.sum(residual**2, axis=1) - np.sum(np.einsum("smi,sm->si", Q, residual) ** 2, axis=1)
        log_det = np.sum(np.log(np.abs(np.diagonal(R, axis1=1, axis2=2))), axis=1) + np.sum(np.log(error), axis=1)
        return np.asarray(-0.5 * (chi2 + turned.log_volume) - log_det)


class Solution(NamedTuple):
    """Constants, their covariance, and χ²."""

    parameters: Array
    covariance: Array
    chi2: float


class Fitted(NamedTuple):
    """A law, its χ² by the measured covariance alone, and the scatter (decades) that makes its misfit plausible."""

    law: ParametricLaw
    chi2: float
    scatter: float
    misfit: Array  # (n, n), covariance of what the factors have beyond the law and their errors


def fitted(kind: str, table: FactorTable, degree: int | None = None) -> Fitted:
    """Fit a law by generalised least squares; see `ShiftFactors.law`."""
    if kind not in LAWS:
        raise wrong_argument(
            "law", kind, f"must be {', '.join(repr(one) for one in LAWS[:-1])} or {LAWS[-1]!r}.", "unknown-law"
        )
    if kind == "vft":  # the same curve, whose constants and covariance follow exactly
        wlf = fitted("wlf", table)
        return wlf._replace(law=wlf.law.to_vft())  # type: ignore[attr-defined]
    family = family_of(kind, table.temperatures, table.reference, degree)
    if len(table) < family.size:
        raise InputError(
            f"{len(table) + 1} temperatures are too few to fit {kind!r}; give {family.size + 1} or more.",
            code="too-few-temperatures",
        )
    (constants, _, _), chi2, scatter = solved(family, table, _not_described(table, kind))
    gradient = family.gradient(constants)
    gain = table.gain(constants, gradient, scatter)
    misfit = table.misfit(gradient, table.values - family.values(constants))
    variance, axes = np.linalg.eigh(table.covariance + misfit + SMALLEST_ERROR**2 * np.eye(len(misfit)))
    errors = gain @ (axes * np.sqrt(np.maximum(variance, 0.0)))  # (k, n), independent
    law = family.law(constants, errors @ errors.T)
    if isinstance(law, Arrhenius):  # errors of WLF include it, for it is WLF with a pole at absolute zero
        law = replace(law, rivals=wlf_beside(table))
    return Fitted(law, chi2, scatter, misfit)


def wlf_beside(table: FactorTable) -> Array:
    """Return the WLF laws that factors do not exclude beside an Arrhenius law, (m, 3); see `Arrhenius.rivals`."""
    # Both kinds of law are taken to be as likely as each other before the factors are seen. Weights follow from the
    # likelihood, averaged over the scatter as in `criterion_of`; B is that of greatest likelihood.
    poles = np.append(0.0, np.maximum(table.temperatures[0] - POLES_BELOW, 1.0))
    shapes, values = table.turn @ (1.0 / (table.temperatures[:, None] - poles)), table.turn @ table.values
    precision = 1.0 / (table.variance + SCATTERS[:, None] ** 2)  # (s, m)
    square, product = precision @ shapes**2, precision @ (shapes * values[:, None])
    logarithm = 0.5 * (product**2 / square + np.sum(np.log(precision) - precision * values**2, axis=1)[:, None])
    weight = DENSITY[:, None] * np.exp(logarithm - logarithm.max()) * (product > 0.0)
    likely = np.maximum(np.sum(weight, axis=0), np.finfo(float).tiny)
    B = np.sum(weight * product / square, axis=0) / likely
    likely[0] *= len(POLES_BELOW)
    return np.column_stack([likely / likely.sum(), B, poles])[1:]


def solved(family: Model, table: Table, otherwise: InputError) -> tuple[Solution, float, float]:
    """Return constants, χ² by the measured covariance alone, and scatter; `otherwise` if they are not determined."""
    try:
        with np.errstate(over="ignore"):  # a constant that runs away is refused below
            bare = least_squares(family, table, family.start(table.values), 0.0)
            found, scatter = with_misfit(family, table, bare)
    except np.linalg.LinAlgError:
        raise otherwise from None
    errors = np.diag(found.covariance)
    if not np.all(np.isfinite(found.covariance)) or not np.all(errors > 0.0):
        raise otherwise
    if family.positive and np.any(errors > (LARGEST_RELATIVE_ERROR * found.parameters) ** 2):
        raise otherwise
    return found, bare.chi2, scatter


def undetermined(law: object, constants: Array, covariance: Array | None) -> Iterator[Note]:
    """Yield a note if the standard error of a constant, which is above zero, exceeds it."""
    if covariance is not None and np.any(np.diag(covariance) > np.square(constants)):
        text = f"The data do not determine the constants of this law, {law}: it is known where they were measured, and "
        yield Note("constants-undetermined", text + "not beyond; a wider range would.")


def criterion(law: ParametricLaw, table: FactorTable) -> float:
    """Return Akaike's criterion of a law fitted to a table; see `criterion_of`."""
    degree = len(law.parameters) if law.kind == "polynomial" else None
    return criterion_of(family_of(law.kind, table.temperatures, table.reference, degree), table, law.parameters)


def criterion_of(family: Model, table: Table, parameters: Array) -> float:
    """Return Akaike's criterion, −2 ln L + 2k, of a fitted law, at constants of greatest likelihood."""
    # k is the number of constants, a glass transition between two laws counting for three. L is the Gaussian likelihood
    # of the n − 1 differences of neighbouring values, whose covariance is the measured one plus that of an independent
    # scatter s in every value. No law is exact, and few factors do not show how large s is: L is averaged over s, from
    # `SMALLEST_MISFIT` on, with the density 1/(1 + (s/m)²) of m = `USUAL_MISFIT`. So L stays finite where a law passes
    # through all factors.
    logarithms = np.array([_log_density(family, table, parameters, float(one) ** 2) for one in SCATTERS])
    most = float(logarithms.max())
    mean = float(np.sum(DENSITY * np.exp(logarithms - most)) / np.sum(DENSITY))
    return -2.0 * (most + float(np.log(mean))) + 2.0 * (family.size + family.surcharge)


def _log_density(family: Model, table: Table, start: Array, added: float) -> float:
    """Return the largest ln L over the constants, with a variance added to every value."""
    chi2 = least_squares(family, table, start, added).chi2
    log_det = table.whitening(added).log_det + len(table) * float(np.log(2.0 * np.pi))
    return -0.5 * (chi2 + log_det + table.log_volume)


def _not_described(table: FactorTable, kind: str) -> InputError:
    low, high = (shown_celsius(float(end)) for end in table.temperatures[[0, -1]])
    return InputError(
        f"the shift factors from {low} to {high} °C do not fix the constants of the {TITLES[kind]} law; "
        "take the measured ones, another law, or the factors of a narrower range of temperatures.",
        code="no-law",
    )


def with_misfit(family: Model, table: Table, bare: Solution) -> tuple[Solution, float]:
    """Fit with the least independent scatter per temperature (decades) that makes the misfit plausible."""
    # The scatter σ² solves χ²(σ²) = degrees of freedom (R. C. Paule, J. Mandel, J. Res. Natl. Bur. Stand. 87 (1982)
    # 377); it is zero where the uncertainties explain the misfit of the fit without it, and where no degree of freedom
    # is left to find it.
    freedom = len(table) - family.size
    if freedom == 0 or bare.chi2 <= freedom:
        return bare, 0.0
    return plausible(lambda last, added: least_squares(family, table, last.parameters, added), bare, freedom)


def plausible(fit: Callable[[Solution, float], Solution], bare: Solution, freedom: int) -> tuple[Solution, float]:
    """Return the fit whose scatter brings χ² to the degrees of freedom, and that scatter.

    `fit` takes the fit before it, and the square of the scatter.
    """
    found = bare
    low, high = 2 * np.log(SMALLEST_ERROR), 2 * np.log(LARGEST_SCATTER)
    for _ in range(40):
        middle = 0.5 * (low + high)
        found = fit(found, float(np.exp(middle)))
        low, high = (middle, high) if found.chi2 > freedom else (low, middle)
        if high - low < 1e-2:
            break
    return found, float(np.exp(0.25 * (low + high)))


def least_squares(family: Model, table: Table, start: Array, added: float) -> Solution:
    """Minimise the whitened misfit over the constants; a variance is added to every value."""
    whiten = table.whitening(added)
    if not family.positive:
        return linear(whiten(family.gradient(start)), whiten(table.values))
    return _positive(family, whiten, whiten(table.values), start)


def linear(matrix: Array, target: Array) -> Solution:
    """Minimise |matrix p − target|², columns brought to one size first."""
    size = np.linalg.norm(matrix, axis=0)
    left, upper = np.linalg.qr(matrix / size)
    inverse = np.linalg.inv(upper) / size[:, None]
    parameters = inverse @ (left.T @ target)
    misfit = target - matrix @ parameters
    return Solution(parameters, inverse @ inverse.T, float(misfit @ misfit))


def _positive(family: Model, whiten: Whitening, target: Array, start: Array) -> Solution:
    """Minimise in the logarithms of the constants, which keeps them positive."""

    def misfit(logarithm: Array) -> Array:
        try:
            return np.asarray(target - whiten(family.values(np.exp(logarithm))))
        except InputError:  # beyond the law's pole: the step is rejected
            return np.full(len(target), np.inf)

    def slopes(logarithm: Array, now: Array) -> Slopes:
        parameters = np.exp(logarithm)
        jacobian = whiten(family.gradient(parameters) * parameters)
        return jacobian.T @ now, jacobian.T @ jacobian

    def at(logarithm: Array) -> Squares:
        now = misfit(logarithm)
        return float(now @ now), lambda: slopes(logarithm, now)

    point = descend(at, np.log(start), iterations=ITERATIONS, tolerance=CONVERGED)
    parameters, now = np.exp(point), misfit(point)
    try:
        inverse = np.linalg.inv(slopes(point, now)[1])
    except np.linalg.LinAlgError:  # the data do not determine some combination of constants
        inverse = np.full((len(point), len(point)), np.inf)
    return Solution(parameters, inverse * np.outer(parameters, parameters), float(now @ now))
