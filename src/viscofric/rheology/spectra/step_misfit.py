"""What fits of spectra to creep and relaxation tests minimise: the errors of ln J(t), or of ln E(t).

J(t) = 1/E_inf + Σ C (1 − exp(−t/τ)) is linear in the strengths.  E(t) follows from the same strengths by
interconversion: its Laplace transform is 1/(s S(s)), with S(s) = 1/E_inf + Σ C/(1 + sτ), and is inverted along a
contour s = z/t around the negative real axis,

    E(t) = Re Σ_k c_k / S(z_k/t),    z(θ) = N (0.5017 θ cot(0.6407 θ) − 0.6122 + 0.2645 i θ),

with N nodes in conjugate pairs.  The error falls as 3.89^−N: 1e-8 of E(t) with 14 nodes (J. A. C. Weideman, SIAM J.
Numer. Anal. 44 (2006) 2342, doi:10.1137/050625837; A. Talbot, J. Inst. Math. Appl. 23 (1979) 97).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.rheology.spectra.modulus_misfit import STIFFEST, Misfit, ModulusMisfit
from viscofric.step_tests import StepMasterCurve

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.arrays import Array, ComplexArray
    from viscofric.data import MasterCurve


#: Step responses from a time t on determine E(ω) up to this part of 1/t.  Relaxations faster than t have ended in E(t),
#: but not in E''(ω) below 1/t, and towards the glass they are the strongest; in J(t) they are the weakest.
REACH = {"creep": 0.1, "relaxation": 0.01}
#: E(t) falls steeply from a glass that was not measured; retardation times down to so many times less describe that.
#: Without them planted E'' was missed three times as far near the shortest times.
FASTER = 10.0
#: Nodes of the contour, in conjugate pairs.
NODES = 14


class CreepMisfit(Misfit):
    """Differences of −ln J between modes and a creep compliance; `rates` (N,) ascend, `moduli` (N,) are 1/J in Pa."""

    glass_within = True

    def __init__(self, rates: Array, moduli: Array) -> None:
        self.rates = rates
        self.sizes = moduli
        self.target = np.log(moduli)
        self.least_glass = 1.0 / (STIFFEST * float(np.max(moduli)))

    def of(self, rates: Array, logarithms: Array) -> CreepMisfit:
        """Return the same for other rates and −ln J (N, 1)."""
        return CreepMisfit(rates, np.exp(logarithms[:, 0]))

    def relaxed(self, tau: Array) -> Array:
        """Return 1 − exp(−t/τ), (N, n)."""
        return np.asarray(-np.expm1(-1.0 / np.outer(self.rates, tau)))

    def moved(self, relaxed: NDArray[Any], C: Array, tau: Array) -> Array:
        """Return the change of the compliance of modes with ln τ, (N, n)."""
        ratio = 1.0 / np.outer(self.rates, tau)
        return np.asarray(-C * ratio * np.exp(-ratio))

    def residual(self, compliance: NDArray[Any]) -> Array:
        """Return −ln J measured less computed, (N,)."""
        if not np.all(compliance > 0.0):
            return np.full(len(self.target), np.inf)
        return np.asarray(self.target + np.log(compliance))

    def jacobian(self, compliance: NDArray[Any], change: NDArray[Any]) -> Array:
        """Return the change of −ln J, (N, k)."""
        return np.asarray(-change / compliance[:, None])

    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return rows whose products with the strengths should be 1: J/J_measured."""
        return self.columns(tau) * self.sizes[:, None], np.ones(len(self.rates))


