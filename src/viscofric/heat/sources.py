"""Steady rise of surface temperature by a disc or strip of heat that moves over a half-space."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.errors import InputError, check_choice
from viscofric.heat.means import disc_mean, strip_mean
from viscofric.heat.points import disc_points, strip_points
from viscofric.showing import Rows, Shown
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantities, Quantity, positive, to_si, to_si_in_shape

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
