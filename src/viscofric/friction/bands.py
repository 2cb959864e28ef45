"""Bands of predicted friction: what the uncertainty of spectrum and shift factors makes of it.

Friction is a functional of the compliance S(ω) that the rubber has at the temperature of the contact.  To first order,
the friction of a drawn material differs from that of the material that was solved by ::

    Δμ = Σ_j g(τ_j) C_j − Σ_k g(τ_k) C_k + g(0) Δ(1/E_inf),    g(τ) = ∂μ/∂C of a mode at τ

with the modes j of the drawn material and k of the solved one, both at that temperature: τ times α(T), C over b(T),
each its own.  So α(T) and the spectrum count together, and what is wrong with the one and made good by the other, as
where sweeps were measured, cancels before anything is linearised.  g comes from one adjoint solve for all τ (see
`viscofric.contact.derivatives`): modes without compliance are put where the material has none.  It is smooth, goes to
its value in the glass for vτ far below the contact's length and to zero far above it.

What is left out is of second order.  Drawn materials solved by themselves gave the same to 0.005 % of μ where the band
was ±1 % (1 % noise of the moduli), and to 0.05 % where errors of α moved μ by ±9 %.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from viscofric.contact.counterface import indenter_compliance
from viscofric.contact.free.scale import Scale
from viscofric.contact.steady import solve_steady
from viscofric.errors import InputError
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.material_samples import MaterialSamples

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.contact.solution import ContactSolution
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material

    Array: TypeAlias = NDArray[np.float64]

LEVEL = 0.95
#: Modes without compliance stand so far apart in ln τ: g is that smooth.
SPACING = 0.5
#: Nodes nearer to each other than this in ln τ would make an interpolation between them ripple.
LEAST_SPACING = 0.1
#: From and to where they stand, vτ over the length of the contact: beyond, g is at its limits to 1e-5.
REACH = 1e-6, 1e6
#: From here on the first order alone is told to be rough, relative to the friction.
LARGE_CHANGE = 0.3


@dataclass(frozen=True, eq=False)
class ComplianceSensitivity:
    """How the friction coefficient of one contact answers to the rubber's compliance.

    Attributes
    ----------
    friction : float
        μ of the material that was solved.
    compliance_part : float
        Σ g(τ_k) C_k + g(0)/E_inf of that material.
    log_tau : (m,) array
        ln τ, ascending, τ in s at the temperature of the contact.
    slope : (m,) array
        g(τ) = ∂μ/∂C of a mode there, Pa.
    glass : float
        g(0) = ∂μ/∂(1/E_inf), Pa.
    load : float
        F ∂μ/∂F.
    frequency : float
        Speed over half the contact's length, rad/s.
    """

    friction: float
    compliance_part: float
    log_tau: Array
    slope: Array
    glass: float
    load: float
    frequency: float

    def at(self, log_tau: Array) -> Array:
        """Return g at ln τ, in its shape, Pa."""
        from scipy.interpolate import CubicSpline

        first, last = self.log_tau[0], self.log_tau[-1]
        between = CubicSpline(self.log_tau, self.slope)(np.clip(log_tau, first, last))
        return np.where(log_tau < first, self.glass, np.where(log_tau > last, 0.0, between))


def solve_with_sensitivity(
    material: Material, indenter: Indenter, *, speed: float, load: float, temperature: float, **settings: Any
) -> tuple[ContactSolution, ComplianceSensitivity]:
    """Solve a contact, and find how its friction answers to compliance at any retardation time.

    Parameters
    ----------
    material : Material
        With a spectrum and a shift.
    indenter : Indenter
    speed, load, temperature : float
        m/s, N or N/m, K.
    **settings
        Of `solve_steady`.

    Raises
    ------
    InputError, ConvergenceError
        As of `solve_steady`.
    """
    here = material.modes_at(temperature)
    counterface = indenter_compliance(settings.get("indenter_modulus"), settings.get("indenter_poisson_ratio", 0.3))
    relaxed = (1.0 - material.poisson_ratio**2) / here.E0 + counterface
    length = Scale.for_load(indenter, 1.0 / relaxed, load).length
    alpha = 1.0 if material.shift is None else float(material.shift(temperature))
    everywhere = replace(material, spectrum=_with_empty_modes(material.modes_at(), length / (speed * alpha)))
    solution = solve_steady(
        everywhere, indenter, speed=speed, load=load, temperature=temperature, derivatives=True, **settings
    )
    modes, found = everywhere.modes_at(temperature), solution.derivatives
    assert found is not None
    glass = -found.E_inf * modes.E_inf**2
    log_tau = np.log(modes.tau)
    nodes = _apart(log_tau)
    return solution, ComplianceSensitivity(
        friction=solution.friction_coefficient,
        compliance_part=float(found.C @ modes.C) + glass / modes.E_inf,
        log_tau=log_tau[nodes],
        slope=found.C[nodes],
        glass=glass,
        load=found.logarithmic.load or 0.0,
        frequency=speed / (0.5 * (solution.front + solution.rear)),
    )


def _with_empty_modes(spectrum: RetardationSpectrum, time: float) -> RetardationSpectrum:
    """Add modes without compliance about a time (s), where the spectrum has none; in ascending order of τ."""
    lattice = np.arange(np.log(REACH[0]), np.log(REACH[1]), SPACING) + np.log(time)
    own = np.log(spectrum.tau)
    free = lattice[np.all(np.abs(lattice[:, None] - own) > 0.5 * SPACING, axis=1)] if own.size else lattice
    tau = np.concatenate([spectrum.tau, np.exp(free)])
    C = np.concatenate([spectrum.C, np.zeros(free.size)])
    order = np.argsort(tau, kind="stable")
    return RetardationSpectrum(spectrum.E0, spectrum.E_inf, C[order], tau[order], spectrum.fit)


def _apart(log_tau: Array) -> list[int]:
    """Rows of ascending values that keep their distance from those taken before."""
    rows = [0]
    for row, value in enumerate(log_tau):
        if value - log_tau[rows[-1]] >= LEAST_SPACING:
            rows.append(row)
    return rows


class DrawnMaterials:
    """Modes of drawn materials in one column, and their shifts at any temperature.

    Parameters
    ----------
    samples : MaterialSamples
    material : Material
        That is solved, to which the samples belong.

    Raises
    ------
    InputError
        If samples are not what they should be, or not those of such a material.
    """

    def __init__(self, samples: MaterialSamples, material: Material) -> None:
        if not isinstance(samples, MaterialSamples):
            raise InputError(
                f"samples = {samples!r}: must be a MaterialSamples, as sample_materials and identify_material give."
            )
        if not isinstance(material.spectrum, RetardationSpectrum):
            raise InputError(
                "material of a prediction with samples must have a spectrum, not a table of moduli: samples scatter "
                "about a spectrum, from fit_retardation_spectrum."
            )
        for one in samples.materials:
            if one.shift is None:
                raise InputError(
                    "samples: a material among them has no shift, so its friction at a temperature is open."
                )
            if abs(one.poisson_ratio - material.poisson_ratio) > 1e-9:
                raise InputError(
                    f"samples have Poisson's ratio {one.poisson_ratio:g}, the material {material.poisson_ratio:g}: "
                    "must be the same; give poisson_ratio to sample_materials."
                )
        self.misfit = samples.misfit
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
            alpha = [1.0 if one.shift is None else float(one.shift(temperature)) for one in self.materials]
            b = [
                1.0 if one.vertical_shift is None else float(one.vertical_shift(temperature)) for one in self.materials
            ]
            self._shifts[temperature] = np.array(alpha), np.array(b)
        return self._shifts[temperature]

    def friction(self, sensitivity: ComplianceSensitivity, temperature: float) -> Array:
        """Return μ of every material to first order, (samples,), in the contact whose sensitivity is given."""
        alpha, b = self.shifts(temperature)
        slope = sensitivity.at(self.log_tau + np.log(alpha)[self.row])
        modes = np.bincount(self.row, slope * self.C, minlength=len(b))
        part = (modes + sensitivity.glass * self.glass) / b
        return np.asarray(sensitivity.friction + part - sensitivity.compliance_part)

    def missed(self, sensitivity: ComplianceSensitivity, temperature: float) -> float:
        """Return what the systematic misfit of the spectrum makes of μ, relative; see `with_material_band`."""
        if self.misfit is None or sensitivity.friction == 0.0:
            return 0.0
        alpha = float(np.exp(np.mean(np.log(self.shifts(temperature)[0]))))
        storage, loss = np.log(10.0) * self.misfit.at(np.log10(np.array(sensitivity.frequency * alpha)))
        return float(np.hypot(loss, (1.0 + sensitivity.load / sensitivity.friction) * storage))


def with_material_band(
    curves: FrictionCurves, sensitivities: Sequence[ComplianceSensitivity], drawn: DrawnMaterials
) -> FrictionCurves:
    """Put the material's standard error and the limits of the 95 % band into predicted curves.

    Parameters
    ----------
    curves : FrictionCurves
    sensitivities : sequence of ComplianceSensitivity
        Of every point.
    drawn : DrawnMaterials

    Returns
    -------
    FrictionCurves

    Notes
    -----
    Limits are quantiles over the samples (Weibull's plotting position, as in `MaterialSamples`).  What the spectrum
    misses of the measured moduli beyond noise (`MaterialSamples.misfit`) is no draw; it counts as an independent error
    of ln μ, taken at the frequency of the contact, speed over half its length.  There an E' and an E'' that are off
    by factors alike at all frequencies change friction as tan δ and the load rule say where the loss is small:
    Δln μ = Δln E'' − (1 + ∂ln μ/∂ln F) Δln E', the two taken to be independent.
    """
    temperatures = [float(one) for one in curves.temperature]
    friction = np.array([drawn.friction(*pair) for pair in zip(sensitivities, temperatures, strict=True)])
    missed = np.array([drawn.missed(*pair) for pair in zip(sensitivities, temperatures, strict=True)])
    missed *= np.abs(curves.viscoelastic)
    outside = 0.5 * (1.0 - LEVEL)
    lower, middle, upper = np.quantile(friction, [outside, 0.5, 1.0 - outside], axis=1, method="weibull")
    apart = NormalDist().inv_cdf(1.0 - outside) * missed
    lower, upper = middle - np.hypot(middle - lower, apart), middle + np.hypot(upper - middle, apart)
    return replace(
        curves,
        material_error=np.hypot(np.std(friction, axis=1, ddof=1), missed),
        viscoelastic_lower=lower,
        viscoelastic_upper=upper,
        notes=(*curves.notes, *_doubts(curves.viscoelastic, lower, upper)),
    )


def _doubts(friction: Array, lower: Array, upper: Array) -> tuple[str, ...]:
    """Tell where the band is wide for a first order, and where it does not hold what it belongs to."""
    said = []
    change = np.maximum(upper - friction, friction - lower) / np.maximum(np.abs(friction), np.finfo(float).tiny)
    if np.any(change > LARGE_CHANGE):
        said.append(
            f"At {np.count_nonzero(change > LARGE_CHANGE)} of {friction.size} points the material's errors change "
            f"friction by more than {100 * LARGE_CHANGE:.0f} % (by {100 * change.max():.0f} % at most): the band, "
            "found to first order, is rough there."
        )
    rounding = 1e-9 * np.abs(friction)
    strayed = (friction < lower - rounding) | (friction > upper + rounding)
    if np.any(strayed):
        said.append(
            f"At {np.count_nonzero(strayed)} of {friction.size} points the predicted friction lies outside the 95 % "
            "band of the samples: they scatter about another material than the one that was solved."
        )
    return tuple(said)