class RelaxationMisfit(Misfit):
    """Differences of ln E(t) between modes and a relaxation modulus; `rates` (N,) ascend, `moduli` (N,) are in Pa."""

    glass_within = True

    def __init__(self, rates: Array, moduli: Array) -> None:
        self.rates = rates
        self.sizes = moduli
        self.target = np.log(moduli)
        self.least_glass = 1.0 / (STIFFEST * float(np.max(moduli)))
        self._nodes, self._weights = _contour()

    @property
    def ends(self) -> tuple[float, float]:
        """Logarithms of the retardation times, from `FASTER` times below those that creep would show."""
        fastest, slowest = super().ends
        return fastest - np.log(FASTER), slowest

    def of(self, rates: Array, logarithms: Array) -> RelaxationMisfit:
        """Return the same for other rates and ln E (N, 1)."""
        return RelaxationMisfit(rates, np.exp(logarithms[:, 0]))

    def relaxed(self, tau: Array) -> ComplexArray:
        """Return 1/(1 + sτ) at all nodes s of all times, (N NODES/2, n)."""
        return np.asarray(1.0 / (1.0 + np.outer(np.outer(self.rates, self._nodes).ravel(), tau)))

    def moved(self, relaxed: NDArray[Any], C: Array, tau: Array) -> NDArray[Any]:
        """Return the change of the compliance of modes with ln τ, (N NODES/2, n)."""
        return np.asarray(relaxed * C * (relaxed - 1.0))

    def residual(self, compliance: NDArray[Any]) -> Array:
        """Return ln E measured less computed, (N,)."""
        modulus = self._modulus(compliance)
        if not np.all(modulus > 0.0):
            return np.full(len(self.target), np.inf)
        return np.asarray(self.target - np.log(modulus))

    def jacobian(self, compliance: NDArray[Any], change: NDArray[Any]) -> Array:
        """Return the change of ln E, (N, k)."""
        moved = (np.tile(self._weights, len(self.rates)) / compliance**2)[:, None] * change
        summed = moved.real.reshape(len(self.rates), len(self._nodes), -1).sum(axis=1)
        return np.asarray(-summed / self._modulus(compliance)[:, None])

    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return rows whose products with the strengths should be 1, were E(t) J(t) = 1, which is near for a start."""
        return CreepMisfit(self.rates, self.sizes).relative(tau)

    def _modulus(self, compliance: NDArray[Any]) -> Array:
        return np.asarray((self._weights / compliance.reshape(len(self.rates), -1)).real.sum(axis=1))


def _contour() -> tuple[ComplexArray, ComplexArray]:
    """Return the nodes z above the real axis, and the weights c."""
    theta = np.pi * (np.arange(NODES // 2) + 0.5) * 2.0 / NODES
    bent = 0.6407 * theta
    z = NODES * (0.5017 * theta / np.tan(bent) - 0.6122 + 0.2645j * theta)
    slope = NODES * (0.5017 / np.tan(bent) - 0.5017 * bent / np.sin(bent) ** 2 + 0.2645j)
    return z, 2.0 / (1j * NODES) * np.exp(z) * slope / z


def misfit_of(curve: MasterCurve | StepMasterCurve) -> Misfit:
    """Return what a fit to a master curve minimises."""
    if not isinstance(curve, StepMasterCurve):
        return ModulusMisfit(curve.angular_frequency, curve.complex_modulus)
    kind = CreepMisfit if curve.kind == "creep" else RelaxationMisfit
    return kind(rates_of(curve), moduli_of(curve))


def rates_of(curve: MasterCurve | StepMasterCurve) -> Array:
    """Return the angular frequencies, or 1/t, ascending, 1/s."""
    return 1.0 / curve.time[::-1] if isinstance(curve, StepMasterCurve) else curve.angular_frequency


def frequencies_of(curve: MasterCurve | StepMasterCurve) -> tuple[float, float]:
    """Return the lowest and the highest angular frequency that a curve determines, rad/s."""
    rates = rates_of(curve)
    reach = REACH[curve.kind] if isinstance(curve, StepMasterCurve) else 1.0
    return float(rates[0]), max(float(reach * rates[-1]), float(rates[0]))


def moduli_of(curve: MasterCurve | StepMasterCurve) -> Array:
    """Return E', or 1/J(t) or E(t), in the order of the rates; Pa."""
    return curve.modulus[::-1] if isinstance(curve, StepMasterCurve) else curve.storage_modulus


def by_rate(curve: MasterCurve | StepMasterCurve) -> Array:
    """Return the temperature of each point, K, in the order of the rates."""
    return curve.temperature[::-1] if isinstance(curve, StepMasterCurve) else curve.temperature
