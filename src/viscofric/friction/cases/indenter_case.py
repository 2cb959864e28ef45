"""Contacts of an indenter, and their similarity.

Friction at the shift factors α and b is that at the reference temperature, at the speed αv, under the load F/b and
with an indenter's modulus E_i/b (Eq. 10).  A paraboloid or a cone on a half-space has the same shape at every size, so
that load and radius only set the units: over a unit of slope, friction depends on αv over a length alone, and so do
all other numbers over their units (see `viscofric.contact.free.scale`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from viscofric.arrays import Array, Mask, lagrange
from viscofric.contact.bodies import Layer, contact_notes, indenter_compliance
from viscofric.contact.free.geometry import LINE
from viscofric.contact.free.grids import Extent
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import LOW_SLOPE, Ball, Cylinder, Ellipsoid
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.errors import InputError
from viscofric.friction.cases.case import Case, Place, Rubbers, Settings
from viscofric.friction.cases.interpolation import FRICTION, Between, Interpolated, Node
from viscofric.friction.cases.record import Failure, Record, indenter_record
from viscofric.friction.cases.solving import solve_indenter
from viscofric.friction.sensitivity import ROUNDING, ComplianceSensitivity, log_times
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

# Interpolated number, that of its error (the centre of pressure has none of its own), and whether it is interpolated by
# its logarithm: front and rear may change their sign.
_COLUMNS = (
    ("friction_coefficient", "friction_error", True),
    ("indentation", "indentation_error", True),
    ("contact_area", "contact_area_error", True),
    ("max_pressure", "max_pressure_error", True),
    ("half_width", "edge_error", True),
    ("centre_of_pressure", None, True),
    ("front", "edge_error", False),
    ("rear", "edge_error", False),
)
NAMES = tuple(name for name, _, _ in _COLUMNS)
ERRORS = tuple(error for _, error, _ in _COLUMNS)
LOGARITHMIC = np.array([logarithmic for *_, logarithmic in _COLUMNS])


@dataclass(frozen=True, slots=True)
class IndenterCase(Case):
    """One contact of an indenter, SI; see `Case`."""

    material: int
    indenter: Indenter
    temperature: float
    speed: float
    load: float  # N; N/m for a cylinder
    layer: Layer | None = None
    modulus: float | None = None  # of an elastic indenter, Pa; None: rigid
    poisson_ratio: float = 0.3
    sample: int | None = None

    FREQUENCIES: ClassVar[str] = "the contact's reduced frequency αv/a lies"
    HAS_MASTER_CURVE: ClassVar[bool] = True
    LOGARITHMIC: ClassVar[Mask] = LOGARITHMIC

    @property
    def geometry(self) -> str:
        """Geometry of the contact: "point" or "line"."""
        return "line" if self.indenter.geometry is LINE else "point"

    @property
    def cost(self) -> str:
        """Its kind in the estimates of computing time."""
        if self.layer is not None:
            return "layer"
        match self.indenter:
            case Cylinder():
                return "line"
            case Ball() | Ellipsoid():
                return "paraboloid"
        return "other"

    def lengths(self, record: Record) -> tuple[float, float]:
        """Return half the contact's length twice: there is one frequency."""
        half = 0.5 * (record.front + record.rear)
        return half, half

    def reach(self, record: Record) -> float:
        """Return the extent of the contact over the size of the indenter."""
        farthest = max(size for size in (record.front, record.rear, record.half_width) if np.isfinite(size))
        size = self.indenter.reach
        return float(farthest / size) if np.isfinite(size) else float(farthest)

    def solving(self, settings: Settings) -> tuple[Callable[..., Record], dict[str, Any]]:
        """Return the function that solves it, and its arguments; see `Case.solving`."""
        sensitive = settings.sensitive and self.sample is None
        return solve_indenter, self._contact(settings.accuracy) | {"sensitive": sensitive}

    def solution(self, rubbers: Rubbers, accuracy: float, most_points: int | None = None) -> ContactSolution:
        """Solve the contact and return the whole solution; see `solve_steady`."""
        rubber = Material(rubbers.modes(self), poisson_ratio=rubbers.of(self).poisson_ratio)
        return solve_steady(rubber, **self._contact(accuracy))

    def _contact(self, accuracy: float) -> dict[str, Any]:
        return {
            "indenter": self.indenter,
            "speed": self.speed,
            "load": self.load,
            "accuracy": accuracy,
            "layer": self.layer,
            "indenter_modulus": self.modulus,
            "indenter_poisson_ratio": self.poisson_ratio,
        }

    def record(self, solution: ContactSolution) -> Record:
        """Return the stored part of its solution."""
        return indenter_record(solution, self.temperature)

    def place(self, rubbers: Rubbers) -> Place:
        """Return its place on the curve of its family; see `Case.place`."""
        self.insist_on_motion()
        alpha, b = rubbers.shifts(self)
        indenter, load = None if self.layer is not None else self.indenter.similar(), self.load / b
        modulus = None if self.modulus is None else self.modulus / b
        stiffness = _stiffness(rubbers.of(self), modulus, self.poisson_ratio)
        scale = rubbers.scale(self.indenter, stiffness, load)
        if indenter is None:
            indenter, own = self.indenter, scale
        else:
            load = indenter.geometry.parabolic_load * rubbers.scale_at(indenter, stiffness, LOW_SLOPE**2).force
            own = rubbers.scale(indenter, stiffness, load)
        at_zero = {"temperature": rubbers.reference(self), "speed": own.length, "load": load, "modulus": modulus}
        family = replace(self, indenter=indenter, **at_zero)  # type: ignore[arg-type]
        return Place(family, math.log(alpha * self.speed / scale.length), b, math.log(alpha), scale)

    def node_label(self, ratio: float) -> str:
        """Return the label of a family's contact."""
        return f"friction curve at αv/a = {ratio:.3g} 1/s"

    def node(self, record: Record, rubbers: Rubbers, accuracy: float) -> Node:
        """Return a solved contact of a family as a node of its curve."""
        return node_of(record, self._units(rubbers))

    def _units(self, rubbers: Rubbers) -> Scale:
        """Return the units of a family's contacts."""
        return rubbers.scale(self.indenter, _stiffness(rubbers.of(self), self.modulus, self.poisson_ratio), self.load)

    def interpolated(
        self, between: Between, cases: Sequence[Any], places: Sequence[Place], rubbers: Rubbers
    ) -> Iterator[tuple[int, Record | Failure]]:
        """Yield the records of the cases of a closed interval; failures where they would be wider than the indenter."""
        here, ends = [places[number] for number in between.cases], between.ends
        modes, units = rubbers.modes(self, at_reference=True), self._units(rubbers)
        sensitivities = _sensitivities(between.nodes, here, modes, units)
        shared = between.shared
        for row, (number, place) in enumerate(zip(between.cases, here, strict=True)):
            case, numbers = cases[number], _with_units(between.found, row, place)
            if math.isinf(ends[0].half_width):
                numbers["half_width"] = math.inf
            contact = _extent(numbers)
            try:
                case.indenter.check(contact, f"under {case.load:g} {case.indenter.geometry.load_unit}")
            except InputError as error:
                yield number, Failure.of(error, case.label)
                continue
            doubts = contact_notes(
                case.indenter, contact, indentation=numbers["indentation"], load=case.load, speed=case.speed,
                modes=rubbers.modes(case), poisson_ratio=rubbers.of(case).poisson_ratio, layer=case.layer,
            )  # fmt: skip
            known = {"speed": case.speed, "temperature": case.temperature, "load": case.load}
            record = Record.of(**(known | numbers | shared), warnings=doubts)
            yield number, _complete(record, sensitivities[row], modes, place) if sensitivities else record


