"""Materials of an identification: the best one, samples and their bands, and the best one for each level of modulus."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Generic

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import ConvergenceError, InputError
from viscofric.friction.identification.anchors import ModulusObservation
from viscofric.friction.identification.iteration import AnyProblem, Weighed, freedom_of, most_evident
from viscofric.friction.identification.posterior import descend, draws
from viscofric.friction.identification.problem import Problem
from viscofric.friction.identification.result import IdentifiedBand, LevelFit, log_magnitudes
from viscofric.friction.identification.solving import Contacts, spectrum_of
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import OneTemperature, ShiftLaw
from viscofric.rheology.uncertainty.material_samples import MaterialSamples

#: Smallest part of the evidence for a roughness to be included.
LEAST_SHARE = 0.05
#: Frequencies per decade at which bands are evaluated.
BAND_STEPS = 20


def drawn_from(fits: Sequence[Weighed[AnyProblem]], samples: int, random: np.random.Generator) -> tuple[Array, Array]:
    """Draw unknowns (samples, p) from fits, each by its part of the evidence; return their covariance (p, p) too."""
    # The covariance is that of the normal densities about every fit, weighted by their evidence.
    evidence = np.array([fit.log_evidence for fit in fits])
    shares = np.exp(evidence - evidence.max())
    shares /= shares.sum()
    shares = np.where(shares < LEAST_SHARE, 0.0, shares)
    shares /= shares.sum()
    counts = np.diff(np.round(samples * np.concatenate([[0.0], np.cumsum(shares)]))).astype(int)
    drawn = [
        draws(fit.problem, fit.minimum, int(count), random, fit.problem.metric)
        for fit, count in zip(fits, counts, strict=True)
        if count
    ]
    best = most_evident(list(fits))
    covariance = np.zeros_like(best.minimum.normal)
    for fit, share in zip(fits, shares, strict=True):
        if share > 0.0:
            away = fit.minimum.place - best.minimum.place
            covariance += share * (np.linalg.inv(fit.minimum.normal) + np.outer(away, away))
    return np.concatenate(drawn), covariance


def limits(drawn: Array) -> Array:
    """Return limits that include a further sample with 95 % probability: Weibull's plotting position."""
    return np.asarray(np.quantile(drawn, [0.025, 0.975], axis=0, method="weibull"))


class Findings(Generic[AnyProblem]):
    """What every identification concludes from its fits over measured angular frequencies `frequency_range`, rad/s."""

    def __init__(
        self,
        fits: Sequence[Weighed[AnyProblem]],
        frequency_range: tuple[float, float],
        *,
        shift: ShiftLaw | None,
        poisson_ratio: float,
        name: str,
        samples: int,
        seed: int,
    ) -> None:
        random = np.random.default_rng(seed)
        #: Of the roughness with most evidence; unknowns (samples, p) drawn from all, and their covariance (p, p).
        self.best = most_evident(list(fits))
        self.rows, self.covariance = drawn_from(fits, samples, random)
        self.poisson_ratio, self.name, self.frequency_range = poisson_ratio, name, frequency_range
        self.middle = float(np.sqrt(frequency_range[0] * frequency_range[1]))
        shifts = self.best.problem.shifts
        #: Known exactly; None where the factors are among the unknowns, or there is one temperature only.
        self.shift = shift.at_reference(shifts.reference) if shift is not None and shifts.exact else None
        self.drawn = _samples([self.material(row) for row in self.rows], frequency_range)
        self.expected = _samples(self._prior_materials(samples, random), (0.0, np.inf))

    def material(self, unknowns: Array, covariance: Array | None = None) -> Material:
        """Return the material of unknowns (p,); the shift factors carry a covariance (p, p) of the unknowns."""
        problem, shift = self.best.problem, self.shift
        compliances, log_alpha = problem.split(unknowns)
        if shift is None and len(log_alpha) > 1:
            rows = slice(problem.modes, problem.modes + len(log_alpha))
            spread = np.zeros((len(log_alpha),) * 2) if covariance is None else covariance[rows, rows]
            shift = problem.shifts.table(log_alpha, spread)
        elif shift is None:
            shift = OneTemperature(problem.shifts.reference)
        return Material(spectrum_of(compliances, problem.smoothness.tau), shift, self.poisson_ratio, self.name)

    def _prior_materials(self, samples: int, random: np.random.Generator) -> list[Material]:
        """Draw materials from the prior of the spectrum, about the result: another level only moves the frequencies."""
        problem = self.best.problem
        smoothness = problem.smoothness
        drawn = np.linalg.solve(smoothness.matrix, random.standard_normal((len(smoothness.middle), samples)))
        compliances = self.best.minimum.place[: problem.modes] + drawn.T
        return [Material(spectrum_of(row, smoothness.tau), None, self.poisson_ratio) for row in compliances]

    def band(self, part: str, reach: tuple[float, float], limit: float, *, relative: bool) -> IdentifiedBand:
        """Return the frequencies about the middle over which a modulus has a relative standard error below `limit`."""
        # Before anything was measured, it must scatter at least three times as much. `reach` are the lowest and highest
        # frequency considered, rad/s; `relative` means the modulus over |E| at the middle.
        middle = self.middle
        steps = BAND_STEPS * np.log10([middle / reach[0], reach[1] / middle])
        places = np.arange(-np.floor(steps[0]), np.floor(steps[1]) + 1.0)
        omega = middle * 10.0 ** (places / BAND_STEPS)
        about = middle if relative else None
        after, before = (_spread(one, omega, part, about) for one in (self.drawn, self.expected))
        known = (after <= limit) & (3.0 * after <= before)
        centre = int(np.argmin(np.abs(places)))
        if relative and part == "magnitude":
            known[centre] = True  # one by definition
        if not known[centre]:
            return IdentifiedBand(middle, middle, limit, relative)
        low = high = centre
        while low > 0 and known[low - 1]:
            low -= 1
        while high < len(known) - 1 and known[high + 1]:
            high += 1
        return IdentifiedBand(float(omega[low]), float(omega[high]), limit, relative)

    def common(self, bands: Sequence[IdentifiedBand], residuals: Array, error_scale: float) -> dict[str, Any]:
        """Return what the results of all identifications have in common, by its name in `Identified`."""
        material, problem = self.material(self.best.minimum.place, self.covariance), self.best.problem
        names = ("identified", "identified_storage", "identified_loss")
        return {
            **dict(zip(names, bands, strict=True)),
            "chi2": float(residuals @ residuals),
            "freedom": freedom_of(self.best, len(residuals)),
            "rms": float(np.sqrt(np.mean((residuals * problem.point_errors) ** 2))),
            "error_scale": error_scale,
            "material": material,
            "samples": self.drawn,
            "shift_factors": material.shift if material.has_shift_factors else None,
            "shift_found": problem.shifts.found and material.has_shift_factors,
            "middle": self.middle,
            "frequency_range": self.frequency_range,
            "roughness": problem.smoothness.roughness,
        }


