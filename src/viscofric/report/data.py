"""The one step from a result, or its data set, to the plain columns that figures draw."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.data import Isotherm, IsothermalSweeps, MasterCurve
from viscofric.datasets import DataArray, Dataset, dataset
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.report.results import is_extrapolated, number, shown_error, values
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.superposition.consistency import SuperpositionCheck
from viscofric.rheology.superposition.result import Superposition

#: Sweeps as read, isotherms as joined, or either as a dataset along `reading`.
Sweeps: TypeAlias = "IsothermalSweeps | Superposition | Sequence[Isotherm] | Dataset"
#: A master curve, what it came from, or a dataset along `reading`.
Master: TypeAlias = "MasterCurve | Superposition | Dataset"
#: Shift factors, what they came with, or a dataset along `temperature`.
Shifts: TypeAlias = "ShiftFactors | Superposition | Dataset"
#: Friction coefficients as curves, or a dataset along `case` (predicted) or `point` (measured).
Friction: TypeAlias = "FrictionCurves | Dataset"
#: The same, or all temperatures on one curve.
ReducedFriction: TypeAlias = "FrictionMasterCurve | Dataset"

_POINTS_OF_A_LINE = 200
#: Laws are not drawn this near to a pole, K.
_NEAR_POLE = 1.0
#: Shift factors of the modulus are drawn so far beyond those of friction, K.
_FARTHER = 20.0
_SIDES = ("lower", "upper")
_MEGA = 1e-6


def as_dataset(source: Any, *arguments: Any) -> Dataset:
    """Return a data set as it is, or the one that a result makes of itself (with these arguments)."""
    if isinstance(source, FrictionCurves):
        return source.points_dataset()
    if {"temperature", "speed"} <= set(getattr(source, "dims", ())) and "viscoelastic" in source:
        source = source.stack(point=tuple(source.dims)).reset_index("point")  # friction curves on a grid
    found: Dataset = source if hasattr(source, "data_vars") else source.to_dataset(*arguments)
    return found


class Moduli(NamedTuple):
    """Moduli, one row per reading."""

    temperature: Array  # (n,), K
    angular_frequency: Array  # (n,), rad/s
    storage: Array  # (n,), MPa
    loss: Array  # (n,), MPa
    symbol: str  # E, or G for moduli measured in shear
    reference: float  # K; NaN where none is stated

    @property
    def loss_tangent(self) -> Array:
        """Ratio of loss to storage modulus."""
        return np.asarray(self.loss / self.storage)


def moduli_of_sweeps(source: Sweeps | SuperpositionCheck) -> Moduli:
    """Return the readings of sweeps, isotherm by isotherm; those of a check are without their vertical shift."""
    if hasattr(source, "data_vars"):
        return moduli(source)
    if isinstance(source, SuperpositionCheck):
        order = np.arange(float(len(source.temperature)))  # of the frequencies
        storage, loss = _MEGA * source.storage_modulus, _MEGA * source.loss_modulus
        return Moduli(source.temperature, order, storage, loss, "E", np.nan)
    isotherms: Any = getattr(source, "isotherms", source)
    deformation: Any = getattr(source, "deformation", "tension")
    return moduli(IsothermalSweeps(tuple(isotherms), deformation))


def moduli_of_master_curve(source: Master) -> Moduli:
    """Return the points of a master curve; their frequencies are reduced."""
    return moduli(getattr(source, "master_curve", source))


def moduli(source: Any, prefix: str = "") -> Moduli:
    """Return moduli of a data set, those whose names begin with a prefix."""
    data = as_dataset(source)
    return Moduli(
        values(data, "temperature"),
        values(data, "angular_frequency"),
        _MEGA * values(data, f"{prefix}storage_modulus"),
        _MEGA * values(data, f"{prefix}loss_modulus"),
        "G" if data.attrs.get("deformation") == "shear" else "E",
        number(data.attrs, "reference_temperature"),
    )


class ModulusBand(NamedTuple):
    """Lower and upper bounds (2, n) of E' and E'' (MPa) over the angular frequency (n,), rad/s."""

    angular_frequency: Array
    storage: Array
    loss: Array


