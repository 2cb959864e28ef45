"""Contacts of a rough surface, and their similarity.

Friction at the shift factors α and b is that at the reference temperature, at the speed αv, under the pressure p/b and
with a surface's modulus E_i/b (Eq. 10): contact area and gap are the same, pressures b times as large.  Different
surfaces and pressures are not similar.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from viscofric.arrays import Mask
from viscofric.contact.bodies import Layer
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.friction.cases.case import Case, Place, Rubbers, Settings
from viscofric.friction.cases.interpolation import FRICTION, SHARE, Between, Node
from viscofric.friction.cases.record import Record, surface_record
from viscofric.friction.cases.solving import solve_surface, surface_solution
from viscofric.friction.cases.surfaces import SurfaceSource, surface_of

# Number of a record, and whether it is interpolated by its logarithm: forces across the motion have either sign.
_COLUMNS = (
    ("friction_coefficient", True),
    ("contact_area_fraction", True),
    ("corrected_area_fraction", True),
    ("mean_gap", True),
    ("max_pressure", True),
    ("lateral_friction_coefficient", False),
)
_NAMES = tuple(name for name, _ in _COLUMNS)
_LOGARITHMIC = np.array([logarithmic for _, logarithmic in _COLUMNS])
_PRESSURE, _LATERAL = _NAMES.index("max_pressure"), _NAMES.index("lateral_friction_coefficient")
# Part of the discretisation error that differs between neighbouring contacts.
_RIPPLE = 0.05


@dataclass(frozen=True, slots=True)
class SurfaceCase(Case):
    """One contact of a rough surface, SI; see `Case`."""

    material: int
    surface: SurfaceSource
    temperature: float
    speed: float
    pressure: float  # mean, Pa
    direction: float = 0.0  # of the motion, from x towards y, rad
    layer: Layer | None = None
    modulus: float | None = None  # of an elastic surface, Pa; None: rigid
    poisson_ratio: float = 0.3
    sample: int | None = None

    FREQUENCIES: ClassVar[str] = "some reduced frequencies 2παv/λ of the surface's waves lie"
    HAS_MASTER_CURVE: ClassVar[bool] = False
    LOGARITHMIC: ClassVar[Mask] = _LOGARITHMIC
    geometry: ClassVar[str] = "rough"
    cost: ClassVar[str] = "surface"

    @property
    def points(self) -> int:
        """Number of points of its surface."""
        return math.prod(self.surface.shape)

    @property
    def body_label(self) -> str:
        """The seed of its surface, after a comma."""
        seed = getattr(self.surface, "seed", None)
        return "" if seed is None else f", seed {seed}"

    def lengths(self, record: Record) -> tuple[float, float]:
        """Return the shortest and the longest wavelength, over 2π."""
        shortest, longest = self.surface.wavelengths
        return shortest / (2.0 * math.pi), longest / (2.0 * math.pi)

    def reach(self, record: Record) -> float:
        """Return the highest pressure."""
        return float(record.max_pressure)

    def solving(self, settings: Settings) -> tuple[Callable[..., Record], dict[str, Any]]:
        """Return the function that solves it, and its arguments; see `Case.solving`."""
        return solve_surface, {"surface": self.surface, "direction": self.direction, **self._contact}

    def solution(self, rubbers: Rubbers, accuracy: float, most_points: int | None = None) -> PeriodicSolution:
        """Solve the contact and return the whole solution; see `solve_periodic`."""
        # The surface's grid sets the accuracy; a surface with more than `most_points` along an axis is coarsened.
        surface = surface_of(self.surface)
        every = 1 if most_points is None else -(-max(surface.shape) // most_points)
        if every > 1:
            (likeness,) = surface.coarser([(max(1, surface.shape[0] // every), max(1, surface.shape[1] // every))])
            surface = PeriodicSurface(likeness.z, likeness.spacing)
        ratio = rubbers.of(self).poisson_ratio
        return surface_solution(rubbers.modes(self), ratio, surface, self.direction, **self._contact)

    @property
    def _contact(self) -> dict[str, Any]:
        return {
            "speed": self.speed,
            "pressure": self.pressure,
            "layer": self.layer,
            "indenter_modulus": self.modulus,
            "indenter_poisson_ratio": self.poisson_ratio,
        }

    def record(self, solution: PeriodicSolution) -> Record:
        """Return the stored part of its solution."""
        return surface_record(solution, self.temperature)

    def place(self, rubbers: Rubbers) -> Place:
        """Return its place on the curve of its family; see `Case.place`."""
        self.insist_on_motion()
        alpha, b = rubbers.shifts(self)
        modulus = None if self.modulus is None else self.modulus / b
        family = replace(
            self, temperature=rubbers.reference(self), speed=1.0, pressure=self.pressure / b, modulus=modulus
        )
        return Place(family, math.log(alpha * self.speed), b, math.log(alpha))

    def node_label(self, ratio: float) -> str:
        """Return the label of a family's contact."""
        return f"friction curve at αv = {ratio:.3g} m/s{self.body_label}"

    def node(self, record: Record, rubbers: Rubbers, accuracy: float) -> Node:
        """Return a solved contact of a family as a node of its curve."""
        # The discretisation error is nearly the same in all contacts on the surface, apart from a ripple as points come
        # into contact one by one. If the ripple exceeds what the accuracy allows, the curve is still refined.
        values, errors = np.array([getattr(record, name) for name in _NAMES]), np.zeros(len(_NAMES))
        errors[FRICTION] = min(_RIPPLE * record.friction_error, SHARE * accuracy * abs(values[FRICTION]))
        return Node(record, values, errors)

    def interpolated(
        self, between: Between, cases: Sequence[Any], places: Sequence[Place], rubbers: Rubbers
    ) -> Iterator[tuple[int, Record]]:
        """Yield number and record of every case between two nodes, as if it had been solved."""
        found, ends, shared = between.found, between.ends, between.shared
        doubtful = [end for end in ends if end.warnings]
        for row, number in enumerate(between.cases):
            case, values = cases[number], found.values[row].copy()
            values[_PRESSURE] *= places[number].b
            every = np.hypot(found.from_nodes[row], found.between[row])
            added, across = float(every[FRICTION]), float(every[_LATERAL])
            yield (
                number,
                Record.of(
                    speed=case.speed,
                    temperature=case.temperature,
                    pressure=case.pressure,
                    **dict(zip(_NAMES, values.tolist(), strict=True)),
                    # The discretisation error of the neighbours remains between them.
                    friction_error=max(end.friction_error for end in ends) + added,
                    lateral_friction_error=max(end.lateral_friction_error for end in ends) + across,
                    interpolation_error=added,
                    warnings=doubtful[0].warnings if doubtful else (),
                    **shared,
                ),
            )
