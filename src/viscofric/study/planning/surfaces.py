"""Cases on rough surfaces that are the same contact seen in other units.

Friction at the shift factors α and b is that at the reference temperature, at the speed αv, under the pressure p/b and
with a surface's modulus E_i/b (Eq. 10): contact area and gap are the same, pressures b times as large.  No other
surface or pressure is alike: roughness has no length that all others are multiples of.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.study.planning.curve import SHARE, STEP, Curve
from viscofric.study.planning.numbers import FRICTION, Node
from viscofric.study.surface_record import SurfaceRecord
from viscofric.study.surface_solving import SurfaceTask

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from viscofric.contact.layers import Layer
    from viscofric.rheology.material import Material
    from viscofric.study.planning.conditions import Rubbers, Settings
    from viscofric.study.planning.curve import Interval
    from viscofric.study.surface_source import SurfaceSource
    from viscofric.study.sweep import SurfaceCase

    Array: TypeAlias = NDArray[np.float64]

# Number of a record, and whether it is interpolated by its logarithm: forces across the motion have either sign.
_COLUMNS = (
    ("friction_coefficient", True),
    ("contact_area_fraction", True),
    ("mean_gap", True),
    ("max_pressure", True),
    ("lateral_friction_coefficient", False),
)
_NAMES = tuple(name for name, _ in _COLUMNS)
_LOGARITHMIC = np.array([logarithmic for _, logarithmic in _COLUMNS])
_PRESSURE = _NAMES.index("max_pressure")
# Of the error that a grid makes, what is not the same in neighbouring contacts.
_RIPPLE = 0.05
_NONE = 0.0  # temperature that is written down for rubbers without a shift, K


@dataclass(frozen=True)
class SurfaceFamily:
    """Contacts of one rubber and one rough surface that differ by αv only.

    Attributes
    ----------
    rubber : (int, int or None)
        Number of the material, and of the member of its posterior.
    surface : MadeSurface or ScannedSurface
    pressure : float
        p/b, Pa.
    direction : float
        rad.
    layer : Layer or None
    surface_modulus : float or None
        E_i/b, Pa.
    surface_poisson_ratio : float
    """

    rubber: tuple[int, int | None]
    surface: SurfaceSource
    pressure: float
    direction: float
    layer: Layer | None
    surface_modulus: float | None
    surface_poisson_ratio: float


@dataclass(frozen=True)
class SurfacePlace:
    """Where a case lies on the curve of its family.

    Attributes
    ----------
    family : SurfaceFamily
    s : float
        ln of αv in m/s.
    b : float
        Vertical shift.
    """

    family: SurfaceFamily
    s: float
    b: float


def surface_place(case: SurfaceCase, rubbers: Rubbers) -> SurfacePlace:
    """Return where a case lies.

    Raises
    ------
    InputError
        If it lies on no curve: its speed is not above zero, or its rubber is not known at its temperature.
    """
    if not 0.0 < case.speed < math.inf:
        raise InputError(f"speed = {case.speed:g} m/s: must be above zero and finite to lie on a friction curve.")
    alpha, b = rubbers.shifts(case)
    family = SurfaceFamily(
        (case.material, case.sample),
        case.surface,
        case.pressure / b,
        case.direction,
        case.layer,
        None if case.surface_modulus is None else case.surface_modulus / b,
        case.surface_poisson_ratio,
    )
    return SurfacePlace(family, math.log(alpha * case.speed), b)


@dataclass(frozen=True, eq=False)
class SurfaceRepresentative:
    """The contacts that are solved for a family: those of its rubber at the reference temperature.

    Attributes
    ----------
    family : SurfaceFamily
    material : Material
    settings : Settings
    """

    family: SurfaceFamily
    material: Material
    settings: Settings

    def curve(self, places: Array) -> Curve:
        """Return the curve on which cases lie, given s of each."""
        return Curve(places, self.settings.accuracy, _LOGARITHMIC)

    def node(self, record: SurfaceRecord) -> Node:
        """Return what was solved as a node of the curve.

        The error of its grid is much the same in all contacts on the surface, but for a ripple, as points come into
        contact one by one.  Where that is more than the accuracy lets be, the curve is refined all the same.
        """
        values, errors = np.array([getattr(record, name) for name in _NAMES]), np.zeros(len(_NAMES))
        errors[FRICTION] = min(_RIPPLE * record.friction_error, SHARE * self.settings.accuracy * abs(values[FRICTION]))
        return Node(record, values, errors)

    def task(self, node: int) -> SurfaceTask:
        """Return what is to be solved at a node of the curve."""
        speed = math.exp(STEP * node)
        reference, seed = self.material.reference, getattr(self.family.surface, "seed", None)
        return SurfaceTask(
            modes=self.material.modes_at(None),
            poisson_ratio=self.material.poisson_ratio,
            surface=self.family.surface,
            speed=speed,
            pressure=self.family.pressure,
            temperature=_NONE if reference is None else reference,
            direction=self.family.direction,
            layer=self.family.layer,
            surface_modulus=self.family.surface_modulus,
            surface_poisson_ratio=self.family.surface_poisson_ratio,
            label=f"friction curve at αv = {speed:.3g} m/s" + ("" if seed is None else f", seed {seed}"),
        )

    def between(
        self, curve: Curve, one: Interval, cases: Sequence[SurfaceCase], places: Sequence[SurfacePlace]
    ) -> Iterator[tuple[int, SurfaceRecord]]:
        """Yield number and record of every case of a closed interval, as if it had been solved."""
        _, found = curve.between(one)
        ends = [curve.node(end).record for end in (one.low, one.high)]
        doubtful = [end for end in ends if end.warnings]
        for row, number in enumerate(one.cases.tolist()):
            case, values = cases[number], found.values[row].copy()
            values[_PRESSURE] *= places[number].b
            added = float(np.hypot(found.from_nodes[row, FRICTION], found.between[row, FRICTION]))
            yield (
                number,
                SurfaceRecord(
                    speed=case.speed,
                    temperature=case.temperature,
                    pressure=case.pressure,
                    **dict(zip(_NAMES, values.tolist(), strict=True)),
                    # An error of the grid does not go away between contacts that have it.
                    friction_error=max(end.friction_error for end in ends) + added,
                    energy_balance=max((end.energy_balance for end in ends), key=abs),
                    complementarity=max(end.complementarity for end in ends),
                    cells=0,
                    products=0,
                    warnings=doubtful[0].warnings if doubtful else (),
                    interpolated=True,
                    interpolation_error=added,
                ),
            )