def _samples(materials: Sequence[Material], frequency_range: tuple[float, float]) -> MaterialSamples:
    spectra = [material.modes_at() for material in materials]
    C, tau = np.array([one.C for one in spectra]), np.array([one.tau for one in spectra])
    return MaterialSamples(tuple(materials), C, tau, frequency_range)


def _spread(samples: MaterialSamples, omega: Array, part: str, about: float | None) -> Array:
    """Return the standard deviation of the logarithm of a modulus, (n,); of that over |E| at a frequency `about`."""
    E = np.array([material.complex_modulus(omega) for material in samples.materials])
    rows = np.log({"magnitude": np.abs(E), "storage": E.real, "loss": E.imag}[part])
    if about is not None:
        rows = rows - log_magnitudes(samples, about)[:, None]
    return np.asarray(rows.std(axis=0, ddof=1))


#: Relative error of a fixed level.
HELD = 1e-3


def level_family(
    findings: Findings[Problem], contacts: Contacts, factors: Sequence[float], step: int, accuracy: float
) -> tuple[LevelFit, ...]:
    """Fit the friction with |E| held at levels; contacts are solved once for each but the first."""
    # `factors`, ascending, are the levels of |E| at the middle frequency over that of the identified material; `step`
    # numbers the first step of solving contacts. Levels at which the contacts are not solved are left out.
    best, middle = findings.best, findings.middle
    log_modulus = float(np.log(np.abs(findings.material(best.minimum.place).complex_modulus(middle))))
    found: dict[float, LevelFit] = {}
    for way in (sorted(f for f in factors if f >= 1.0), sorted((f for f in factors if f < 1.0), reverse=True)):
        place, last = best.minimum.place, 1.0
        for factor in way:
            start = place.copy()
            start[: best.problem.modes] -= np.log(factor / last)
            reference, moduli = best.problem.shifts.reference, best.problem.moduli
            level = ModulusObservation.single(
                np.log(middle), reference, log_modulus + np.log(factor), HELD, "magnitude"
            )
            held = replace(best.problem, moduli=(*moduli, level))
            try:
                problem, place = held, descend(held, start, metric=held.metric).place
                if factor != 1.0:
                    problem = contacts.solved(held, place, step + len(found), accuracy)
                    place = descend(problem, place, metric=problem.metric).place
            except (ConvergenceError, InputError):
                break
            last = factor
            points = problem.points
            away, _ = problem.missed(place)
            everything, _ = replace(problem, moduli=best.problem.moduli)(place)
            found[factor] = LevelFit(
                factor=float(factor),
                modulus=float(np.exp(log_modulus) * factor),
                material=findings.material(place),
                chi2=float(np.sum((away / points.error) ** 2)),
                rms=float(np.sqrt(np.mean(away**2))),
                penalty=float(everything @ everything),
            )
    least = min((one.penalty for one in found.values()), default=0.0)
    return tuple(replace(found[factor], penalty=found[factor].penalty - least) for factor in sorted(found))
