"""Fitted, fixed or given shifts: the arguments of `superpose` for α(T), as values at the isotherms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.superposition.common_shifts import CommonShifts, common_shifts
from viscofric.rheology.superposition.gauge import Gauge
from viscofric.rheology.superposition.joined_isotherms import JoinedIsotherms, shown
from viscofric.rheology.superposition.quantity import BOTH
from viscofric.units import positive, to_si

if TYPE_CHECKING:
    from collections.abc import Mapping

    from viscofric.arrays import Array
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.rheology.superposition.quantity import Quantities


#: A temperature is that of an isotherm within this part of the distance to the next one.
NEAR = 0.25
#: Where the reference lies between isotherms, iteration fixes factors relative to its interpolated zero, to this.
EXACT = 1e-9  # decades
REPETITIONS = 12
#: A law close to its pole moves sweeps farther than this, beyond the largest floating-point number.
LARGEST_SHIFT = 100.0  # decades


def held_places(fixed: Mapping[Any, float], temperatures: Array, reference: float) -> dict[int, float]:
    """Return log10 α by the index of the isotherm, of fixed factors by temperature as users write it.

    Raises InputError if there is no such isotherm, one is named twice, or a value contradicts α = 1 at the reference.
    """
    held: dict[int, float] = {}
    for wanted, value in fixed.items():
        kelvin = positive(wanted, "K", "temperature of a fixed shift factor")
        log10_alpha = to_si(value, "dimensionless", f"shift factor fixed at {shown(kelvin)}")
        place = int(np.argmin(np.abs(temperatures - kelvin)))
        gap = float(np.min(np.abs(np.delete(temperatures, place) - temperatures[place])))
        if abs(temperatures[place] - kelvin) > NEAR * gap:
            raise InputError(
                f"a shift factor is fixed at {shown(kelvin)}, where none of the joined isotherms is; the nearest is at "
                f"{shown(temperatures[place])}.",
                code="no-such-temperature",
            )
        if place in held:
            raise InputError(
                f"two shift factors are fixed for the isotherm at {shown(temperatures[place])}; give one.",
                code="given-twice",
            )
        held[place] = log10_alpha
    around = np.flatnonzero(_weights(1.0 / reference, 1.0 / temperatures[::-1])[::-1])
    if len(around) == 1 and held.get(int(around[0]), 0.0) != 0.0:
        raise InputError(
            f"a shift factor is fixed at {shown(reference)}, which is the reference, where log10 α is 0; leave it out.",
            code="is-reference",
        )
    if len(around) > 1 and all(int(place) in held for place in around):
        raise InputError(
            f"the reference, {shown(reference)}, lies between two isotherms whose shift factors are both fixed; "
            "fix one of them only.",
            code="reference-fixed",
        )
    return held


def fitted_shifts(
    joined: JoinedIsotherms[Any], reference: float, held: dict[int, float], free: bool, quantities: Quantities = BOTH
) -> CommonShifts:
    """Fit all shifts except those `held` (log10 α by index); with `free`, vertical shifts too.  See `common_shifts`."""
    temperatures, sweeps = _temperatures(joined), quantities.of(joined.logs)
    around = _gauge(temperatures, reference, {}, free)
    if not held or np.max(around.weights) == 1.0:
        return common_shifts(sweeps, joined.joins, _gauge(temperatures, reference, held, free), quantities)
    # `ShiftFactors` interpolates by a cubic, whose zero differs from that of the straight line in the fit.
    moved = 0.0
    for _ in range(REPETITIONS):
        shifted = {place: value + moved for place, value in held.items()}
        found = common_shifts(sweeps, joined.joins, _gauge(temperatures, reference, shifted, free), quantities)
        table = ShiftFactors(temperatures, found.values, reference)
        before, moved = moved, float(found.values[0] - table.log10_values[0])
        if abs(moved - before) < EXACT:
            break
    return found


def given_shifts(joined: JoinedIsotherms[Any], reference: float, shift: ShiftLaw, free: bool) -> CommonShifts:
    """Return the shifts of a law or table; with `free`, fit vertical ones.

    Raises InputError if a factor is beyond any frequency.
    """
    temperatures = _temperatures(joined)
    values = np.array(shift.log10(temperatures))
    farthest = int(np.argmax(np.abs(values)))
    if abs(values[farthest]) > LARGEST_SHIFT:
        raise InputError(
            f"the given shift factors move the sweep at {shown(temperatures[farthest])} by "
            f"{values[farthest]:.0f} decades from the reference, {shown(reference)}: their law does not hold there.",
            code="out-of-range",
        )
    nothing = np.zeros((len(values), len(values)))
    covariance = nothing
    if isinstance(shift, ShiftFactors):
        inverse = 1.0 / shift.temperatures[::-1]
        weights = np.array([_weights(1.0 / kelvin, inverse)[::-1] for kelvin in temperatures])
        covariance = weights @ shift.covariance @ weights.T
    if not free:
        return CommonShifts(values, covariance, np.zeros(len(values)), nothing, nothing)
    gauge = _gauge(temperatures, reference, dict(enumerate(values)), free)
    found = common_shifts(joined.logs, joined.joins, gauge)
    return CommonShifts(values, covariance, found.vertical, found.vertical_covariance, nothing)


def _temperatures(joined: JoinedIsotherms[Any]) -> Array:
    return np.array([isotherm.temperature for isotherm in joined.isotherms])


def _gauge(temperatures: Array, reference: float, held: dict[int, float], free: bool) -> Gauge:
    inverse = 1.0 / temperatures
    weights = _weights(1.0 / reference, inverse[::-1])[::-1]
    return Gauge(inverse, weights, _weights(reference, temperatures), held, free)


def _weights(at: float, points: Array) -> Array:
    """Return the weights of linear interpolation at one position among ascending points."""
    return np.array([np.interp(at, points, unit) for unit in np.eye(len(points))])