def modulus_band(source: Any, angular_frequency: Array) -> ModulusBand:
    """Return bounds of E(ω): those of a dataset, or of an object (such as samples) at angular frequencies (n,)."""
    data = as_dataset(source, angular_frequency)
    storage, loss = (
        _MEGA * np.stack([values(data, f"{name}_modulus_{side}") for side in _SIDES]) for name in ("storage", "loss")
    )
    return ModulusBand(values(data, "angular_frequency"), storage, loss)


class ShiftTable(NamedTuple):
    """Shift factors (n,): temperature (K), log10 α, its standard error (zero if unknown), and the reference (K)."""

    temperature: Array
    log10: Array
    error: Array
    reference: float


def shift_table(source: Shifts) -> ShiftTable:
    """Return shift factors."""
    data = as_dataset(source)
    return ShiftTable(
        values(data, "temperature"),
        values(data, "log10_shift_factor"),
        np.nan_to_num(values(data, "standard_error")),
        number(data.attrs, "reference_temperature"),
    )


def beside_friction(factors: Dataset, temperatures: Array) -> Dataset:
    """Leave out what lies far from temperatures of friction (K): a rubber's sweeps reach farther."""
    kelvin = values(factors, "temperature")
    near = (kelvin >= temperatures.min() - _FARTHER) & (kelvin <= temperatures.max() + _FARTHER)
    return factors.isel(temperature=near)


def law_of(source: Dataset | None) -> ShiftLaw | None:
    """Return the shift law that results hold, or None if they hold none."""
    from viscofric.rheology.cards.native import shift_of

    text = None if source is None else source.attrs.get("constants")
    law: ShiftLaw | None = shift_of(json.loads(text)) if text else None
    return law


def law_line(law: ShiftLaw, low: float, high: float, points: int = _POINTS_OF_A_LINE) -> Dataset:
    """Return a law between two temperatures (K) as a data set along `temperature`, where it is valid."""
    line = np.linspace(low, high, points)
    return law.to_dataset(line[law.valid_at(line, above_pole=_NEAR_POLE)])


def law_residuals(law: ShiftLaw, table: ShiftTable) -> Dataset:
    """Return log10 of measured over the law's α along `temperature` (K), where the law is valid."""
    valid = law.valid_at(table.temperature, above_pole=_NEAR_POLE)
    kelvin = table.temperature[valid]
    left = table.log10[valid] - np.asarray(law.log10(kelvin))
    return dataset(
        "temperature",
        {"log10_residual": (left, "1", "decadic logarithm of the measured over the law's shift factor")},
        coordinates={"temperature": (kelvin, "K", "temperature")},
    )


class Predicted(NamedTuple):
    """Predicted friction, one row per case."""

    speed: Array  # (n,), m/s
    temperature: Array  # (n,), K
    load: Array  # (n,), N; 0 under a mean pressure, which has no load
    friction: Array  # (n,)
    lower: Array  # (n,), limit of the 95 % band; NaN where there is none
    upper: Array  # likewise
    extrapolated: Mask  # (n,): whether a case rests on frequencies that were not measured
    error: Array  # (n,), numerical error where it can be seen in a figure; NaN elsewhere

    def rows(self, mask: Mask | bool = True) -> Predicted:
        """Return the rows of a mask, or all, in ascending speed."""
        chosen = np.flatnonzero(np.broadcast_to(mask, self.speed.shape))
        chosen = chosen[np.argsort(self.speed[chosen], kind="stable")]
        return Predicted._make(column[chosen] for column in self)

    @property
    def has_band(self) -> bool:
        """Whether any row has a band."""
        return bool(np.any(np.isfinite(self.lower) & np.isfinite(self.upper)))


def predicted(source: Friction) -> Predicted:
    """Return predicted friction."""
    data = as_dataset(source)
    of_study = "friction_coefficient" in data.variables
    friction = ("friction_coefficient", "friction_lower", "friction_upper", "friction_error")
    if not of_study:
        friction = ("viscoelastic", "viscoelastic_lower", "viscoelastic_upper", "viscoelastic_error")
    *columns, error = [values(data, name) for name in ("speed", "temperature", "load", *friction)]
    columns[2] = np.nan_to_num(columns[2])  # rows are chosen by their load
    return Predicted._make([*columns, is_extrapolated(data), shown_error(values(data, friction[0]), error)])


