"""Sensitivity of one contact's friction to the compliance at every retardation time, from one adjoint solve.

With the derivatives ∂μ/∂C of modes without compliance, added where the material has no mode, g(τ) = ∂μ/∂C is known for
all τ.  It is smooth, approaches its glassy value for vτ far below the contact's length, in proportion to τ, and zero
far above it, as 1/τ.  Where all modes are that short or that long, friction itself is this small difference.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.bodies import indenter_compliance
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_and_differentiate
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Distance of modes without compliance in ln τ: g is that smooth.
SPACING = 0.5
#: Nodes nearer than this in ln τ would cause ripples in the interpolation.
LEAST_SPACING = 0.1
#: Range of their vτ over the length of the contact: beyond it, g follows its power laws to 1e-5.
REACH = 1e-6, 1e6
#: Of ln τ.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class ComplianceSensitivity:
    """Sensitivity of one contact's friction coefficient to the material's compliance."""

    friction: float  # μ of the material that was solved
    compliance_part: float  # Σ g(τ_k) C_k + g(0)/E_inf of that material
    log_tau: Array  # (m,), ln τ, ascending, τ in s at the temperature of the contact
    slope: Array  # (m,), g(τ) = ∂μ/∂C of a mode there, Pa
    glass: float  # g(0) = ∂μ/∂(1/E_inf), Pa
    load: float  # F ∂μ/∂F
    frequency: float  # speed over half the contact's length, rad/s

    def at(self, log_tau: Array) -> Array:
        """Return g at ln τ, in its shape, Pa."""
        from scipy.interpolate import CubicSpline

        inside = np.clip(log_tau, self.log_tau[0], self.log_tau[-1])
        beyond = np.exp(-np.abs(log_tau - inside))  # one inside
        limit = np.where(log_tau < inside, self.glass, 0.0)
        return limit + (CubicSpline(self.log_tau, self.slope)(inside) - limit) * beyond


def solve_with_sensitivity(
    material: Material, indenter: Indenter, *, speed: float, load: float, temperature: float | None, **settings: Any
) -> tuple[ContactSolution, ComplianceSensitivity]:
    """Solve a contact, SI, as `solve_steady` does, with the sensitivity of its friction to compliance at any τ."""
    here = material.modes_at(temperature)
    counterface = indenter_compliance(settings.get("indenter_modulus"), settings.get("indenter_poisson_ratio", 0.3))
    relaxed = (1.0 - material.poisson_ratio**2) / here.E0 + counterface
    length = Scale.for_load(indenter, 1.0 / relaxed, load).length
    alpha = 1.0 if temperature is None or material.shift is None else float(material.shift(temperature))
    time = length / (speed * alpha)
    everywhere = replace(material, spectrum=_with_empty_modes(material.modes_at(), time))
    solution = solve_and_differentiate(
        everywhere, indenter, speed=speed, load=load, temperature=temperature, **settings
    )
    modes, found = everywhere.modes_at(temperature), solution.derivatives
    assert found is not None
    glass = -found.E_inf * modes.E_inf**2
    log_tau = np.log(modes.tau)
    nodes = _nodes(everywhere.modes_at(), time)
    sensitivity = ComplianceSensitivity(
        friction=solution.friction_coefficient,
        compliance_part=0.0,
        log_tau=log_tau[nodes],
        slope=found.C[nodes],
        glass=glass,
        load=found.logarithmic.load or 0.0,
        frequency=speed / (0.5 * (solution.front + solution.rear)),
    )
    # Interpolated as for other materials, so that the material's own modes change nothing.
    part = float(sensitivity.at(log_tau) @ modes.C) + glass / modes.E_inf
    return solution, replace(sensitivity, compliance_part=part)


def log_times(spectrum: RetardationSpectrum, time: float) -> Array:
    """Return ln τ at which a contact's sensitivity is given; `time` is its unit of length (`Scale`) over speed, s."""
    everywhere = _with_empty_modes(spectrum, time)
    return np.log(everywhere.tau)[_nodes(everywhere, time)]


def _with_empty_modes(spectrum: RetardationSpectrum, time: float) -> RetardationSpectrum:
    """Add modes without compliance about a time (s), where the spectrum has none; in ascending order of τ."""
    lattice = np.arange(np.log(REACH[0]), np.log(REACH[1]), SPACING) + np.log(time)
    own = np.log(spectrum.tau)
    free = lattice[np.all(np.abs(lattice[:, None] - own) > 0.5 * SPACING, axis=1)] if own.size else lattice
    tau = np.concatenate([spectrum.tau, np.exp(free)])
    C = np.concatenate([spectrum.C, np.zeros(free.size)])
    order = np.argsort(tau, kind="stable")
    return RetardationSpectrum(spectrum.E0, spectrum.E_inf, C[order], tau[order], spectrum.fit)


def _nodes(spectrum: RetardationSpectrum, time: float) -> list[int]:
    """Return the modes within reach of a time (s) that are far enough from the preceding one, ascending."""
    rows: list[int] = []
    log_tau = np.log(spectrum.tau / time)
    for row in np.flatnonzero(np.abs(log_tau) <= np.log(REACH[1]) + ROUNDING).tolist():
        if not rows or log_tau[row] - log_tau[rows[-1]] >= LEAST_SPACING:
            rows.append(row)
    return rows
