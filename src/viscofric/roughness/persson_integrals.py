"""The integrals of Persson's theory, on grids of wave numbers that are refined until nothing changes.

The formulae are those of `viscofric.roughness.persson`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import erf

from viscofric.arrays import Array, ComplexArray, gauss
from viscofric.errors import ConvergenceError
from viscofric.rheology.material import Material
from viscofric.roughness.flash import Flash
from viscofric.roughness.spectrum import PowerSpectrum

#: Refinements after which the integrals count as not converged; the first grid has 8 intervals per decade.
_MOST_REFINEMENTS = 7
_FIRST = math.log(10.0) / 8.0
_DIRECTIONS = 12
#: Lengths of the first interval of ln q: that over which G grows to a hundredth, between these.
_SHORTEST, _LONGEST_START, _SMALL_SPREAD = 1e-24, 1e-6, 0.01
_GROWTH = 2.0  # how much longer each of the next ones is, over the longest


class Case(NamedTuple):
    """Temperature (K, or None) and speed (m/s) of one contact."""

    kelvin: float | None
    speed: float


class Scales(NamedTuple):
    """P(q), the friction of all waves up to q, and the rise of temperature, K, at each scale; and mean rises, K.

    Weighted with the loss, by all heat and by the Coulomb heat alone; of the surface.
    """

    area: Array
    friction: Array
    rise: Array
    mean_rise: float = 0.0
    coulomb_rise: float = 0.0
    face_rise: float = 0.0


class Found(NamedTuple):
    """All cases on one grid of wave numbers."""

    q: Array
    cases: list[Scales]


class Theory:
    """The integrals on grids of wave numbers that are refined until they do not change."""

    def __init__(
        self, material: Material, spectrum: PowerSpectrum, pressure: float, gamma: float, flash: Flash | None
    ) -> None:
        self.material, self.spectrum, self.pressure, self.gamma, self.flash = material, spectrum, pressure, gamma, flash
        self.plane_strain = 1.0 - material.poisson_ratio**2

    def converged(self, cases: list[Case], accuracy: float) -> tuple[Found, float]:
        """Return all cases on a grid fine enough, and the estimated error."""
        coarse = self._on_grid(cases, _FIRST, _DIRECTIONS)
        error = math.inf
        for halvings in range(1, _MOST_REFINEMENTS + 1):
            fine = self._on_grid(cases, _FIRST / 2**halvings, _DIRECTIONS * (1 + halvings))
            largest = max(float(np.abs(one.friction).max()) for one in fine.cases)
            error = max(
                max(
                    abs(float(one.area[-1] - two.area[-1])),
                    abs(float(one.friction[-1] - two.friction[-1])) / max(largest, 1e-300),
                )
                for one, two in zip(coarse.cases, fine.cases, strict=True)
            )
            if error <= accuracy:
                return fine, error
            coarse = fine
        raise ConvergenceError(
            f"the integrals of Persson's theory still change by {error:.1g} after {_MOST_REFINEMENTS} refinements; "
            f"request an accuracy above {accuracy:g}.",
            code="not-converged",
        )

    def _on_grid(self, cases: list[Case], width: float, directions: int) -> Found:
        start = min(self._first_interval(case) for case in cases)
        logs = np.log(self.spectrum.wave_number / self.spectrum.wave_number[0])
        grid = _Grid(_interval_ends(logs, width, start), self.spectrum, directions)
        return Found(grid.q[::2], [self._case(case, grid) for case in cases])

    def _first_interval(self, case: Case) -> float:
        """Return how far beyond the longest wave, in ln q, G is still small: the less, the smaller the load."""
        q = self.spectrum.wave_number[:1]
        modulus = abs(self.material.at(case.kelvin).complex_modulus(case.speed * q)) / self.plane_strain
        slope = 0.25 * math.pi * q**4 * self.spectrum(q) * np.square(modulus / self.pressure)
        return float(np.clip(_SMALL_SPREAD / np.maximum(slope, 1e-300), _SHORTEST, _LONGEST_START)[0])

    def _case(self, case: Case, grid: _Grid) -> Scales:
        by_coulomb = rise = np.zeros(len(grid.q))
        face = 0.0
        if self.flash is None or case.kelvin is None or case.speed == 0.0:
            area, dissipated = self._isothermal(case, grid, rise)
        else:

            def heated(rise: Array) -> tuple[Array, Array]:
                return self._isothermal(case, grid, rise)

            at = case.speed, case.kelvin
            area, dissipated, rise, by_coulomb, face = self.flash.settled(grid.q, grid.log_weights, at, heated)
        lost = 0.5 * grid.q * area * dissipated / self.pressure
        friction = grid.cumulative(lost)
        if friction[-1] <= 0.0:
            return Scales(area[::2], friction, rise[::2], face_rise=face)
        mean, coulomb = (float(grid.cumulative(lost * one)[-1] / friction[-1]) for one in (rise, by_coulomb))
        return Scales(area[::2], friction, rise[::2], mean, coulomb, face)

    def _isothermal(self, case: Case, grid: _Grid, rise: Array) -> tuple[Array, Array]:
        """Return P(q) and q³ C S ∫dφ cos φ Im E/(1−ν²) at given temperatures, at the ends and middles of a grid."""
        modulus = self._modulus(case, grid, rise) / self.plane_strain
        square = 4.0 * (np.square(np.abs(modulus)) @ grid.weights)
        spread = grid.cumulative_everywhere(0.125 * grid.q * grid.cubed_density * square / self.pressure**2)
        root = np.sqrt(np.maximum(spread, 1e-300))
        area = erf(0.5 / root)
        dissipated = grid.cubed_density * 4.0 * (modulus.imag @ (grid.weights * grid.cosines))
        sharing = self.gamma + (1.0 - self.gamma) * area**2
        return area, sharing * dissipated

    def _modulus(self, case: Case, grid: _Grid, rise: Array) -> ComplexArray:
        """Return E(q v cos φ, T_q) for each q and φ."""
        frequency = case.speed * grid.q[:, None] * grid.cosines
        if self.flash is None or case.kelvin is None:
            return np.asarray(self.material.at(case.kelvin).complex_modulus(frequency))
        kelvins = case.kelvin + rise
        shift, vertical = self.material.shift, self.material.vertical_shift
        assert shift is not None
        alpha = np.asarray(shift(kelvins))
        b = np.ones(len(kelvins)) if vertical is None else np.asarray(vertical(kelvins))
        return np.asarray(b[:, None] * self.material.spectrum.complex_modulus(alpha[:, None] * frequency))


def _interval_ends(logs: Array, width: float, start: float) -> Array:
    """Return ends of intervals of ln q/q0, no longer than a width, with all points of the spectrum among them."""
    # Just beyond the longest wave P falls from one like the inverse root of the distance: intervals grow from there on.
    starts = [start]
    while starts[-1] < 1.0 / _GROWTH:
        starts.append(starts[-1] * (1.0 + _GROWTH * width))
    graded = np.concatenate([[0.0], starts])
    parts = np.unique(np.concatenate([logs, graded[graded < logs[-1]]]))
    # Two that differ by rounding are one; those close to zero are exact.
    parts = parts[np.concatenate([[True], np.diff(parts) > 1e-12 * parts[1:]])]
    counts = np.maximum(1, np.ceil(np.diff(parts) / width)).astype(int)
    pieces = zip(parts[:-1], parts[1:], counts, strict=True)
    return np.concatenate([*(np.linspace(a, b, n, endpoint=False) for a, b, n in pieces), logs[-1:]])


class _Grid:
    """Wave numbers at the ends and in the middles of intervals of ln q/q0 (Simpson's rule), and directions φ.

    Directions from 0 to π/2 are crowded towards π/2, where frequencies fall to zero: φ = π/2 (1 − s²), s by Gauss's
    rule.
    """

    def __init__(self, ends: Array, spectrum: PowerSpectrum, directions: int) -> None:
        logs = np.empty(2 * len(ends) - 1)
        logs[::2] = ends
        logs[1::2] = 0.5 * (ends[:-1] + ends[1:])
        self.width = np.diff(ends)
        self.q = spectrum.wave_number[0] * np.exp(logs)
        self.cubed_density = self.q**3 * spectrum(self.q)
        s, weight = gauss(directions)
        self.cosines = np.sin(0.5 * math.pi * s**2)
        self.weights = weight * math.pi * s
        self.log_weights = np.zeros(len(self.q))
        self.log_weights[:-2:2] += self.width / 6.0
        self.log_weights[1::2] = 4.0 * self.width / 6.0
        self.log_weights[2::2] += self.width / 6.0

    def cumulative(self, values: Array) -> Array:
        """Return the integral over ln q up to each end of an interval."""
        parts = self.width / 6.0 * (values[:-2:2] + 4.0 * values[1::2] + values[2::2])
        return np.concatenate([[0.0], np.cumsum(parts)])

    def cumulative_everywhere(self, values: Array) -> Array:
        """Return the integral up to each end and middle; to the middle, that of the parabola through the three."""
        ends = self.cumulative(values)
        found = np.empty(len(values))
        found[::2] = ends
        found[1::2] = ends[:-1] + self.width / 24.0 * (5.0 * values[:-2:2] + 8.0 * values[1::2] - values[2::2])
        return found
