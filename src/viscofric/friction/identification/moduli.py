"""Moduli as observations of an identification: an anchor, or a part of the rubber's modulus known beforehand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array, ComplexArray


def compliance(compliances: Array, tau: Array, log_frequency: Array) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return S(ω) (n,), its derivatives by ln(1/E_inf) and every ln C (n, 1 + m), and by ln ω (n,)."""
    values = np.exp(compliances)
    lag = 1j * np.exp(log_frequency[:, None]) * tau
    modes = values[1:] / (1.0 + lag)
    change = np.concatenate([np.full((len(lag), 1), values[0], dtype=complex), modes], axis=1)
    return change.sum(axis=1), change, -np.sum(modes * lag / (1.0 + lag), axis=1)


def log_modulus(part: str, S: ComplexArray, change: ComplexArray) -> tuple[Array, Array]:
    """Return ln of |E|, E' or E'' (n,), and how it follows changes (n, p) of the compliance S."""
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
    """ln of n moduli with their errors.

    Attributes
    ----------
    log_frequency : (n,) array
        ln ω at `temperature`, rad/s.
    temperature : float
        K.
    part : {"magnitude", "storage", "loss"}
    log_modulus : (n,) array
        Of Pa.
    """

    log_frequency: Array
    temperature: float
    part: str
    log_modulus: Array

    def away(self, compliances: Array, tau: Array, log_alpha: float) -> tuple[Array, Array, Array]:
        """Return modelled less observed (n,), and its derivatives by the compliances (n, 1 + m) and by ln α (n,)."""
        S, change, slope = compliance(compliances, tau, self.log_frequency + log_alpha)
        modelled, moved = log_modulus(self.part, S, np.column_stack([change, slope]))
        return modelled - self.log_modulus, moved[:, :-1], moved[:, -1]
