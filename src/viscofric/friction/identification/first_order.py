"""Friction to first order in the loss: Hertz's contact at the modulus of its own frequency, in closed form.

It starts an identification and carries a solved contact over to neighbouring rubbers; what it misses is put right by
solved contacts (`viscofric.friction.identification.corrected`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.contact.free.scale import Scale

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.indenters.indenter import Indenter


# Spacing and ends of the tables, in natural logarithms: the kernels are power laws beyond them.
_STEP = 0.1
_TABLE = np.arange(-35.0, 35.0 + 0.5 * _STEP, _STEP)
_WAVES = np.arange(-12.0, 7.0, 0.02)
_COSH = np.arange(0.0, 14.0, 0.01)
#: Newton's steps for the contact radius; each squares an error that begins below one.
_NEWTON = 8
_SETTLED = 1e-6
#: Range of ln(load × compliance) that the radii are tabulated over, on both sides of the first guess.
_REACH = 16.0


class Friction(NamedTuple):
    """ln μ (n,), and its derivatives by ln(1/E_inf) and every ln C (n, 1 + m) and by ln v (n,); radius alike.

    `log_radius` is the logarithm of the contact radius, `radius_change` and `radius_slope` its derivatives.
    """

    log_friction: Array
    change: Array
    slope: Array
    log_radius: Array
    radius_change: Array
    radius_slope: Array


@dataclass(frozen=True, eq=False)
class FirstOrder:
    """Friction of an indenter by the energy that Hertz's pressure dissipates.

    Parameters
    ----------
    indenter : Indenter
    load : float
        N; of a line contact, N/m.
    plane_strain : float
        1 − ν².
    tau : (m,) array
        Retardation times, s.

    Notes
    -----
    With p̂ the transform of Hertz's pressure, F_t v = ∫ d²q/(2π)² 2(1−ν²)/|q| (q·v) (−Im S(q·v)) |p̂|², the energy
    balance of steady sliding to first order in −Im S; the contact radius a is that of an elastic contact of the
    compliance that the same waves see, Re S averaged.  Then μ = F (1−ν²) Σ C_k K(τ_k v/a)/(2π² a²).
    """

    indenter: Indenter
    load: float
    plane_strain: float
    tau: Array

    def __post_init__(self) -> None:
        dimension = self.indenter.geometry.dimension
        loss, storage = _kernels(dimension)
        middle = np.log(self.load * self.plane_strain / 1e6)
        places = middle + np.arange(-_REACH, _REACH + 0.25, 0.5)
        lengths = [
            Scale.for_load(self.indenter, self.load / float(np.exp(place)), self.load).length for place in places
        ]
        numbers = {
            "_loss": loss,
            "_storage": storage,
            "_dimension": dimension,
            "_radius": _Table(places, np.log(lengths)),
            "_log_tau": np.log(self.tau),
            "_constant": np.log(self.load * self.plane_strain)
            - (np.log(2.0 * np.pi**2) if dimension == 2 else np.log(0.5 * np.pi)),
        }
        for name, value in numbers.items():
            object.__setattr__(self, name, value)

    _loss: _Table = None  # type: ignore[assignment]
    _storage: _Table = None  # type: ignore[assignment]
    _radius: _Table = None  # type: ignore[assignment]
    _log_tau: Array = None  # type: ignore[assignment]
    _dimension: int = 2
    _constant: float = 0.0

    def __call__(self, compliances: Array, log_speed: Array) -> Friction:
        """Return friction at speeds.

        Parameters
        ----------
        compliances : (1 + m,) array
            ln(1/E_inf), then every ln C; of 1/Pa.
        log_speed : (n,) array
            ln v, m/s.
        """
        glass, C = np.exp(compliances[0]), np.exp(compliances[1:])
        log_load = np.log(self.load * self.plane_strain)
        # of the relaxed solid, which is too wide
        radius = np.full(log_speed.shape, float(self._radius(log_load + np.log(glass + C.sum()))[0]))
        for _ in range(_NEWTON):
            stored = self._storage((log_speed - radius)[:, None] + self._log_tau)
            kernel = C * np.exp(stored[0])
            total = glass + kernel.sum(axis=1)
            bend = np.sum(kernel * stored[1], axis=1) / total
            elastic, power = self._radius(log_load + np.log(total))
            stiff = 1.0 + power * bend
            step = (radius - elastic) / stiff
            radius = radius - step
            if np.abs(step).max() < _SETTLED:
                break
        seen = np.concatenate([np.full((len(radius), 1), glass), kernel], axis=1) / total[:, None]
        radius_change = (power / stiff)[:, None] * seen
        radius_slope = power * bend / stiff
        table = self._loss((log_speed - radius)[:, None] + self._log_tau)
        lost = C * np.exp(table[0])
        sum_lost = lost.sum(axis=1)
        steep = np.sum(lost * table[1], axis=1) / sum_lost
        by_radius = -float(self._dimension) - steep
        change = by_radius[:, None] * radius_change
        change[:, 1:] += lost / sum_lost[:, None]
        return Friction(
            self._constant - self._dimension * radius + np.log(sum_lost),
            change,
            steep + by_radius * radius_slope,
            radius,
            radius_change,
            radius_slope,
        )


@lru_cache(maxsize=2)
def _kernels(dimension: int) -> tuple[_Table, _Table]:
    """Return ln of the loss kernel K(θ) and of the storage kernel, 1 at θ = 0, over ln θ = ln(τ v/a).

    K(θ) = ∫ W(t) tθ/(1 + t²θ²) dt with W the dissipation's weight of the waves q·v/|v| = t/a; of a ball's Hertz
    pressure, whose transform is g(z) = 3 (sin z − z cos z)/z³, W(t) = 4 t ∫ g(t cosh y)² dy, and of a cylinder's,
    g(z) = 2 J1(z)/z, W(t) = g(t)².
    """
    from scipy.special import expit, j1, spherical_jn

    t = np.exp(_WAVES)
    if dimension == 2:
        argument = t[:, None] * np.cosh(_COSH)
        transform = np.where(argument > 1e5, 0.0, 3.0 * spherical_jn(1, np.minimum(argument, 1e5)) / argument)
        sums = 4.0 * np.trapezoid(transform**2, _COSH, axis=1)
        loss, storage = t * sums, sums
    else:
        loss = storage = (2.0 * j1(t) / t) ** 2
    theta = _TABLE[:, None] + _WAVES
    # dt = t d ln t
    debye = 0.5 / np.cosh(np.clip(theta, -300.0, 300.0))
    relaxed = expit(-2.0 * theta)
    lost = np.trapezoid(loss * t * debye, _WAVES, axis=1)
    stored = np.trapezoid(storage * t * relaxed, _WAVES, axis=1) / np.trapezoid(storage * t, _WAVES)
    return _Table(_TABLE, np.log(lost)), _Table(_TABLE, np.log(stored))


class _Table:
    """Cubic spline of values at equally spaced places and of their slope, read at once and faster than SciPy's."""

    def __init__(self, places: Array, values: Array) -> None:
        from scipy.interpolate import CubicSpline

        spline = CubicSpline(places, np.column_stack([values, CubicSpline(places, values)(places, 1)]))
        self._first, self._step = float(places[0]), float(places[1] - places[0])
        self._coefficients = np.ascontiguousarray(np.moveaxis(spline.c, -1, 1))

    def __call__(self, places: Array) -> Array:
        """Return values and slopes, (2, …); those beyond the ends as the outermost cubics continue."""
        along = (places - self._first) / self._step
        number = np.clip(along.astype(np.intp), 0, self._coefficients.shape[-1] - 1)
        away = (along - number) * self._step
        a, b, c, d = np.take(self._coefficients, number, axis=-1)
        return np.asarray(((a * away + b) * away + c) * away + d)