def node_of(record: Record, scale: Scale) -> Node:
    """Return a solved contact as a node: its numbers over their units."""
    units = units_of(scale)
    values = np.array([getattr(record, name) for name in NAMES]) / units
    errors = np.array([0.0 if name is None else getattr(record, name) for name in ERRORS]) / units
    # A line contact has no width, and no error of it.
    return Node(record, np.where(np.isfinite(values), values, 1.0), errors)


def units_of(scale: Scale, b: float = 1.0) -> Array:
    """Return the units of all columns, (columns,), those of pressures b times as large."""
    length = scale.length
    return np.array(
        [scale.slope, scale.depth, scale.area, b * scale.pressure, length, length, length, length], dtype=float
    )


def _stiffness(material: Material, modulus: float | None, poisson_ratio: float) -> float:
    """Return the modulus of the relaxed contact at the reference temperature, Pa; `modulus` None: rigid indenter."""
    compliance = indenter_compliance(modulus, poisson_ratio)
    return 1.0 / ((1.0 - material.poisson_ratio**2) / material.modes_at(None).E0 + compliance)


def _with_units(found: Interpolated, row: int, place: Place) -> dict[str, float]:
    """Return the numbers of a case and their errors, with units."""
    units = units_of(place.units, place.b)
    numbers = dict(zip(NAMES, (units * found.values[row]).tolist(), strict=True))
    errors = units * np.hypot(found.from_nodes[row], found.between[row])
    for name, error in zip(ERRORS, errors.tolist(), strict=True):
        if name is not None:
            numbers[name] = max(numbers.get(name, 0.0), error)
    return numbers | {"interpolation_error": float(units[FRICTION] * found.between[row, FRICTION])}


