"""Steady rise of surface temperature by a disc or strip of heat that moves over a half-space.

At points, in units of the source, it is summed along rays from the point, on which the kernel of `viscofric.heat.means`
loses its pole.  On a ray at the angle θ to the motion, from r1 to r2 within the disc ::

    T k/(q̄ a) = 1/2π ∫dθ ∫_{r1}^{r2} dr q/q̄ exp(−Pe r (1 − cos θ))

The integral along the ray is known for a uniform source.  Under a uniform strip T is the difference of
F(u) = ∫_0^u exp(−t) K0(|t|) dt at its ends, u (exp(−u)) (K0 − K1) + 1 where u > 0 (NIST DLMF, 10.43.8).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array, unit_nodes
from viscofric.errors import InputError, check_choice
from viscofric.heat.means import disc_mean, strip_mean
from viscofric.showing import Rows, Shown
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantities, Quantity, positive, to_si, to_si_in_shape

_ANGLES, _ALONG = 121, 81
_AT_ONCE = 128  # points, whose integrands are held at the same time


def disc_points(x: Array, y: Array, peclet: float, *, hertz: bool) -> Array:
    """Return T k/(q̄ a) at points (n,) in radii from the centre, x along the motion."""
    parts = range(0, len(x), _AT_ONCE)
    found = [_some_points(x[one : one + _AT_ONCE], y[one : one + _AT_ONCE], peclet, hertz) for one in parts]
    return np.concatenate(found) if found else np.zeros(0)


def _some_points(x: Array, y: Array, peclet: float, hertz: bool) -> Array:
    from scipy.special import exprel

    node, along = unit_nodes(_ANGLES), unit_nodes(_ALONG)
    starts, widths = _rays(x, y)  # (n, 3)
    angle = starts[..., None] + widths[..., None] * node.place
    weight = widths[..., None] * node.weight
    toward = x[:, None, None] * np.cos(angle) + y[:, None, None] * np.sin(angle)
    outside = (np.square(x) + np.square(y) - 1.0)[:, None, None]
    root = np.sqrt(np.maximum(np.square(toward) - outside, 0.0))
    first, last = -toward - root, -toward + root
    start = np.where(outside > 0.0, np.maximum(first, 0.0), 0.0)
    length = np.maximum(last - start, 0.0)
    decay = 2.0 * peclet * np.square(np.sin(0.5 * angle))
    if not hertz:
        return np.asarray(
            (weight * np.exp(-decay * start) * length * exprel(-decay * length)).sum((1, 2)) / (2 * np.pi)
        )
    total = np.zeros(len(x))
    for place, rest, part in zip(*along, strict=True):
        source = np.sqrt(np.maximum(length * rest * (start - first + length * place), 0.0))
        total += part * (weight * length * source * np.exp(-decay * (start + length * place))).sum((1, 2))
    return 1.5 * total / (2.0 * np.pi)


def _rays(x: Array, y: Array) -> tuple[Array, Array]:
    """Return first angles and widths (n, 3) of the parts in which the integral over the angle is smooth."""
    # They end where the ray points along the motion, at which the integrand peaks, and where it passes the centre
    # closest, at which it has a kink for points at the edge; points outside see the disc between two tangents.
    radius, centre = np.hypot(x, y), np.arctan2(y, x)
    half = np.where(radius > 1.0, np.arcsin(1.0 / np.maximum(radius, 1.0)), np.pi)
    low = np.where(radius > 1.0, centre + np.pi - half, 0.0)
    cuts = np.where(
        radius[:, None] > 1.0, np.stack([0.0 * centre, 0.0 * centre], 1), centre[:, None] + np.array([0.5, 1.5]) * np.pi
    )
    # Counted from the first angle on; those beyond the last one make a part of no width.
    within = np.minimum(np.mod(cuts - low[:, None], 2.0 * np.pi), 2.0 * half[:, None])
    ends = np.concatenate([np.zeros((len(x), 1)), np.sort(within, axis=1), 2.0 * half[:, None]], axis=1)
    return low[:, None] + ends[:, :-1], np.diff(ends, axis=1)


def strip_points(x: Array, peclet: float, *, hertz: bool) -> Array:
    """Return T k/(q̄ a) at distances (n,) from the middle, in half-widths; Pe is above zero."""
    from scipy.special import k0e

    if not hertz:
        return np.asarray(
            (_strip_integral(peclet * (x + 1.0)) - _strip_integral(peclet * (x - 1.0))) / (np.pi * peclet)
        )
    node = unit_nodes(_ANGLES)
    total = np.zeros(len(x))
    start = np.clip(x, -1.0, 1.0)  # the kernel's pole, for points on the strip
    for end in (-1.0, 1.0):
        to_end = np.abs(end - start)[:, None]
        distance = np.sign(end) * to_end * node.place
        source = np.sqrt(np.maximum(1.0 - np.square(start[:, None] + distance), 0.0))
        ahead = distance + (start - x)[:, None]
        z = np.maximum(peclet * np.abs(ahead), 1e-300)  # the pole of a part without length, at an edge
        kernel = k0e(z) * np.where(ahead > 0.0, 1.0, np.exp(-2.0 * z))
        total += (to_end * node.weight * source * kernel).sum(1)
    return (4.0 / np.pi) * total / np.pi


def _strip_integral(u: Array) -> Array:
    from scipy.special import k0e, k1e

    size = np.maximum(np.abs(u), 1e-300)
    ahead = 1.0 + size * np.exp(-2.0 * size) * (k0e(size) - k1e(size))
    behind = 1.0 - size * (k0e(size) + k1e(size))
    return np.where(u > 0.0, ahead, behind)


#: Beyond it the temperature next to the edges changes within less than the quadrature resolves.
FASTEST = 1e6


@dataclass(frozen=True)
class MovingHeatSource(Shown):
    """A disc or strip of heat that moves at a constant velocity over a half-space, in the steady state.

    No heat leaves the surface elsewhere.  Temperatures are rises above that of the body far away.

    Parameters
    ----------
    power : float, str or pint.Quantity
        Heat that the body takes up, W; of a strip per length, W/m.
    size : float, str or pint.Quantity
        Radius of the disc or half-width of the strip a, m.
    speed : float, str or pint.Quantity
        v over the body, towards +x, m/s, not below zero; a strip has no steady temperature at rest.
    body : ThermalProperties
    shape : {"disc", "strip"}
    distribution : {"hertz", "uniform"}
        Of the heat: like Hertz's pressure, √(1 − r²/a²), or uniform.

    Raises
    ------
    InputError
        If a value cannot be used.

    Notes
    -----
    The Péclet number is va/(2κ) here, κ the diffusivity; part of the literature leaves the 2 out.  Mean and largest
    rise are exact to 1e-6 at Péclet numbers up to 1e4; the mean is at any (see the theory page on heat).

    Examples
    --------
    >>> import viscofric as vf
    >>> steel = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
    >>> spot = vf.heat.MovingHeatSource("10 W", size="0.5 mm", speed="1 m/s", body=steel)
    >>> f"Pe = {spot.peclet_number:.1f}: mean {spot.mean_temperature:.1f} K, largest {spot.max_temperature:.1f} K"
    'Pe = 20.2: mean 21.9 K, largest 39.4 K'
    """

    power: Quantity
    size: Quantity
    speed: Quantity
    body: ThermalProperties
    shape: Literal["disc", "strip"] = "disc"
    distribution: Literal["hertz", "uniform"] = "hertz"

    def __post_init__(self) -> None:
        check_choice(self.shape, "shape", "disc", "strip")
        check_choice(self.distribution, "distribution", "hertz", "uniform")
        insist_on(self.body, "body", ThermalProperties)
        object.__setattr__(self, "power", to_si(self.power, "W/m" if self.shape == "strip" else "W", "power"))
        object.__setattr__(self, "size", positive(self.size, "m", "size"))
        object.__setattr__(self, "speed", to_si(self.speed, "m/s", "speed"))
        least = 0.0 if self.shape == "disc" else math.nextafter(0.0, 1.0)
        if not (float(self.power) >= 0.0 and float(self.speed) >= least and self.peclet_number <= FASTEST):
            raise InputError(
                f"power = {self.power:g}, speed = {self.speed:g} m/s: neither may be below zero, a strip must move, "
                f"and va/(2κ) may not be above {FASTEST:g}.",
                code="out-of-range",
            )

    def _shown(self) -> Rows:
        return (
            ("power", self.power, "W/m" if self.shape == "strip" else "W"),
            ("size", self.size, "m"),
            ("speed", self.speed, "m/s"),
            ("body", self.body.name),
            ("shape", self.shape),
            ("Péclet number", self.peclet_number),
            ("mean rise", self.mean_temperature, "K"),
            ("largest rise", self.max_temperature, "K"),
        )

    @property
    def peclet_number(self) -> float:
        """Péclet number va/(2κ)."""
        return float(self.speed) * float(self.size) / (2.0 * self.body.diffusivity)

    @property
    def mean_temperature(self) -> float:
        """Mean rise of temperature over the source, K."""
        mean = disc_mean if self.shape == "disc" else strip_mean
        return self._unit * mean(self.peclet_number, hertz=self._hertz)

    @property
    def max_temperature(self) -> float:
        """Largest rise of temperature, K."""
        return self._unit * self._highest[1]

    @property
    def max_position(self) -> float:
        """Where the largest rise is, x from the centre, m: behind it, below zero."""
        return float(self.size) * self._highest[0]

    def temperature_at(self, x: Quantities, y: Quantities = 0.0) -> Array:
        """Return the rise of temperature at points of the surface, K.

        Parameters
        ----------
        x, y : float, str, pint.Quantity, or an array or list of them
            From the source's centre, along and across the motion, m; broadcast against each other.  A strip has no y.

        Returns
        -------
        array
            Of the shape of x and y.

        Raises
        ------
        InputError
            If the shapes do not fit each other.
        """
        size = float(self.size)
        along, across = to_si_in_shape(x, "m", "x") / size, to_si_in_shape(y, "m", "y") / size
        try:
            along, across = np.broadcast_arrays(along, across)
        except ValueError:
            raise InputError(
                f"x and y: shapes {along.shape} and {across.shape} do not fit each other.", code="wrong-length"
            ) from None
        return np.asarray(self._unit * self._at(along.ravel(), across.ravel()).reshape(along.shape))

    @property
    def _hertz(self) -> bool:
        return self.distribution == "hertz"

    @property
    def _unit(self) -> float:
        """Mean flux times size over conductivity, K."""
        size = float(self.size)
        area = math.pi * size**2 if self.shape == "disc" else 2.0 * size
        return float(self.power) / area * size / float(self.body.conductivity)

    def _at(self, x: Array, y: Array) -> Array:
        if self.shape == "disc":
            return disc_points(x, y, self.peclet_number, hertz=self._hertz)
        return strip_points(x, self.peclet_number, hertz=self._hertz)

    @cached_property
    def _highest(self) -> tuple[float, float]:
        """Where the largest rise is, in sizes, and how large it is, in units."""
        from scipy.optimize import minimize_scalar

        found = minimize_scalar(
            lambda x: -float(self._at(np.array([x]), np.zeros(1))[0]),
            bounds=(-1.0, 0.0),
            method="bounded",
            options={"xatol": 1e-8},
        )
        return float(found.x), -float(found.fun)
