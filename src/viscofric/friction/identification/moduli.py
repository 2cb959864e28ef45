"""Moduli as observations: an anchor, or a part of E(ω) that is known from a DMA."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self, TypeAlias

import numpy as np

from viscofric.arrays import Array, ComplexArray
from viscofric.data import MasterCurve
from viscofric.errors import InputError, wrong_argument
from viscofric.friction.identification.anchors import ModulusAnchor
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.quality import covers
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.units import Quantity
from viscofric.units import angular_frequency as frequency_of

Known: TypeAlias = Material | MaterialSamples | MasterCurve

#: Frequencies per decade at which a measured modulus is used: errors of closer ones are correlated.
PER_DECADE = 4
#: Least relative error of samples of a material: their covariance at many frequencies is nearly singular.
LEAST_ERROR = 3e-3
BOTH = ("storage", "loss")


def compliance(compliances: Array, tau: Array, log_frequency: Array) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return S(ω) (n,), its derivatives by ln(1/E_inf) and every ln C (n, 1 + m), and by ln ω (n,)."""
    values = np.exp(compliances)
    lag = 1j * np.exp(log_frequency[:, None]) * tau
    modes = values[1:] / (1.0 + lag)
    change = np.concatenate([np.full((len(lag), 1), values[0], dtype=complex), modes], axis=1)
    return change.sum(axis=1), change, -np.sum(modes * lag / (1.0 + lag), axis=1)


def log_modulus(part: str, S: ComplexArray, change: ComplexArray) -> tuple[Array, Array]:
    """Return ln of |E|, E' or E'' (n,), and its changes (n, p) with those of the compliance S."""
    relative = -change / S[:, None]  # of E = 1/S
    E = 1.0 / S
    if part == "magnitude":
        return np.log(np.abs(E)), relative.real
    moved = E[:, None] * relative
    if part == "storage":
        return np.log(E.real), moved.real / E.real[:, None]
    return np.log(E.imag), moved.imag / E.imag[:, None]


@dataclass(frozen=True, eq=False)
class ModulusObservation:
    """ln of moduli at k frequencies with their errors, which may be correlated."""

    log_frequency: Array  # (k,), ln ω at `temperature`, rad/s
    temperature: float  # K
    parts: tuple[str, ...]  # (p,), "magnitude", "storage" or "loss"
    log_modulus: Array  # (p k,), ln of Pa, part by part
    whitening: Array  # (p k, p k); its product with the errors has independent rows of standard deviation one

    @classmethod
    def single(cls, log_frequency: float, temperature: float, log_modulus: float, error: float, part: str) -> Self:
        """Return one modulus with a relative standard error."""
        known = np.array([log_frequency]), temperature, (part,), np.array([log_modulus]), np.array([[1.0 / error]])
        return cls(*known)

    @classmethod
    def of(cls, anchor: ModulusAnchor) -> Self:
        """Return the modulus of an anchor."""
        frequency, modulus = np.log(float(anchor.angular_frequency)), np.log(float(anchor.modulus))
        return cls.single(frequency, float(anchor.temperature), modulus, anchor.error, anchor.part)

    def away(self, compliances: Array, tau: Array, log_alpha: float) -> tuple[Array, Array, Array]:
        """Return (modelled minus observed)/error (p k,), and its derivatives by the compliances and by ln α."""
        S, change, slope = compliance(compliances, tau, self.log_frequency + log_alpha)
        both = np.column_stack([change, slope])
        modelled, moved = map(np.concatenate, zip(*(log_modulus(part, S, both) for part in self.parts), strict=True))
        moved = self.whitening @ moved
        return self.whitening @ (modelled - self.log_modulus), moved[:, :-1], moved[:, -1]


def known_part(
    prior: Known, band: tuple[Quantity, Quantity] | None, error: float, reference: float
) -> ModulusObservation:
    """Return E' and E'' of a prior over its measured frequencies."""
    # `band` are angular frequencies at the prior's own reference, rad/s, if not those that it was measured at; `error`
    # is the relative standard error of each modulus (samples of a material have their own); `reference` is the
    # temperature of a material without a shift, K.
    if isinstance(prior, MasterCurve):
        return _of_curve(prior, band, error)
    if isinstance(prior, Material):
        materials: tuple[Material, ...] = (prior,)
        fit = getattr(prior.at(), "fit", None)
        own, gaps = (None, ()) if fit is None else (fit.frequency_range, fit.gaps)
    elif isinstance(prior, MaterialSamples):
        materials = prior.materials
        own, gaps = prior.frequency_range, prior.gaps
    else:
        kind = type(prior).__name__
        raise InputError(f"prior must be a Material, MaterialSamples or a MasterCurve, not {kind}.", code="wrong-type")
    low, high = _checked(own if band is None else band)
    count = max(2, round(PER_DECADE * np.log10(high / low)) + 1)
    frequency = np.geomspace(low, high, count)
    if band is None:
        frequency = frequency[covers((low, high), frequency, gaps)]
        count = len(frequency)
    E = np.array([material.complex_modulus(frequency) for material in materials])
    rows = np.log(np.concatenate([E.real, E.imag], axis=1))
    if len(materials) > 1:
        covariance = np.cov(rows, rowvar=False) + LEAST_ERROR**2 * np.eye(2 * count)
        whitening = np.linalg.inv(np.linalg.cholesky(covariance))
    else:
        whitening = np.eye(2 * count) / error
    temperature = reference if materials[0].reference is None else materials[0].reference
    return ModulusObservation(np.log(frequency), temperature, BOTH, rows.mean(axis=0), whitening)


def _of_curve(curve: MasterCurve, band: tuple[Quantity, Quantity] | None, error: float) -> ModulusObservation:
    """Average ln E' and ln E'' over quarters of a decade."""
    low, high = _checked(
        (float(curve.angular_frequency[0]), float(curve.angular_frequency[-1])) if band is None else band
    )
    within = (curve.angular_frequency >= low) & (curve.angular_frequency <= high)
    if not within.any():
        raise InputError(
            f"prior_band = {low:.3g} to {high:.3g} rad/s: the master curve has no point there.", code="no-points"
        )
    E = curve.complex_modulus[within]
    columns = np.log(np.stack([curve.angular_frequency[within], E.real, E.imag]))
    part = np.floor(PER_DECADE * columns[0] / np.log(10.0))
    means = np.array([columns[:, part == one].mean(axis=1) for one in np.unique(part)])
    moduli = np.concatenate([means[:, 1], means[:, 2]])
    return ModulusObservation(means[:, 0], curve.reference, BOTH, moduli, np.eye(len(moduli)) / error)


def _checked(band: tuple[Quantity, Quantity] | None) -> tuple[float, float]:
    if band is None:
        raise InputError(
            "prior_band is missing: the measured frequencies of a material that was not fitted are unknown; give "
            "(lowest, highest) in rad/s at its reference temperature.",
            code="no-prior-band",
        )
    if np.shape(band) != (2,):
        raise wrong_argument("prior_band", band, "must be two frequencies, such as ('0.1 Hz', '10 Hz').", "wrong-count")
    low, high = (float(frequency_of(end, "prior_band")) for end in band)
    if low >= high:
        raise InputError(
            f"prior_band = {low:g} to {high:g} rad/s: must be two frequencies above zero that ascend.",
            code="not-positive",
        )
    return low, high
