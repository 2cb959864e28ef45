"""Flash temperatures in Persson's theory: how warm the rubber is where waves of each length deform it.

What is dissipated at the scale q' heats the rubber to a depth of 1/(2q'), in the macroasperity contacts, where it sums
to ``Q(z) = ρc ∫ dq' f(q') exp(−2q'z)``.  A spot of diameter R has been in contact for about t0 = R/v.  With its surface
insulated and heat flowing along z only, the temperature that waves of the scale q meet, the mean over their depth with
the weight 2q exp(−2qz), is [1]_ ::

    T_q = T0 + ∫ dq' g(q, q') f(q')
    f(q') = v q'⁴/(ρc) C(q') S(q') P(q')/P(q_m) ∫dφ cos φ Im E(q'v cos φ, T_q')/(1−ν²)
    g(q, q') = 1/π ∫_0^∞ dk (1 − exp(−D k² t0))/(D k²) · 4q'/(k² + 4q'²) · 4q²/(k² + 4q²)

D the diffusivity; S, 1 in [1]_, makes the heat that of the friction.  q_m is the scale of the macroasperities, at which
P has fallen to a given share, and R = π/q_m half their wavelength.

Coulomb friction adds heat on the surface of these contacts, μ_c σ0 u/P(q_m) per area with the sliding velocity u, or
τ_s u P(q_1)/P(q_m) of an interface, with its shear stress τ_s on the real contact area at the temperature of this
surface.  The rubber takes the share that makes both faces of a disc of diameter R equally warm on average
(`viscofric.heat.means`).  A flux j gives T_q the term j/ρc 2/π ∫_0^∞ dk (1 − exp(−D k² t0))/(D k²) · 4q²/(k² + 4q²).

References
----------
.. [1] B. N. J. Persson, "Rubber friction: role of the flash temperature", J. Phys.: Condens. Matter 18 (2006) 7789,
   doi:10.1088/0953-8984/18/32/025, arXiv:cond-mat/0605273
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import ConvergenceError
from viscofric.heat.heating import Heating
from viscofric.heat.interface import SlidingInterface
from viscofric.heat.means import disc_mean
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.thermal import ThermalProperties

_MOST_ITERATIONS = 500
#: Part of the way to the rise produced by which a hot start comes down, and what the way is then over the rise.
_DOWN, _NEAR = 0.15, 0.2
#: Shortest and longest step of the relaxation, in changes.
_STEPS = 0.02, 4.0
#: Temperatures are settled when they change by less than this, K, plus the same share of the largest rise.
_SETTLED = 1e-5
_PER_DECADE = 12  # wave numbers k of the temperature field


@dataclass(frozen=True)
class Flash:
    """Parameters of hot spots."""

    thermal: ThermalProperties  # of the rubber
    macroasperity_area: float  # P(q_m)
    heating: Heating | None = None  # with Coulomb heat
    pressure: float = 0.0  # nominal, Pa
    interface: InterfaceLaw | None = None  # whose heat takes the place of a constant Coulomb friction
    start: float = 0.0  # rise at all scales from which the settled one is looked for, K

    def settled(
        self, q: Array, log_weights: Array, at: tuple[float, float], heated: Callable[[Array], tuple[Array, Array]]
    ) -> tuple[Array, Array, Array, Array, float]:
        """Return P(q), dissipation, the rise, its part by Coulomb friction and that of the surface, K, that agree."""
        # `q` (n,) in rad/m; `log_weights` (n,) are those of a quadrature over ln q; `at` are the speed, m/s, and the
        # temperature, K; `heated` returns P(q) and q³ C S ∫dφ cos φ Im E/(1−ν²), Pa m, at a rise of temperature.
        rise = np.full(len(q), self.start)
        step, before, descending = 1.0, np.zeros(len(q)), self.start > 0.0
        for _ in range(_MOST_ITERATIONS):
            area, dissipated = heated(rise)
            by_loss, by_coulomb = self.rises(q, log_weights, at, area, dissipated)
            change = (by_loss + by_coulomb)[:-1] - rise
            largest = float(np.abs(change).max())
            if largest <= _SETTLED * (1.0 + float(rise.max())):
                return area, dissipated, rise, by_coulomb[:-1], float(by_loss[-1] + by_coulomb[-1])
            # From a hot start down in small steps, so as not to pass a hot state, until one may be near.
            descending = descending and largest > _NEAR * float(rise.max())
            difference = change - before
            if descending:
                step = _DOWN
            elif before.any():  # Aitken's relaxation: warmer rubber dissipates less, or more
                step = float(np.clip(-step * (before @ difference) / (difference @ difference), *_STEPS))
            before = change
            rise = np.maximum(rise + step * change, 0.0)
        raise ConvergenceError(
            f"the flash temperature at {at[0]:g} m/s did not settle after {_MOST_ITERATIONS} iterations; it still "
            f"changes by {largest:.2g} K.",
            code="not-converged",
        )

    def rises(
        self, q: Array, log_weights: Array, at: tuple[float, float], area: Array, dissipated: Array
    ) -> tuple[Array, Array]:
        """Return the rise at each scale and then of the surface (n + 1,), K, by the loss and by Coulomb friction."""
        speed, kelvin = at
        # ln P against ln q falls steadily; beyond the last scale there is no wave.
        below = np.flatnonzero(area <= self.macroasperity_area)
        place = int(below[0]) if below.size else len(q) - 1
        if below.size and place > 0:
            part = (area[place - 1] - self.macroasperity_area) / (area[place - 1] - area[place])
            q_m, area_m = float(q[place - 1] * (q[place] / q[place - 1]) ** part), self.macroasperity_area
        else:
            q_m, area_m = float(q[place]), float(area[place])
        time = math.pi / q_m / speed
        source = speed / self.thermal.volume_heat * q * dissipated * area / area_m
        diffusivity = self.thermal.diffusivity
        lowest = 1e-3 * min(2.0 * float(q[0]), 1.0 / math.sqrt(diffusivity * time))
        highest = 1e3 * 2.0 * float(q[-1])
        count = math.ceil(_PER_DECADE * math.log10(highest / lowest))
        k = np.geomspace(lowest, highest, count)
        spacing = math.log(highest / lowest) / (count - 1)
        lasting = -np.expm1(-diffusivity * k**2 * time) / (diffusivity * k**2) / math.pi
        # Trapezoids in ln k, which converge fast for what falls smoothly at both ends; below the lowest k all is even.
        weights = spacing * k * lasting
        weights[0] = 0.5 * weights[0] + lowest * lasting[0]
        k_square = np.square(k)
        given = (4.0 * q[:, None] / (k_square + 4.0 * np.square(q)[:, None])).T @ (log_weights * q * source)
        met = 4.0 * np.square(q)[:, None] / (k_square + 4.0 * np.square(q)[:, None])
        left = weights * given
        by_loss = np.append(met @ left, left.sum())
        if self.heating is None:
            return by_loss, np.zeros_like(by_loss)
        taken = self._taken(speed, 0.5 * math.pi / q_m) / (area_m * self.thermal.volume_heat)
        per_heat = 2.0 * taken * np.append(met @ weights, weights.sum())
        heat = self.heating.coulomb_heat(self.pressure, speed)
        slip = self.heating.sliding(speed)
        if self.interface is not None and slip > 0.0:
            face = SlidingInterface(self.interface, slip, kelvin)
            heat = float(face.heat_of(area[-1], by_loss[-1:], per_heat[-1:], hot=self.start > 0.0)[0])
        return by_loss, heat * per_heat

    def _taken(self, speed: float, radius: float) -> float:
        """Return the share of the Coulomb heat that the rubber takes up; macroasperities have a radius, m."""
        assert self.heating is not None
        bodies = (self.heating.rubber, speed), (self.heating.counterface, abs(self.heating.over_counterface(speed)))
        rubber, other = (
            disc_mean(velocity * radius / (2.0 * body.diffusivity), hertz=False) / float(body.conductivity)
            for body, velocity in bodies
        )
        return other / (rubber + other)