def _extent(numbers: dict[str, float]) -> Extent:
    side = numbers["half_width"]
    return Extent(numbers["rear"], numbers["front"], 0.0 if math.isinf(side) else side)


def _sensitivities(
    nodes: Sequence[tuple[float, Record]], places: Sequence[Place], modes: RetardationSpectrum, units: Scale
) -> list[ComplianceSensitivity]:
    """Interpolate the derivatives of friction between nodes, (s, record), in their `units`; none if a node has none."""
    # `modes` are those at the reference temperature, where all nodes are. Without units, g is a function of vτ over the
    # length of the contact that varies smoothly along the curve. Numbers of a contact itself are left to `_complete`.
    found = [record.sensitivity for _, record in nodes if record.sensitivity is not None]
    if len(found) < len(nodes):
        return []
    at = np.array([s for s, _ in nodes])
    shares = lagrange(at, np.array([place.s for place in places]))
    log_tau = [log_times(modes, np.exp(-place.s)) for place in places]
    # vτ over the length is the same in the case and in the node.
    contact = np.concatenate([one + place.s for one, place in zip(log_tau, places, strict=True)])
    table = np.array([one.at(contact - s) for one, s in zip(found, at, strict=True)])
    slopes = np.split(table, np.cumsum([len(one) for one in log_tau])[:-1], axis=1)
    glass, load = (shares @ np.array([getattr(one, name) for one in found]) for name in ("glass", "load"))
    each = []
    for row, place in enumerate(places):
        own, lean = place.units, place.units.slope / units.slope
        factor = own.slope * own.stiffness * place.b / (units.slope * units.stiffness)
        slope, glassy = factor * (shares[row] @ slopes[row]), float(factor * glass[row])
        times = log_tau[row] + place.log_alpha
        each.append(ComplianceSensitivity(0.0, 0.0, times, slope, glassy, float(lean * load[row]), 0.0))
    return each


def _complete(record: Record, part: ComplianceSensitivity, modes: RetardationSpectrum, place: Place) -> Record:
    """Return the record of a case with its derivatives."""
    # From the sensitivity itself, so that the material's own modes change nothing.
    own = _values_at(np.log(modes.tau) + place.log_alpha, part)
    compliance_part = (float(own @ modes.C) + part.glass / modes.E_inf) / place.b
    friction, frequency = record.friction_coefficient, record.frequency
    found = replace(part, friction=friction, compliance_part=compliance_part, frequency=frequency)
    return replace(record, sensitivity=found)


def _values_at(log_tau: Array, sensitivity: ComplianceSensitivity) -> Array:
    """Return g at known times if possible, without interpolation."""
    rows = np.minimum(np.searchsorted(sensitivity.log_tau, log_tau - ROUNDING), len(sensitivity.log_tau) - 1)
    if np.all(np.abs(sensitivity.log_tau[rows] - log_tau) <= ROUNDING):
        return sensitivity.slope[rows]
    return sensitivity.at(log_tau)
