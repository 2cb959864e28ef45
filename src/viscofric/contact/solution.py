"""Solution of a steady contact: fields, numbers, and their errors."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

from viscofric.arrays import Array
from viscofric.contact.derivatives.friction import FrictionDerivatives
from viscofric.datasets import Dataset, dataset
from viscofric.heat.result import ContactHeating
from viscofric.notes import Warned
from viscofric.showing import Plotted, Rows, Shown

#: Unit and long name of a number.
Meaning: TypeAlias = tuple[str, str]
#: Numbers of every contact, of indenters and of rough surfaces.
SHARED_NUMBERS: dict[str, Meaning] = {
    "speed": ("m/s", "speed at which the rubber is deformed"),
    "temperature": ("K", "temperature"),
    "friction_coefficient": ("1", "viscoelastic friction coefficient"),
    "friction_error": ("1", "numerical error estimate of the friction coefficient"),
    "pressure_friction_coefficient": ("1", "friction coefficient from the pressure"),
    "lateral_friction_coefficient": ("1", "lateral guiding force over load, left of the direction"),
    "energy_balance": ("1", "friction from the pressure minus friction from the dissipation, relative"),
}
#: Numbers of an indenter's contact.
NUMBERS: dict[str, Meaning] = SHARED_NUMBERS | {
    "energy_friction_coefficient": ("1", "friction coefficient from the dissipation"),
    "friction_force": ("N", "friction force"),
    "friction_force_error": ("N", "numerical error estimate of the friction force"),
    "power": ("W", "dissipated power"),
    "power_error": ("W", "numerical error estimate of the dissipated power"),
    "load": ("N", "normal load"),
    "load_error": ("N", "error estimate of the load"),
    "indentation": ("m", "indentation"),
    "indentation_error": ("m", "error estimate of the indentation"),
    "contact_area": ("m**2", "contact area"),
    "contact_area_error": ("m**2", "error estimate of the contact area"),
    "front": ("m", "leading edge ahead of the axis"),
    "rear": ("m", "trailing edge behind the axis"),
    "half_width": ("m", "half-width across the motion"),
    "edge_error": ("m", "error estimate of front, rear and half-width"),
    "max_pressure": ("Pa", "largest contact pressure"),
    "max_pressure_error": ("Pa", "error estimate of the largest contact pressure"),
    "mean_pressure": ("Pa", "mean contact pressure"),
    "centre_of_pressure": ("m", "centre of pressure along the direction"),
    "centre_of_pressure_error": ("m", "error estimate of the centre of pressure"),
    "complementarity": ("1", "largest violation of the contact conditions over the indentation"),
    "cells": ("1", "cells along the longer edge of the finest window"),
    "spacing": ("m", "length of a cell along the motion"),
    "products": ("1", "products with the influence matrix"),
}
#: Those of a line contact, whose load and area are per length.
LINE_NUMBERS: dict[str, Meaning] = NUMBERS | {
    "friction_force": ("N/m", "friction force per length"),
    "friction_force_error": ("N/m", "numerical error estimate of the friction force per length"),
    "power": ("W/m", "dissipated power per length"),
    "power_error": ("W/m", "numerical error estimate of the dissipated power per length"),
    "load": ("N/m", "normal load per length"),
    "load_error": ("N/m", "error estimate of the load per length"),
    "contact_area": ("m", "width of the contact along the motion"),
    "contact_area_error": ("m", "error estimate of the width of the contact"),
}
#: The error estimate of each number that has one.
ERRORS = {
    "friction_coefficient": "friction_error",
    "lateral_friction_coefficient": "lateral_friction_error",
    "friction_force": "friction_force_error",
    "power": "power_error",
    "load": "load_error",
    "indentation": "indentation_error",
    "contact_area": "contact_area_error",
    "front": "edge_error",
    "rear": "edge_error",
    "half_width": "edge_error",
    "max_pressure": "max_pressure_error",
    "centre_of_pressure": "centre_of_pressure_error",
}
#: Numbers that say how well and how hard the solver worked.
OF_THE_SOLVER = ("energy_balance", "complementarity", "cells", "spacing", "products")


def number_rows(meaning: dict[str, Meaning], values: dict[str, Any]) -> dict[str, tuple[str, float, str, float | None]]:
    """Return each number by its name with its label, unit and error, without those that are errors or None."""
    return {
        name: (words, values[name], unit, values.get(ERRORS.get(name, "")))
        for name, (unit, words) in meaning.items()
        if values[name] is not None and name not in ERRORS.values()
    }


def labelled_numbers(meaning: dict[str, Meaning], values: dict[str, Any]) -> Dataset:
    """Return numbers with units, long names and the names of their errors (``ancillary_variables``); None: absent."""
    found = dataset((), {name: (values[name], *words) for name, words in meaning.items() if values[name] is not None})
    for name, error in ERRORS.items():
        if name in found and error in found:
            found[name].attrs["ancillary_variables"] = error
    return found


class Level(NamedTuple):
    """Results on one of the nested grids.

    Attributes
    ----------
    cells : int
        Along the window's longer edge.
    pressure_friction, energy_friction : float
        Friction coefficient from the asymmetry of the pressure and from the dissipated energy.
    indentation : float
        m.
    products : int
        With the influence matrix, on this grid alone.
    """

    cells: int
    pressure_friction: float
    energy_friction: float
    indentation: float
    products: int


@dataclass(frozen=True)
class Diagnostics(Shown):
    """Work, convergence and error estimates of a contact.

    Attributes
    ----------
    shape : (int, int)
        Cells of the finest window.
    spacing : float
        Length of a cell along the motion, m.
    collocation_shift : float
        How far behind the cell centres the gap was held at zero, in cells; above zero only where the cells do not
        resolve the shortest memory (see `viscofric.contact.operators.convolution.collocation_shift`).
    complementarity : float
        Largest gap under pressure or overlap without it, at the collocation points, relative to the indentation.
    load : float
        Relative error of the load.
    energy : float
        Energy balance: friction from the pressure's asymmetry less that from the dissipated energy, over the larger of
        them (or over 1e-6 a0/R).
    friction_error : float
        Error estimate of the friction coefficient (absolute), from its changes on the nested grids.
    indentation_error, load_error : float
        Error estimates of the indentation (m) and of the load (N or N/m), from their changes on the nested grids; zero
        for the one that was given.
    edge_error : float
        Error estimate of front, rear and half width, from the changes of the one that changed most, m.
    contact_area_error : float
        Error estimate of the contact area, from its changes on the nested grids, m² or m.
    max_pressure_error : float
        Error estimate of the largest pressure, from its changes on the nested grids, Pa.  Where it is not resolved, at
        least that pressure itself and the one that a layer at the leading edge may hide.
    centre_of_pressure_error : float
        Error estimate of the centre of pressure, from its changes on the nested grids, m.
    peak_resolved : bool
        Whether the largest pressure means something: it lies more than two cells within the contact and has settled to
        2 %.  It has not where the layer at the leading edge is thinner than a cell, at a sharp edge or at a tip.
    levels : tuple of Level
        Results on each nested grid, coarsest first.
    set_changes, linear_iterations, products, ffts : int
        Work on all grids: updates of the contact set, steps of the linear solver, products with the influence
        matrix and two-dimensional real FFTs (of the padded window in products, of the bare one for the
        preconditioner).
    """

    shape: tuple[int, int]
    spacing: float
    collocation_shift: float
    complementarity: float
    load: float
    energy: float
    friction_error: float
    indentation_error: float
    load_error: float
    edge_error: float
    contact_area_error: float
    max_pressure_error: float
    centre_of_pressure_error: float
    peak_resolved: bool
    levels: tuple[Level, ...]
    set_changes: int
    linear_iterations: int
    products: int
    ffts: int

    def _shown(self) -> Rows:
        return (
            ("cells", " × ".join(map(str, self.shape))),
            ("length of a cell", self.spacing, "m"),
            ("error of the friction", self.friction_error),
            ("energy balance", self.energy),
            ("complementarity", self.complementarity),
            ("largest pressure resolved", self.peak_resolved),
            ("nested grids", self.levels),
            ("products", self.products),
        )


@dataclass(frozen=True, eq=False)
class ContactSolution(Warned, Plotted):
    """Steady contact of an indenter moving at a constant velocity over a viscoelastic half-space or layer.

    All in SI units.  Here x is along `direction`, and y to the left of it: the indenter moves towards +x for a positive
    speed, whatever the direction over its own axes.

    Attributes
    ----------
    speed : float
        m/s, as given.
    load : float
        N, or N/m for a line contact: as given, or what a given indentation takes.
    temperature : float or None
        K, as given.
    friction_coefficient : float
        μ = F_t/F_N, with the sign of the speed: of the two below, and of their limits for ever smaller cells, the one
        with the smallest error.
    pressure_friction_coefficient : float
        From the asymmetry of the pressure on the indenter's slope, on the finest grid.
    energy_friction_coefficient : float
        From the energy that the material dissipates, with what the cells at the edge leave out (see
        `viscofric.contact.free.balance`), on the finest grid; with `coulomb` from the work of the pressure on the
        material's displacement, part of which shear gives back, and with what is left out estimated as without shear.
    indentation : float
        δ, m: depth of the indenter's lowest point below the undeformed surface.  In a line contact, where the surface
        far away is infinitely high above it (but for that of a layer under a rigid indenter), below the surface at the
        contact's leading edge.
    contact_area : float
        m², to a fraction of a cell; the width, m, of a line contact.
    front, rear : float
        Distances from the indenter's axis to the leading and to the trailing edge of the contact on the centre
        line (of the whole contact where it does not meet that line), m, positive ahead of and behind the axis
        respectively.
    half_width : float
        Half the largest width of the contact across the motion, m; infinite for a line contact.
    max_pressure : float
        Pa; see `Diagnostics.peak_resolved`.
    x, y : (nx,) and (ny,) array
        Cell centres relative to the indenter's axis, m.
    pressure, displacement : (nx, ny) array
        Pa, and m into the solid, from the same level as the indentation.
    diagnostics : Diagnostics
    warnings : tuple of str
        One note for each assumption that is doubtful.
    geometry : str
        "point" or "line".
    direction : (float, float)
        Of the motion at a positive speed over the indenter's own axes, of length one.
    lateral_friction_coefficient : float
        F_y/F_N, from the asymmetry of the pressure on the finest grid: the force of the indenter on the solid towards
        +y, as F_t is that towards +x.  Zero where the indenter is its own mirror image about the line of motion.
    derivatives : FrictionDerivatives or None
        Of the friction coefficient, where requested.
    coulomb : float
        Coulomb friction coefficient whose shear changed the pressure, as given; not part of `friction_coefficient`.
    heating : ContactHeating or None
        Heat, rise of temperature and isothermal friction, where requested; `temperature` is that without the rise.
    """

    speed: float
    load: float
    temperature: float | None
    friction_coefficient: float
    pressure_friction_coefficient: float
    energy_friction_coefficient: float
    indentation: float
    contact_area: float
    front: float
    rear: float
    half_width: float
    max_pressure: float
    x: Array = field(repr=False)
    y: Array = field(repr=False)
    pressure: Array = field(repr=False)
    displacement: Array = field(repr=False)
    diagnostics: Diagnostics
    warnings: tuple[str, ...] = ()
    geometry: str = "point"
    direction: tuple[float, float] = (1.0, 0.0)
    lateral_friction_coefficient: float = 0.0
    derivatives: FrictionDerivatives | None = None
    coulomb: float = 0.0
    heating: ContactHeating | None = None

    def _shown(self) -> Rows:
        return (
            ("friction coefficient", self.friction_coefficient, "", self.diagnostics.friction_error),
            ("speed", self.speed, "m/s"),
            ("load", self.load, "N/m" if self.geometry == "line" else "N", self.diagnostics.load_error),
            ("temperature", self.temperature, "°C"),
            ("rise of temperature", None if self.heating is None else self.heating.temperature_rise, "K"),
            ("indentation", self.indentation, "m", self.diagnostics.indentation_error),
            ("contact length", self.front + self.rear, "m", 2.0 * self.diagnostics.edge_error),
            ("largest pressure", self.max_pressure, "Pa", self.diagnostics.max_pressure_error),
            ("cells", " × ".join(map(str, self.pressure.shape))),
            ("warnings", self.warnings),
        )

    @property
    def temperature_rise(self) -> float:
        """Rise of temperature by friction at which the contact was solved, K; zero without `heating`."""
        return 0.0 if self.heating is None else self.heating.temperature_rise

    @property
    def centre_of_pressure(self) -> float:
        """Distance from the indenter's axis to where the resultant load acts, along +x, m."""
        return float(self.x @ self.pressure.sum(axis=1)) / float(self.pressure.sum())

    @property
    def friction_force(self) -> float:
        """Friction coefficient times load, N, or N/m for a line contact."""
        return self.friction_coefficient * self.load

    @property
    def friction_error(self) -> float:
        """Error estimate of the friction coefficient, that of the `diagnostics`."""
        return self.diagnostics.friction_error

    @property
    def mean_pressure(self) -> float:
        """Load over contact area, Pa."""
        return self.load / self.contact_area

    @property
    def number_values(self) -> dict[str, float | None]:
        """All numbers and errors by name, SI; None where there is none.  `numbers` has them with units and names."""
        found = self.diagnostics
        # With shear, the pressure's work alone is not what the material dissipates.
        moves = math.isfinite(self.speed) and self.coulomb == 0.0
        return {name: getattr(self, name, getattr(found, name, None)) for name in NUMBERS} | {
            "energy_balance": found.energy,
            "cells": max(found.shape),
            "friction_force_error": found.friction_error * self.load,
            "power": self.friction_force * self.speed if moves else None,
            "power_error": found.friction_error * self.load * abs(self.speed) if moves else None,
        }

    @property
    def number_rows(self) -> dict[str, tuple[str, float, str, float | None]]:
        """All numbers by name: long name, value, unit, and error or None."""
        return number_rows(LINE_NUMBERS if self.geometry == "line" else NUMBERS, self.number_values)

    @property
    def numbers(self) -> Dataset:
        """All numbers and errors with units and long names; ``ancillary_variables`` names the error of each."""
        return labelled_numbers(LINE_NUMBERS if self.geometry == "line" else NUMBERS, self.number_values)

    def to_dataset(self) -> Dataset:
        """Return pressure and displacement over x and y, and all `numbers`; the main results also as attributes."""
        fields = dataset(
            ("x", "y"),
            {
                "pressure": (self.pressure, "Pa", "contact pressure"),
                "displacement": (self.displacement, "m", "displacement into the solid"),
            },
            coordinates={
                "x": (self.x, "m", "position along the motion"),
                "y": (self.y, "m", "position across the motion"),
            },
            attributes={
                "geometry": self.geometry,
                "speed": self.speed,
                "direction": list(self.direction),
                "load": self.load,
                "friction_coefficient": self.friction_coefficient,
                "indentation": self.indentation,
                "coulomb": self.coulomb,
            },
        )
        found = fields.assign(self.numbers.data_vars)
        return found if self.heating is None else found.assign(self.heating.to_dataset().data_vars)
