"""Solution of a periodic contact: fields, numbers, and their errors."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from viscofric.arrays import Array
from viscofric.contact.solution import SHARED_NUMBERS, Meaning, labelled_numbers, number_rows
from viscofric.datasets import Dataset, dataset
from viscofric.heat.result import ContactHeating
from viscofric.notes import Warned
from viscofric.showing import Plotted, Rows, Shown

#: Numbers of a contact on a rough surface.
NUMBERS: dict[str, Meaning] = SHARED_NUMBERS | {
    "lateral_friction_error": ("1", "numerical error estimate of the lateral coefficient"),
    "mean_pressure": ("Pa", "mean pressure"),
    "mean_gap": ("m", "mean gap between the surfaces"),
    "indentation": ("m", "distance that the surface has moved since the first touch"),
    "contact_area_fraction": ("1", "contact area fraction on this grid"),
    "mean_contact_pressure": ("Pa", "mean pressure on the points in contact"),
    "max_pressure": ("Pa", "largest contact pressure on this grid"),
    "power": ("W/m**2", "dissipated power per area"),
    "complementarity": ("1", "largest violation of the contact conditions over the rms height"),
    "cells": ("1", "points along the longer period"),
    "products": ("1", "products with the transfer function on the finest grid"),
}


@dataclass(frozen=True)
class PeriodicDiagnostics(Shown):
    """Work, convergence and error estimates of a periodic contact.

    Attributes
    ----------
    complementarity : float
        Largest gap under pressure or overlap without it, over the rms height of the surface.
    load : float
        Relative error of the mean pressure, or of the mean gap, whichever was given.
    linear : float
        Residual of the last linear problem on the contact, relative to its right-hand side.
    energy : float
        Energy balance: friction from the pressure on the slopes less that from the dissipated energy, over the larger
        of them (or over 1e-3 times 2π rms heights per period, a slope).
    friction_error : float
        Estimated error of the friction coefficient that the grid makes, the largest of: how far the coefficients from
        the energy and from the pressure on the slopes differ, which in full contact they do not; how far the one from
        the next coarser grid differs; and how far the two differ there, over 2^(3/2).  Where that grid does not have
        all the waves of the surface, a quarter of the load's share on points at the edges of the contact, times the
        coefficient of the whole force and, of n points in contact, 1 + (24/n)², is taken in its place.
    lateral_friction_error : float
        The same of the lateral coefficient, no less than that of the friction coefficient.
    full_contact : bool
        Whether everything is in contact; then the problem is linear and solved directly.
    products, ffts, single_ffts : int
        On the finest grid: products with the transfer function, two-dimensional real FFTs in all, and how many of
        them in single precision (corrections only: residuals are formed in double precision).
    splitting_steps, set_changes, linear_iterations : int
        On the finest grid: steps of the operator splitting, updates of the contact set, steps of the linear solver.
    grids : tuple of (int, int, int)
        Points along x and y, and FFTs, of every nested grid, coarsest first.
    """

    complementarity: float
    load: float
    linear: float
    energy: float
    friction_error: float
    lateral_friction_error: float
    full_contact: bool
    products: int
    ffts: int
    single_ffts: int
    splitting_steps: int
    set_changes: int
    linear_iterations: int
    grids: tuple[tuple[int, int, int], ...]

    def _shown(self) -> Rows:
        return (
            ("error of the friction", self.friction_error),
            ("energy balance", self.energy),
            ("complementarity", self.complementarity),
            ("full contact", self.full_contact),
            ("nested grids", self.grids),
            ("products", self.products),
        )


@dataclass(frozen=True, eq=False)
class PeriodicSolution(Warned, Plotted):
    """Steady contact of a periodic rough surface that slides over a viscoelastic half-space or layer.

    All in SI units.

    Attributes
    ----------
    speed : float
        m/s, as given.
    direction : (float, float)
        Unit vector of the motion of the surface.
    temperature : float or None
        K, as given.
    mean_pressure : float
        Pa: as given, or what a given gap takes.
    mean_gap : float
        Mean distance between the surfaces, m: as given, or what a given pressure leaves.
    indentation : float
        δ, m: how far the surface has moved towards the solid since their first touch.  A half-space's mean displacement
        is without meaning and counted as zero; that of a layer is contained.
    friction_coefficient : float
        μ = F_t/F_N along the motion, with the sign of the speed, from the energy that the solid dissipates.
    pressure_friction_coefficient : float
        The same from the pressure on the slopes of the surface; how far it differs shows how well the grid resolves
        the edges of the contact.
    lateral_friction_coefficient : float
        Force across the motion over the load: the component along `direction` turned by a right angle, from x to y, of
        the force that `friction_coefficient` is the other component of.  Positive where it must be pushed that way to
        slide straight; ridges that run obliquely to the motion steer it.
    contact_area_fraction : float
        Points under pressure over all.
    max_pressure : float
        Pa.
    x, y : (nx,) and (ny,) array
        Positions of the points, m.
    pressure, displacement, gap : (nx, ny) array
        Pa; m into the solid (for a layer with its mean compression); m.
    diagnostics : PeriodicDiagnostics
    warnings : tuple of str
        One note for each assumption that is doubtful.
    coulomb : float
        Coulomb friction coefficient whose shear changed the pressure, as given; not part of `friction_coefficient`.
    heating : ContactHeating or None
        Heat, rise of temperature and isothermal friction, where requested; `temperature` is that without the rise.
    """

    speed: float
    direction: tuple[float, float]
    temperature: float | None
    mean_pressure: float
    mean_gap: float
    indentation: float
    friction_coefficient: float
    pressure_friction_coefficient: float
    lateral_friction_coefficient: float
    contact_area_fraction: float
    max_pressure: float
    x: Array = field(repr=False)
    y: Array = field(repr=False)
    pressure: Array = field(repr=False)
    displacement: Array = field(repr=False)
    gap: Array = field(repr=False)
    diagnostics: PeriodicDiagnostics
    warnings: tuple[str, ...] = ()
    coulomb: float = 0.0
    heating: ContactHeating | None = None

    def _shown(self) -> Rows:
        return (
            ("friction coefficient", self.friction_coefficient, "", self.diagnostics.friction_error),
            ("speed", self.speed, "m/s"),
            ("mean pressure", self.mean_pressure, "Pa"),
            ("temperature", self.temperature, "°C"),
            ("rise of temperature", None if self.heating is None else self.heating.temperature_rise, "K"),
            ("contact area", self.contact_area_fraction, "%"),
            ("mean gap", self.mean_gap, "m"),
            ("largest pressure", self.max_pressure, "Pa"),
            ("points", " × ".join(map(str, self.pressure.shape))),
            ("warnings", self.warnings),
        )

    @property
    def friction_error(self) -> float:
        """Error estimate of the friction coefficient, that of the `diagnostics`."""
        return self.diagnostics.friction_error

    @property
    def temperature_rise(self) -> float:
        """Rise of temperature by friction at which the contact was solved, K; zero without `heating`."""
        return 0.0 if self.heating is None else self.heating.temperature_rise

    @property
    def number_rows(self) -> dict[str, tuple[str, float, str, float | None]]:
        """All numbers by name: long name, value, unit, and error or None."""
        return number_rows(NUMBERS, self._number_values)

    @property
    def numbers(self) -> Dataset:
        """All numbers with units and long names; ``ancillary_variables`` names the error of the friction."""
        found = labelled_numbers(NUMBERS, self._number_values)
        return found if self.heating is None else found.assign(self.heating.to_dataset().data_vars)

    @property
    def _number_values(self) -> dict[str, float | None]:
        found = self.diagnostics
        touching = self.contact_area_fraction
        # With shear, the pressure's work alone is not what the material dissipates.
        dissipates = math.isfinite(self.speed) and self.coulomb == 0.0
        return {name: getattr(self, name, getattr(found, name, None)) for name in NUMBERS} | {
            "mean_contact_pressure": self.mean_pressure / touching if touching > 0.0 else None,
            "power": self.friction_coefficient * self.mean_pressure * self.speed if dissipates else None,
            "energy_balance": found.energy,
            "cells": max(self.pressure.shape),
        }

    def to_dataset(self) -> Dataset:
        """Return pressure, displacement and gap over x and y, and all `numbers`; main results also as attributes."""
        fields = dataset(
            ("x", "y"),
            {
                "pressure": (self.pressure, "Pa", "contact pressure"),
                "displacement": (self.displacement, "m", "displacement into the solid"),
                "gap": (self.gap, "m", "gap"),
            },
            coordinates={"x": (self.x, "m", "position along x"), "y": (self.y, "m", "position along y")},
            attributes={
                "speed": self.speed,
                "direction": self.direction,
                "mean_pressure": self.mean_pressure,
                "mean_gap": self.mean_gap,
                "friction_coefficient": self.friction_coefficient,
                "lateral_friction_coefficient": self.lateral_friction_coefficient,
                "contact_area_fraction": self.contact_area_fraction,
                "coulomb": self.coulomb,
            },
        )
        return fields.assign(self.numbers.data_vars)
