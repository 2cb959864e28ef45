"""Points in closed form: the stiffness of a small oscillation, and moduli known from other tests."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.friction.identification.indentation.contact import EXACT, Answer, Contact, Shared, Trial
from viscofric.friction.identification.moduli import compliance, log_modulus

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from viscofric.arrays import Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Known(Contact):
    """Moduli over angular frequencies, times the contact diameter over 1−ν² for a stiffness.

    A small oscillation about a depth δ keeps its contact radius a, so that the stiffness is 2a E(ω)/(1−ν²) (I. N.
    Sneddon, Int. J. Eng. Sci. 3 (1965) 47, with the correspondence principle).
    """

    diameter: float | None = None  # 2a; None for moduli, which have no indenter
    by_radius: float = 0.0  # d ln a/d ln R at a given depth
    by_depth: float = 0.0  # d ln a/dδ, 1/m
    shared: Shared = EXACT

    @classmethod
    def of(cls, frequency: Array, values: Mapping[str, tuple[Array, float]], **contact: Any) -> Known:
        """Return values over angular frequency (k,), rad/s, N/m or Pa, with their relative standard errors, by name.

        Names begin with "storage", "loss" or "magnitude".
        """
        size = len(frequency)
        along = np.tile(frequency, len(values))
        return cls(
            along=along,
            response=np.concatenate([column for column, _ in values.values()]),
            error=np.repeat([error for _, error in values.values()], size),
            count=np.ones(len(along)),
            lags=(1.0 / float(frequency.max()), 1.0 / float(frequency.min())),
            parts=tuple((name, slice(n * size, (n + 1) * size)) for n, name in enumerate(values)),
            **contact,
        )

    def ends(self, trial: Trial) -> tuple[float, float, float]:
        """Return the measured frequencies, rad/s."""
        low, high = float(self.along.min()), float(self.along.max())
        return low, high, high

    @property
    def log_elastic(self) -> float | None:
        """Ln of (1−ν²)/E of the storage modulus or the magnitude; None of moduli, whose Poisson's ratio is apart."""
        if self.diameter is None:
            return None
        rows = self.response[self.parts[0][1]]
        return float(np.median(np.log(self.diameter / rows)))

    def functional(self, tau: Array) -> Callable[[Trial], Answer]:
        """Return the response as a function of the material."""
        return self.answer

    def answer(self, trial: Trial) -> Answer:
        """Return the stiffness or the moduli of a material."""
        S, change, slope = compliance(trial.compliances, trial.tau, np.log(self.along) + trial.log_alpha)
        factor = 0.0
        if self.diameter is not None:
            S, factor = S + trial.extra, float(np.log(self.diameter / trial.plane_strain))
        value, moved = np.empty(len(self)), np.empty((len(self), change.shape[1] + 1))
        for name, rows in self.parts:
            part = name.partition("_")[0]
            value[rows], moved[rows] = log_modulus(part, S[rows], np.column_stack([change, slope])[rows])
        shared = np.zeros((len(self), 3))
        if self.diameter is not None:
            shared[:] = self.shared.radius * self.by_radius, -self.shared.gain, self.shared.zero * self.by_depth
        return Answer(value + factor, moved[:, :-1], moved[:, -1], shared)
