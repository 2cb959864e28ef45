"""Change of viscoelastic friction with speed near one of the speeds of a test, and its uncertainty."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array

#: Largest derivatives of ln μ_v by ln v, first to fourth.  Loss is a sum of x/(1 + x²) over retardation times; 4000
#: sums of up to four such terms, drawn at random, reached 1.0, 1.0, 1.54 and 3.3.  Rounded up, by half the last one:
#: a maximum of friction half a decade wide, sharper than any of those, has 0.9, 1.1, 2.1 and 5.4.
STEEPEST = (1.0, 1.2, 2.0, 5.0)
#: Standard error of an unknown derivative, over its largest value: more than the 1/√3 of a uniform distribution, since
#: sharp curves reach that value with one sign at many speeds.
_STANDARD = 0.7


@dataclass(frozen=True, eq=False)
class Growth:
    """A polynomial through ln μ_v at up to four speeds, the condition's own first.

    Its remainder is f⁽ᵏ⁾/k! ∏(L − X_j) of the k speeds X_j, with a derivative f⁽ᵏ⁾ no larger than `STEEPEST`; with the
    condition's own speed alone, the remainder is everything.

    Where a maximum of friction was half a decade wide and the disc's speeds differed by 20 or 50 %, 95 % intervals held
    92 % or more of viscoelastic and all of Coulomb friction, at 2, 3, 4 and 6 speeds; where they differed by 100 %, 96
    % and 99 % at 4 speeds, 73 % and 83 % at 6 with a quarter of the noise.  For a power of speed they are too wide,
    those of Coulomb friction three times at 20 % and seven times at 100 %.
    """

    places: Array  # (k,), ln of the speeds over the condition's; the first is zero
    values: Array  # (k,), ln μ_v there
    errors: Array  # (k,), their standard errors

    @classmethod
    def unknown(cls) -> Growth:
        """Return a constant, which uses no other speeds."""
        return cls(np.zeros(1), np.zeros(1), np.zeros(1))

    @classmethod
    def best(cls, places: Array, values: Array, errors: Array, log_speed: Array) -> Growth:
        """Use as many of the nearest speeds (k,) as give the smallest error at `log_speed` (n,)."""
        order = np.argsort(np.abs(places), kind="stable")[: len(STEEPEST)]
        several = [
            cls(places[order[:count]], values[order[:count]], errors[order[:count]])
            for count in range(1, order.size + 1)
        ]

        def uncertain(one: Growth) -> float:
            scatter, rest = one.deviations(log_speed)
            return float(np.sum(scatter**2) + np.sum(rest**2))

        return min(several, key=uncertain)

    @property
    def known(self) -> bool:
        """Whether other speeds are used."""
        return self.places.size > 1

    def log_change(self, log_speed: Array) -> Array:
        """Return ln μ_v at log speeds (n,) minus that at the condition's speed."""
        return self._weights(log_speed) @ self.values

    def deviations(self, log_speed: Array) -> tuple[Array, Array]:
        """Return the standard deviations of `log_change` due to each speed's friction (k, n), and to the rest (n,)."""
        scatter = self.errors[:, None] * self._weights(log_speed).T
        count = self.places.size
        product = np.prod(log_speed[:, None] - self.places, axis=1)
        return scatter, _STANDARD * STEEPEST[count - 1] / math.factorial(count) * product

    def _weights(self, log_speed: Array) -> Array:
        """Return Lagrange's polynomials (n, k) minus their values at the condition's speed."""
        weights = np.ones((log_speed.size, self.places.size))
        for one, other in np.ndindex(weights.shape[1], weights.shape[1]):
            if one != other:
                weights[:, one] *= (log_speed - self.places[other]) / (self.places[one] - self.places[other])
        weights[:, 0] -= 1.0
        return weights
