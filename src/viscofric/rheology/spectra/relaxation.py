"""The relaxation spectrum: a Prony series (generalised Maxwell model), as finite-element programs hold it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import numbers
from viscofric.errors import InputError
from viscofric.rheology.spectra.interconversion import reciprocal_modes
from viscofric.rheology.spectra.response import (
    FrequencyResponse,
    checked_shift,
    checked_times,
    mode_column,
    shown_modulus,
)
from viscofric.units import to_si

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.units import Quantity

    Array = NDArray[np.float64]
    Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class RelaxationSpectrum(FrequencyResponse):
    """Relaxation modes of a rubber, or of a liquid, at one temperature.

    Relaxation modulus and complex modulus of the generalised Maxwell model are (convention e^{+iωt})::

        E(t) = E0 + Σ E_k exp(−t/τ_k)
        E(ω) = E0 + Σ E_k iωτ_k / (1 + iωτ_k),    E_inf = E0 + Σ E_k

    Parameters
    ----------
    E0 : float or quantity
        Rubber modulus E(t → ∞), Pa; zero for a liquid, which has no creep compliance here and cannot become a
        `RetardationSpectrum` or a `Material`.
    E : (n,) array
        Modulus of each mode, not below zero, Pa.
    tau : (n,) array
        **Relaxation** times, above zero, s.

    Raises
    ------
    InputError
        If a value is out of range, the arrays differ in length, or all moduli are zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> prony = vf.RelaxationSpectrum(E0="1 MPa", E=[9e6], tau=[1e-4])
    >>> creep = prony.to_retardation()
    >>> f"{creep.tau[0]:.4g} s"  # the retardation time is longer by E_inf/E0
    '0.001 s'
    """

    E0: float
    E: Array
    tau: Array

    def __init__(self, E0: Quantity, E: ArrayLike, tau: ArrayLike) -> None:
        rubber = to_si(E0, "Pa", "E0")
        if rubber < 0.0:
            raise InputError(f"E0 = {E0!r}: must not be below zero; right would be, for instance, '3 MPa'.")
        object.__setattr__(self, "E0", rubber)
        object.__setattr__(self, "E", mode_column(E, "E", "Pa"))
        object.__setattr__(self, "tau", mode_column(tau, "tau", "s"))
        if self.E.shape != self.tau.shape:
            raise InputError(f"E and tau must be as many: there are {len(self.E)} and {len(self.tau)}.")
        if np.any(self.E < 0.0) or np.any(self.tau <= 0.0):
            raise InputError("E must not be below zero and tau must be above zero in every mode.")
        if not self.E_inf > 0.0:
            raise InputError("E0 and all E are zero: there is no modulus at all.")

    def __len__(self) -> int:
        return len(self.E)

    def __repr__(self) -> str:
        ends = f"E0 = {shown_modulus(self.E0)}, E_inf = {shown_modulus(self.E_inf)}"
        return f"RelaxationSpectrum({ends}, {len(self)} modes)"

    @property
    def E_inf(self) -> float:
        """Glass modulus E0 + ΣE, Pa."""
        return self.E0 + float(np.sum(self.E))

    def complex_modulus(self, angular_frequency: ArrayLike) -> Complex:
        """Return E(ω) = E' + iE'', Pa, in the shape of `angular_frequency` (rad/s, any sign)."""
        omega = numbers(angular_frequency, "angular_frequency")
        total = np.full(omega.shape, self.E0, dtype=complex)
        for modulus, time in zip(self.E, self.tau, strict=True):
            total += modulus * (1j * omega * time) / (1.0 + 1j * omega * time)
        return total

    def compliance(self, angular_frequency: ArrayLike) -> Complex:
        """Return S(ω) = 1/E(ω), 1/Pa, in the shape of `angular_frequency` (rad/s, any sign).

        Raises
        ------
        InputError
            If a liquid is asked for its compliance at rest, which has no bound.
        """
        modulus = self.complex_modulus(angular_frequency)
        if np.any(modulus == 0.0):
            raise InputError("compliance at frequency 0: E0 = 0, a liquid flows without bound at rest.")
        return np.asarray(1.0 / modulus)

    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """Return E(t) after a step of strain, Pa, in the shape of `time` (s, not below zero)."""
        seconds = checked_times(time, "relaxation modulus")
        total = np.full(seconds.shape, self.E0)
        for modulus, relaxation in zip(self.E, self.tau, strict=True):
            total += modulus * np.exp(-seconds / relaxation)
        return total

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return J(t) after a step of stress, 1/Pa, in the shape of `time` (s); not for a liquid."""
        return self.to_retardation().creep_compliance(time)

    def to_retardation(self) -> RetardationSpectrum:
        """Return the same material as retardation modes, exactly; see `viscofric.rheology.spectra.interconversion`.

        Modes without modulus are left out and those of one time joined.

        Raises
        ------
        InputError
            If E0 is zero: the creep of a liquid has no end.
        """
        from viscofric.rheology.spectra.retardation import RetardationSpectrum

        if self.E0 == 0.0:
            raise InputError(
                "E0 = 0: a liquid has no rubber plateau and creeps without end, so that it has no retardation spectrum "
                "that a contact could use; give E0 above zero."
            )
        C, tau = reciprocal_modes(self.E0, self.E, self.tau)
        return RetardationSpectrum(self.E0, self.E_inf, C, tau)

    def shifted(self, alpha: float, b: float = 1.0) -> RelaxationSpectrum:
        """Return the spectrum at a temperature with shift factor α (and vertical shift b).

        From E(ω, T) = b E(αω, T0): every τ becomes ατ, every modulus b times what it was.
        """
        alpha, b = checked_shift(alpha, b)
        return RelaxationSpectrum(b * self.E0, b * self.E, alpha * self.tau)
