"""Friction of a material in closed form, to first order in the loss, and corrected by solved contacts."""

from __future__ import annotations

import copy
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter

# Spacing and ends of the tables, in natural logarithms: the kernels are power laws beyond them.
_STEP = 0.1
_TABLE = np.arange(-35.0, 35.0 + 0.5 * _STEP, _STEP)
_WAVES = np.arange(-12.0, 7.0, 0.02)
_COSH = np.arange(0.0, 14.0, 0.01)
#: Newton's steps for the contact radius; each squares an error that is below one at the start.
_NEWTON = 8
_SETTLED = 1e-6
#: Largest change of ln C of a neighbouring material.
_FARTHEST = 300.0
#: Range of ln(load × compliance) that the radii are tabulated over, on both sides of the first guess.
_REACH = 16.0


class Friction(NamedTuple):
    """Friction and contact radius at n speeds."""

    log_friction: Array  # (n,), ln μ
    change: Array  # (n, 1 + m), its derivatives by ln(1/E_inf) and every ln C
    slope: Array  # (n,), that by ln v
    log_radius: Array  # (n,), and its derivatives likewise
    radius_change: Array
    radius_slope: Array


class FirstOrder:
    """Friction of an indenter by the energy that Hertz's pressure dissipates.

    It starts an identification, and transfers solved contacts to neighbouring materials.  `load` in N, of a line
    contact N/m; `plane_strain` is 1 − ν²; `tau` (m,) are retardation times, s.

    With p̂ the transform of Hertz's pressure, F_t v = ∫ d²q/(2π)² 2(1−ν²)/|q| (q·v) (−Im S(q·v)) |p̂|², the energy
    balance of steady sliding to first order in −Im S; the contact radius a is that of an elastic contact with the mean
    compliance of the same waves, Re S.  Then μ = F (1−ν²) Σ C_k K(τ_k v/a)/(2π² a²).
    """

    def __init__(self, indenter: Indenter, load: float, plane_strain: float, tau: Array) -> None:
        self._set_times(tau)
        self._log_load = np.log(load * plane_strain)
        self._dimension = indenter.geometry.dimension
        self._loss, self._storage = _kernels(self._dimension)
        self._constant = self._log_load - (np.log(2.0 * np.pi**2) if self._dimension == 2 else np.log(0.5 * np.pi))
        places = np.log(load * plane_strain / 1e6) + np.arange(-_REACH, _REACH + 0.25, 0.5)
        lengths = [Scale.for_load(indenter, load / float(np.exp(place)), load).length for place in places]
        self._radius = _Table(places, np.log(lengths))

    def _set_times(self, tau: Array) -> None:
        self.tau, self._log_tau = tau, np.log(tau)

    def at_times(self, tau: Array) -> FirstOrder:
        """Return the same contact on a material of other retardation times, s."""
        found = copy.copy(self)
        found._set_times(tau)
        return found

    def __call__(self, compliances: Array, log_speed: Array) -> Friction:
        """Return friction at compliances (1 + m,), ln(1/E_inf) and then every ln C, in 1/Pa, and ln v (n,), in m/s."""
        glass, C = np.exp(compliances[0]), np.exp(compliances[1:])
        # of the relaxed solid, which is too large
        radius = np.full(log_speed.shape, float(self._radius(self._log_load + np.log(glass + C.sum()))[0]))
        for _ in range(_NEWTON):
            stored = self._storage((log_speed - radius)[:, None] + self._log_tau)
            kernel = C * np.exp(stored[0])
            total = glass + kernel.sum(axis=1)
            bend = np.sum(kernel * stored[1], axis=1) / total
            elastic, power = self._radius(self._log_load + np.log(total))
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
    """Return ln of the loss kernel K(θ) and of the storage kernel, 1 at θ = 0, over ln θ = ln(τ v/a)."""
    # K(θ) = ∫ W(t) tθ/(1 + t²θ²) dt with W the dissipation's weight of the waves q·v/|v| = t/a; of a ball's Hertz
    # pressure, whose transform is g(z) = 3 (sin z − z cos z)/z³, W(t) = 4 t ∫ g(t cosh y)² dy, and of a cylinder's,
    # g(z) = 2 J1(z)/z, W(t) = g(t)².
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
    """Cubic spline of values at equally spaced points and of their slope, evaluated together, faster than by SciPy."""

    def __init__(self, places: Array, values: Array) -> None:
        from scipy.interpolate import CubicSpline

        spline = CubicSpline(places, np.column_stack([values, CubicSpline(places, values)(places, 1)]))
        self._first, self._step = float(places[0]), float(places[1] - places[0])
        self._coefficients = np.ascontiguousarray(np.moveaxis(spline.c, -1, 1))

    def __call__(self, places: Array) -> Array:
        """Return values and slopes, (2, …); those beyond the ends as the outermost cubics continue."""
        along = (places - self._first) / self._step
        # not np.clip, which takes longer than all the rest
        number = np.minimum(np.maximum(along.astype(np.intp), 0), self._coefficients.shape[-1] - 1)
        away = (along - number) * self._step
        a, b, c, d = np.take(self._coefficients, number, axis=-1)
        return np.asarray(((a * away + b) * away + c) * away + d)


