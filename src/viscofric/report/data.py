"""Columns that figures draw, from data sets or from the objects of the Python interface."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, cast

import numpy as np

from viscofric.data import Isotherm, IsothermalSweeps, MasterCurve
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.report.results import is_extrapolated, number, values
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.superposition.result import Superposition

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from viscofric.arrays import Array
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.rheology.shifts.vertical_shift import VerticalShift
    from viscofric.rheology.superposition.consistency import SuperpositionCheck

    Sweeps: TypeAlias = IsothermalSweeps | Superposition | Sequence[Isotherm] | xr.Dataset
    Master: TypeAlias = MasterCurve | Superposition | xr.Dataset
    Shifts: TypeAlias = ShiftFactors | Superposition | xr.Dataset
    from viscofric.arrays import Mask

    Friction: TypeAlias = FrictionCurves | xr.Dataset
    ReducedFriction: TypeAlias = FrictionMasterCurve | xr.Dataset


class Moduli(NamedTuple):
    """Measured moduli, one row per reading.

    Parameters
    ----------
    temperature : (n,) array
        K.
    angular_frequency : (n,) array
        rad/s.
    storage, loss : (n,) array
        Pa.
    symbol : str
        E, or G for moduli measured in shear.
    """

    temperature: Array
    angular_frequency: Array
    storage: Array
    loss: Array
    symbol: str = "E"

    @property
    def loss_tangent(self) -> Array:
        """Ratio of loss to storage modulus."""
        return np.asarray(self.loss / self.storage)


class ModulusBand(NamedTuple):
    """Lower and upper bounds of E' and E''.

    Parameters
    ----------
    angular_frequency : (n,) array
        rad/s.
    storage, loss : (2, n) array
        Lower and upper bound, Pa.
    """

    angular_frequency: Array
    storage: Array
    loss: Array


class ShiftTable(NamedTuple):
    """Measured shift factors: K, log10 α, its standard error, and the reference in K."""

    temperature: Array
    log10: Array
    error: Array
    reference: float


def moduli_of_sweeps(source: Sweeps | SuperpositionCheck) -> Moduli:
    """Return the readings of sweeps, isotherm by isotherm; those of a check are without their vertical shift."""
    if hasattr(source, "cole_cole"):
        points = source.cole_cole
        return Moduli(points.temperature, np.arange(float(len(points.x))), points.x, points.y)
    symbol = "G" if isinstance(source, IsothermalSweeps) and source.deformation == "shear" else "E"
    if isinstance(source, (IsothermalSweeps, Superposition)):
        return _of_isotherms(source.isotherms, symbol)
    if isinstance(source, (list, tuple)):
        return _of_isotherms(source, symbol)
    return _of_dataset(cast("xr.Dataset", source))


def moduli_of_master_curve(source: Master) -> Moduli:
    """Return the points of a master curve; their frequencies are reduced."""
    if isinstance(source, Superposition):
        source = source.master_curve
    if isinstance(source, MasterCurve):
        return Moduli(source.temperature, source.angular_frequency, source.storage_modulus, source.loss_modulus)
    return _of_dataset(source)


def shift_table(source: Shifts) -> ShiftTable:
    """Return measured shift factors."""
    if isinstance(source, Superposition):
        source = source.shift_factors
    if isinstance(source, ShiftFactors):
        return ShiftTable(source.temperatures, source.log10_values, source.standard_errors, source.reference)
    return ShiftTable(
        values(source, "temperature"),
        values(source, "log10_shift_factor"),
        np.nan_to_num(values(source, "standard_error")),
        number(source.attrs, "reference_temperature"),
    )


def modulus_band(source: Any, angular_frequency: Array) -> ModulusBand:
    """Return bounds of E(ω).

    Parameters
    ----------
    source : ModulusBand, MaterialSamples, Band or xarray.Dataset
        Samples give their 95 % band; a `Band` holds complex moduli at the given frequencies; a dataset has
        `angular_frequency`, `storage_modulus_lower`, `storage_modulus_upper`, `loss_modulus_lower` and
        `loss_modulus_upper`.
    angular_frequency : (n,) array
        Where samples are asked, rad/s.
    """
    if isinstance(source, ModulusBand):
        return source
    if hasattr(source, "data_vars"):
        bounds = [np.stack([values(source, f"{name}_modulus_{side}") for side in _SIDES]) for name in _MODULI]
        return ModulusBand(values(source, "angular_frequency"), *bounds)
    band = source.modulus_band(angular_frequency) if hasattr(source, "modulus_band") else source
    sides = np.stack([np.asarray(getattr(band, side)) for side in _SIDES])
    if sides.shape != (2, np.size(angular_frequency)):
        raise InputError(
            f"a band of moduli must have lower and upper values for each of {np.size(angular_frequency)} frequencies."
        )
    return ModulusBand(angular_frequency, sides.real, sides.imag)


_SIDES = ("lower", "upper")
_MODULI = ("storage", "loss")


def _of_isotherms(isotherms: Sequence[Isotherm], symbol: str) -> Moduli:
    def column(name: str) -> Array:
        return np.concatenate([np.empty(0), *(getattr(isotherm, name) for isotherm in isotherms)])

    temperature = np.repeat([isotherm.temperature for isotherm in isotherms], [len(each) for each in isotherms])
    return Moduli(
        np.asarray(temperature, dtype=float),
        column("angular_frequency"),
        column("storage_modulus"),
        column("loss_modulus"),
        symbol,
    )


def _of_dataset(source: xr.Dataset) -> Moduli:
    return Moduli(
        values(source, "temperature"),
        values(source, "angular_frequency"),
        values(source, "storage_modulus"),
        values(source, "loss_modulus"),
    )


def law_of(source: xr.Dataset | None) -> ShiftLaw | None:
    """Return the shift law that results hold, or None if they hold none."""
    from viscofric.rheology.cards.native import shift_of

    text = None if source is None else source.attrs.get("constants")
    law: ShiftLaw | None = shift_of(json.loads(text)) if text else None
    return law


def vertical_shift_of(source: xr.Dataset | None) -> VerticalShift | None:
    """Return the vertical shift that results hold, or None if they hold none."""
    from viscofric.rheology.cards import native

    text = None if source is None else source.attrs.get("vertical_shift")
    shift: VerticalShift | None = native.vertical_shift_of(json.loads(text)) if text else None
    return shift


_POINTS_OF_A_LINE = 200
#: Half-width of a 95 % band over the standard error.
LEVEL_95 = 1.959963984540054


class Predicted(NamedTuple):
    """Predicted friction, one row per case.

    Parameters
    ----------
    speed : (n,) array
        m/s.
    temperature, load : (n,) array
        K, N.
    friction : (n,) array
    lower, upper : (n,) array
        Limits of the 95 % band; NaN where there is none.
    extrapolated : (n,) array of bool
        Whether a case rests on frequencies that were not measured.
    """

    speed: Array
    temperature: Array
    load: Array
    friction: Array
    lower: Array
    upper: Array
    extrapolated: Mask

    def rows(self, mask: Mask) -> Predicted:
        """Return the rows of a mask in ascending speed."""
        chosen = np.flatnonzero(mask)
        chosen = chosen[np.argsort(self.speed[chosen], kind="stable")]
        return Predicted._make(column[chosen] for column in self)

    @property
    def has_band(self) -> bool:
        """Whether any row has a band."""
        return bool(np.any(np.isfinite(self.lower) & np.isfinite(self.upper)))


class Measured(NamedTuple):
    """Measured friction coefficients, one row per point: m/s (reduced or not), K, and their scatter."""

    speed: Array
    temperature: Array
    friction: Array
    scatter: Array


def predicted(source: Friction) -> Predicted:
    """Return predicted friction."""
    if isinstance(source, FrictionCurves):
        none = np.full(len(source), np.nan)
        lower, upper = (
            none if side is None else side for side in (source.viscoelastic_lower, source.viscoelastic_upper)
        )
        columns = (source.speed, source.temperature, source.load, source.viscoelastic, lower, upper)
        return Predicted(*columns, np.zeros(len(source), dtype=bool))
    names = ("speed", "temperature", "load", "friction_coefficient", "friction_lower", "friction_upper")
    return Predicted._make([*(values(source, name) for name in names), is_extrapolated(source)])


def measured(source: Friction, kind: str = "viscoelastic") -> Measured:
    """Return measured friction over the speed.

    Parameters
    ----------
    source : FrictionCurves or xarray.Dataset
    kind : {"viscoelastic", "coulomb"}
        NaN throughout where that was not measured.
    """
    if isinstance(source, FrictionCurves):
        none = np.full(len(source), np.nan)
        friction, scatter = (
            none if column is None else column for column in (getattr(source, kind), getattr(source, f"{kind}_scatter"))
        )
        return Measured(source.speed, source.temperature, friction, _bars(scatter))
    columns = (values(source, name) for name in ("speed", "temperature", kind))
    return Measured._make([*columns, _bars(values(source, f"{kind}_scatter"))])


def measured_at_reference(source: ReducedFriction) -> Measured:
    """Return measured friction over the reduced speed."""
    if isinstance(source, FrictionMasterCurve):
        return Measured(source.reduced_speed, source.temperature, source.friction, _bars(source.scatter))
    columns = (values(source, name) for name in ("reduced_speed", "temperature", "viscoelastic"))
    return Measured._make([*columns, _bars(values(source, "viscoelastic_scatter"))])


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
    none = np.zeros(speed.shape, dtype=bool)
    return Predicted(speed, temperature, load, friction, friction - doubt, friction + doubt, none)


def _bars(scatter: Array) -> Array:
    """Lengths of error bars; none where the scatter is not known (infinite in curves, absent in datasets)."""
    return np.where(np.isfinite(scatter), scatter, 0.0)
