"""Bands of predicted friction due to the uncertainty of spectrum and shift factors.

Friction is a functional of the material's compliance S(ω) at the temperature of the contact.  To first order, the
friction of a sample of the material differs from that of the solved material by ::

    Δμ = Σ_j g(τ_j) C_j − Σ_k g(τ_k) C_k + g(0) Δ(1/E_inf),    g(τ) = ∂μ/∂C of a mode at τ

with the modes j of the sample and k of the solved material, both at that temperature: τ times α(T), C over b(T), each
its own.  So α(T) and the spectrum enter together, and errors of the one that the other compensates, as within the
measured frequencies, cancel before anything is linearised.  `ComplianceSensitivity` gives g.

Compliances k times as large are a load k times as large.  So the sample that is compared is the one whose compliance is
divided by k, which makes its storage compliance at the frequency of the contact that of the solved material, and the
sum is multiplied by k^n, with n = (Σ g(τ_k) C_k + g(0)/E_inf)/μ, which is ∂ln μ/∂ln F under a rigid indenter.

Up to three decades beyond the measured frequencies, where samples of twelve random rubbers had 0.1 to 1000 times the
friction of the estimate, each solved by itself had the same within a factor of 1.6, or of 6 where tan δ is large.

The neglected terms are of second order.  Solving each sample gave the same to 0.005 % of μ where the band was ±1 % (1 %
noise of the moduli), and to 0.05 % where errors of α alone moved μ by ±9 %.  Made-up spectra of 3 to 13 modes, each
moved by 3 % independently and all in time by 3 %, gave the same to 0.1 %; moved by 10 %, so that μ changed by up to
10 %, to 0.3 % as a rule and 1.3 % at most.

In 60 planted measurements of one material with 2 % noise the bands included its true friction at 97 % of 360 points,
and the estimated standard errors were 0 to 17 % above the scatter of the predictions
(``benchmarks/friction/bands.py``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from statistics import NormalDist

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.sensitivity import ComplianceSensitivity
from viscofric.notes import Note
from viscofric.rheology.material import Material, alpha_and_b
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.material_samples import MaterialSamples

LEVEL = 0.95
#: Width of the band, relative to friction, from which a note says that the first order is rough.
LARGE_CHANGE = 0.3


class DrawnMaterials:
    """Modes of samples of a material in one column, and their shifts at any temperature."""

    def __init__(self, samples: MaterialSamples, material: Material) -> None:
        right = "MaterialSamples, as sample_materials and identify_material give"
        insist_on(samples, "samples", MaterialSamples, right=right)
        if not isinstance(material.spectrum, RetardationSpectrum):
            raise InputError(
                "material of a prediction with samples must have a spectrum, not a table of moduli: samples scatter "
                "about a spectrum, from fit_retardation_spectrum.",
                code="no-modes",
            )
        for one in samples.materials:
            if one.shift is None:
                raise InputError(
                    "samples: a material among them has no shift, so its friction at a temperature is open.",
                    code="no-shift",
                )
            if abs(one.poisson_ratio - material.poisson_ratio) > 1e-9:
                raise InputError(
                    f"samples have Poisson's ratio {one.poisson_ratio:g}, the material {material.poisson_ratio:g}: "
                    "must be the same; give poisson_ratio to sample_materials.",
                    code="poisson-ratio",
                )
        self.misfit, self.material = samples.misfit, material
        self.materials = samples.materials
        spectra = [one.modes_at() for one in samples.materials]
        self.row = np.repeat(np.arange(len(spectra)), [len(one) for one in spectra])
        self.C = np.concatenate([one.C for one in spectra])
        self.log_tau = np.log(np.concatenate([one.tau for one in spectra]))
        self.glass = np.array([1.0 / one.E_inf for one in spectra])
        self._shifts: dict[float, tuple[Array, Array]] = {}

    def shifts(self, temperature: float) -> tuple[Array, Array]:
        """Return α and b of every material at a temperature (K), (samples,) each."""
        if temperature not in self._shifts:
            alpha, b = np.array([alpha_and_b(one, temperature) for one in self.materials]).T
            self._shifts[temperature] = alpha, b
        return self._shifts[temperature]

    def friction(self, sensitivity: ComplianceSensitivity, temperature: float) -> Array:
        """Return μ of every material to first order, (samples,), in the contact whose sensitivity is given."""
        alpha, b = self.shifts(temperature)
        log_tau = self.log_tau + np.log(alpha)[self.row]
        storage = 0.5 - 0.5 * np.tanh(np.log(sensitivity.frequency) + log_tau)  # of 1/(1 + iωτ)
        part, level = (
            (np.bincount(self.row, each * self.C, minlength=len(b)) + glass * self.glass) / b
            for each, glass in ((sensitivity.at(log_tau), sensitivity.glass), (storage, 1.0))
        )
        level /= (1.0 / complex(self.material.complex_modulus(sensitivity.frequency, temperature))).real
        power = sensitivity.compliance_part / sensitivity.friction if sensitivity.friction else 0.0
        changed = sensitivity.friction + part / level - sensitivity.compliance_part
        return np.asarray(level**power * np.maximum(changed, 0.0))  # first order may overshoot: losses are not negative

    def missed(self, sensitivity: ComplianceSensitivity, temperature: float) -> float:
        """Return the relative error of μ due to the systematic misfit of the spectrum; see `with_material_band`."""
        if self.misfit is None or sensitivity.friction == 0.0:
            return 0.0
        alpha = float(np.exp(np.mean(np.log(self.shifts(temperature)[0]))))
        storage, loss = np.log(10.0) * self.misfit.at(np.log10(np.array(sensitivity.frequency * alpha)))
        return float(np.hypot(loss, (1.0 + sensitivity.load / sensitivity.friction) * storage))


def with_material_band(
    curves: FrictionCurves, sensitivities: Sequence[ComplianceSensitivity], drawn: DrawnMaterials
) -> FrictionCurves:
    """Put the material's standard error and the limits of the 95 % band into predicted curves."""
    # Limits are quantiles over the samples (Weibull's plotting position, as in `MaterialSamples`). The misfit of the
    # spectrum to the measured moduli beyond noise (`MaterialSamples.misfit`) is not sampled; it counts as an
    # independent error of ln μ, taken at the frequency of the contact, speed over half its length. Relative errors of
    # E' and of E'' that are the same at all frequencies change friction as tan δ and the load rule do where the loss is
    # small: Δln μ = Δln E'' − (1 + ∂ln μ/∂ln F) Δln E', the two taken to be independent.
    temperatures = [float(one) for one in curves.temperature]
    friction = np.array([drawn.friction(*pair) for pair in zip(sensitivities, temperatures, strict=True)])
    missed = np.array([drawn.missed(*pair) for pair in zip(sensitivities, temperatures, strict=True)])
    missed *= np.abs(curves.viscoelastic)
    outside = 0.5 * (1.0 - LEVEL)
    lower, middle, upper = np.quantile(friction, [outside, 0.5, 1.0 - outside], axis=1, method="weibull")
    # Far beyond the sweeps a single sample may have all of the variance: no more than what 90 % limits would leave.
    spread = np.minimum(np.std(friction, axis=1, ddof=1), 0.5 * (upper - lower) / NormalDist().inv_cdf(0.95))
    apart = NormalDist().inv_cdf(1.0 - outside) * missed
    lower, upper = middle - np.hypot(middle - lower, apart), middle + np.hypot(upper - middle, apart)
    return replace(
        curves,
        material_error=np.hypot(spread, missed),
        viscoelastic_lower=lower,
        viscoelastic_upper=upper,
        notes=(*curves.notes, *_doubts(curves.viscoelastic, lower, upper)),
    )


def _doubts(friction: Array, lower: Array, upper: Array) -> Iterator[Note]:
    """Yield notes on points where the band is wide for a first order, or does not include the friction itself."""
    change = np.maximum(upper - friction, friction - lower) / np.maximum(np.abs(friction), np.finfo(float).tiny)
    if np.any(change > LARGE_CHANGE):
        yield Note(
            "large-change",
            f"At {np.count_nonzero(change > LARGE_CHANGE)} of {friction.size} points the material's errors change "
            f"friction by more than {100 * LARGE_CHANGE:.0f} % (by {100 * change.max():.0f} % at most): the band, "
            "found to first order, is rough there.",
        )
    rounding = 1e-9 * np.abs(friction)
    strayed = (friction < lower - rounding) | (friction > upper + rounding)
    if np.any(strayed):
        yield Note(
            "outside-band",
            f"At {np.count_nonzero(strayed)} of {friction.size} points the predicted friction lies outside the 95 % "
            "band of the samples: they scatter about another material than the one that was solved.",
        )