def extrapolated(away: Array, slopes: Array, weights: Array) -> tuple[Array, Array, Array]:
    """Return changes of n logarithms to another material over J, and their derivatives by ln C and by w, (n, p) each.

    With `away` d (p,) the changes of ln C, `slopes` J (n, p), and `weights` w (n, p) of the modes in the compliance
    that is felt, they change by Σ J_k (e^{d_k}/M − 1 + ln M), M = Σ w_k e^{d_k}: linear in the level and in the share
    of each mode.  It is exact if all moduli change by one factor; what a mode contributes vanishes with it.
    """
    grown = np.exp(np.minimum(away, _FARTHEST))
    level = weights @ grown
    relative = grown / level[:, None]
    by_weight = relative * np.sum(slopes * (1.0 - relative), axis=1)[:, None]
    return np.log(level)[:, None] + relative - 1.0, slopes * relative + weights * by_weight, by_weight


class Solved(NamedTuple):
    """Results of solved contacts of one material, at k nodes."""

    compliances: Array  # (1 + m,), ln(1/E_inf) and every ln C
    log_speed: Array  # (k,)
    log_friction: Array  # (k,), ln μ
    error: Array  # (k,), relative
    change: Array  # (k, 1 + m), derivatives of ln μ by the compliances
    load_slope: Array  # (k,), that by ln F


class CorrectedFriction:
    """ln μ at any speed and compliances, exact with its derivatives at the nodes of the solved material.

    The error of the closed form in ln μ and in its derivatives varies so slowly with ln v that a cubic spline through a
    few nodes per decade represents it.  For other materials it is `extrapolated`: space mapping (J. W. Bandler et al.,
    IEEE Trans. Microw. Theory Tech. 42 (1994) 2536).  Without `solved`, the first-order form is not corrected.
    """

    def __init__(self, first: FirstOrder, solved: Solved | None = None) -> None:
        from scipy.interpolate import CubicSpline

        self.first, self.solved = first, solved
        if solved is not None:
            crude = first(solved.compliances, solved.log_speed)
            shares = crude.radius_change / crude.radius_change.sum(axis=1, keepdims=True)
            missing = np.column_stack([solved.log_friction - crude.log_friction, solved.load_slope])
            self._missing = CubicSpline(solved.log_speed, np.stack([solved.change - crude.change, shares], axis=-1))
            self._alone = CubicSpline(solved.log_speed, missing)

    def __call__(self, compliances: Array, log_speed: Array, log_load: Array) -> tuple[Array, Array, Array]:
        """Return ln μ (n,), its derivatives by the compliances (n, 1 + m) and by ln v (n,)."""
        # `compliances` (1 + m,) are ln(1/E_inf), then every ln C; `log_speed` and `log_load` (n,) are ln of the reduced
        # speed, m/s, and of the load over that of the nodes.
        crude = self.first(compliances, log_speed)
        if self.solved is None:
            return crude.log_friction, crude.change, crude.slope
        nodes = self.solved.log_speed
        inside = np.clip(log_speed, nodes[0], nodes[-1])
        within = np.where(inside == log_speed, 1.0, 0.0)
        missing, shares = np.moveaxis(self._missing(inside), -1, 0)
        rising, growing = np.moveaxis(self._missing(inside, 1), -1, 0)
        alone, alone_rising = self._alone(inside), self._alone(inside, 1)
        shares = np.maximum(shares, 0.0)  # which a spline does not observe
        away = compliances - self.solved.compliances
        moved, change, by_weight = extrapolated(away, missing, shares)
        slope = (
            alone_rising[:, 0] + alone_rising[:, 1] * log_load + np.sum(rising * moved + growing * by_weight, axis=1)
        )
        return (
            crude.log_friction + alone[:, 0] + alone[:, 1] * log_load + np.sum(missing * moved, axis=1),
            crude.change + change,
            crude.slope + within * slope,
        )