class Measured(NamedTuple):
    """Measured friction coefficients (n,): speed (m/s, reduced or not), temperature (K), friction and scatter."""

    speed: Array
    temperature: Array
    friction: Array
    scatter: Array


def measured(source: Friction | ReducedFriction, kind: str = "viscoelastic", speed: str = "speed") -> Measured:
    """Return measured friction over the speed; NaN throughout where that kind was not measured."""
    data = as_dataset(source)
    scatter = values(data, f"{kind}_scatter")  # infinite or absent where it is not known
    bars = np.where(np.isfinite(scatter), scatter, 0.0)
    return Measured(values(data, speed), values(data, "temperature"), values(data, kind), bars)


def measured_line(source: ReducedFriction) -> Predicted | None:
    """Return the smooth line through a friction master curve, with the 95 % band that the points' errors leave."""
    if not isinstance(source, FrictionMasterCurve):
        return None
    stretches = [np.geomspace(*ends, _POINTS_OF_A_LINE) for ends in source.stretches if ends[1] > ends[0]]
    if not stretches:
        return None
    # A row without friction between two stretches keeps the line from bridging them.
    gaps = [np.array([first[-1]]) for first in stretches[:-1]]
    speed = np.concatenate([stretches[0], *(part for pair in zip(gaps, stretches[1:], strict=True) for part in pair)])
    friction, error = np.asarray(source(speed)), np.asarray(source.standard_error(speed))
    gap = _POINTS_OF_A_LINE + np.arange(len(gaps)) * (_POINTS_OF_A_LINE + 1)
    friction[gap] = np.nan
    doubt = np.where(np.isfinite(error), LEVEL_95 * error, np.nan)
    temperature, load = np.full(speed.shape, source.reference), np.full(speed.shape, source.load)
    none, no_error = np.zeros(speed.shape, dtype=bool), np.full(speed.shape, np.nan)
    return Predicted(speed, temperature, load, friction, friction - doubt, friction + doubt, none, no_error)


#: Columns of a contact over time that are drawn together, and what they are called: its size …
SIZES = {
    "contact_radius": "radius",
    "front": "ahead of the axis",
    "rear": "behind the axis",
    "half_width": "half-width across",
}
#: … and its energies.
ENERGIES = {"work": "work on the material", "stored": "stored", "dissipated": "dissipated"}


def position_along(data: Dataset) -> Array:
    """Return the position along the direction of the friction force, (n,) in m."""
    x, y = np.asarray(data.attrs["direction"], dtype=float)
    return np.asarray(x * data["position_x"] + y * data["position_y"])


def distance(data: Dataset) -> Array:
    """Return the distance along the path since the start, (n,) in m."""
    steps = np.hypot(np.diff(np.asarray(data["position_x"])), np.diff(np.asarray(data["position_y"])))
    return np.concatenate([[0.0], np.cumsum(steps)])


def moves(data: Dataset) -> bool:
    """Return whether the position ever changes."""
    return bool(distance(data)[-1] > 0.0)


def returns(data: Dataset) -> bool:
    """Return whether the indenter comes back along its path, so that friction against position is a loop."""
    steps = np.diff(position_along(data))
    return bool(np.any(steps > 0.0) and np.any(steps < 0.0))


def pressure_along(field: DataArray, along: str = "x", *, highest: bool = False) -> tuple[Array, Array]:
    """Return places along the motion (m) and the pressure there (Pa), through the axis or where it is highest."""
    if field.dims == ("r",):
        r, pressure = field["r"].values, field.values
        return np.concatenate([-r[::-1], r]), np.concatenate([pressure[::-1], pressure])
    for across in set(field.dims) - {along}:
        rest = field.max(along).values if highest else -np.abs(field[across].values)
        field = field.isel({across: int(np.argmax(rest))})
    return field[along].values, field.values
