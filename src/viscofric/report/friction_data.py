"""What figures of friction draw, as plain columns, taken from a study's datasets or from friction curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.report.doubts import is_extrapolated
from viscofric.report.results import values
from viscofric.report.shift_figures import LEVEL_95

if TYPE_CHECKING:
    import xarray as xr

    from viscofric.arrays import Array, Mask

    #: Friction coefficients as curves, or a dataset along `case` (predicted) or `point` (measured).
    Friction: TypeAlias = FrictionCurves | xr.Dataset
    #: The same, or all temperatures on one curve.
    ReducedFriction: TypeAlias = FrictionMasterCurve | xr.Dataset

_POINTS_OF_A_LINE = 200


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
