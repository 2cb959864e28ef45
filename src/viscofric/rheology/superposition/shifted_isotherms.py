"""Isotherms of any kind, given by logarithms of their quantities, joined and shifted, with notes on them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic

import numpy as np

from viscofric.data import Isotherm
from viscofric.errors import InputError
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.superposition.held_shifts import fitted_shifts, given_shifts, held_places
from viscofric.rheology.superposition.joined_isotherms import (
    JoinedIsotherms,
    Tested,
    as_given,
    join_isotherms,
    shown,
    usable,
)
from viscofric.rheology.superposition.overlap import LogSweep, OverlapQuality, overlap_quality
from viscofric.rheology.superposition.remarks import (
    badly_given,
    errors_of_steps,
    joined_by_pairs,
    steps_at,
    unidentified_places,
    unidentified_steps,
    unidentified_vertical,
    without_overlap,
)
from viscofric.rheology.superposition.van_gurp_palmen import drift, neighbour_distances
from viscofric.units import kelvin_hint, shown_celsius

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.arrays import Array
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.rheology.superposition.common_shifts import CommonShifts
    from viscofric.rheology.superposition.isotherm_offsets import IsothermOffsets
    from viscofric.rheology.superposition.quantity import Quantities
    from viscofric.step_tests import StepTest


#: Weight of the alternative model, with a free vertical shift or without one, where isotherms drift.
OTHER_MODEL = 0.5


@dataclass(frozen=True, eq=False)
class ShiftedIsotherms(Generic[Tested]):
    """Isotherms of any kind with the shifts found or given, and notes on them."""

    joined: JoinedIsotherms[Tested]  # free of the vertical shift
    factors: ShiftFactors
    quality: OverlapQuality
    notes: tuple[str, ...]
    vertical: VerticalShift | None
    cross: Array | None  # of log10 α with log10 b, where b was fitted
    offsets: IsothermOffsets | None
    unidentified: tuple[tuple[float, float], ...]


def shifted_isotherms(
    isotherms: tuple[Tested, ...],
    logs: list[LogSweep],
    kelvin: float,
    known: VerticalShift | None,
    free: bool,
    shift: ShiftLaw | None,
    fixed: Mapping[Any, float] | None,
    quantities: Quantities,
) -> ShiftedIsotherms[Tested]:
    """Join and shift isotherms given by their logarithms; `known` is b(T) where it is not fitted."""
    usable(isotherms)
    levels = [0.0 if known is None else known.log10(isotherm.temperature) for isotherm in isotherms]
    logs = [replace(one, moduli=one.moduli - by) for one, by in zip(logs, levels, strict=True)]
    joined: JoinedIsotherms[Tested]
    if shift is None:
        joined = join_isotherms(isotherms, logs, quantities)
    else:
        joined = as_given(isotherms, logs, shift.at_reference(kelvin))
    temperatures = np.array([isotherm.temperature for isotherm in joined.isotherms])
    if not temperatures[0] - NOMINAL <= kelvin <= temperatures[-1] + NOMINAL:
        raise InputError(
            f"reference = {shown_celsius(kelvin)} °C lies outside the joined isotherms, "
            f"{shown(temperatures[0])} to {shown(temperatures[-1])}{kelvin_hint(kelvin)}. "
            f"{' '.join(joined.notes)}".rstrip(),
            code="reference-outside",
        )
    if shift is None:
        held = held_places(fixed or {}, temperatures, kelvin)
        found = fitted_shifts(joined, kelvin, held, free, quantities)
        log10_b = found.vertical if known is None else np.asarray(known.log10(temperatures))
        if quantities.by != "loss-tangent" and _drifts(joined.isotherms, log10_b):
            found = _between_models(found, fitted_shifts(joined, kelvin, held, not free, quantities), free)
    else:
        found = given_shifts(joined, kelvin, shift.at_reference(kelvin), free)
    factors = ShiftFactors(temperatures, found.values, kelvin, found.covariance)
    unidentified: tuple[tuple[float, float], ...] = ()
    notes = [*joined.notes, *joined.disagreements(given=shift is not None)]
    if shift is None:
        notes += joined_by_pairs(temperatures, found.parted, len(quantities.weights))
        places = unidentified_places(found.values, found.covariance)
        unidentified = steps_at(temperatures, places)
        notes += unidentified_steps(unidentified, max(errors_of_steps(found.covariance)[places], default=0.0))
    if free:
        known = VerticalShiftFactors(temperatures, found.vertical, kelvin, found.vertical_covariance)
        joined = joined.less(known.log10_values)
        notes += unidentified_vertical(temperatures, found.vertical_covariance)
    if shift is not None or fixed:
        notes += badly_given(joined.logs, factors.log10_values)
    quality = overlap_quality(joined.logs, factors.log10_values)
    notes += without_overlap(temperatures, quality)
    cross = found.cross_covariance if free else None
    return ShiftedIsotherms(joined, factors, quality, tuple(notes), known, cross, found.offsets, unidentified)


def _drifts(isotherms: Sequence[Isotherm | StepTest], log10_b: Array) -> bool:
    """Return whether sweeps drift to one side; step tests, of one quantity, cannot be compared without their shifts."""
    sweeps = [one for one in isotherms if isinstance(one, Isotherm)]
    return bool(sweeps) and drift(neighbour_distances(sweeps, log10_b)) is not None


def _between_models(found: CommonShifts, other: CommonShifts, free: bool) -> CommonShifts:
    """Add to the errors the difference of the alternative model: with a free vertical shift, or without one if `free`.

    Isotherms that drift contradict the requested model; each of the two models is given half of the weight, so that
    their difference adds half its square to the variance (S. T. Buckland et al., Biometrics 53 (1997) 603).  Of the
    difference of each step, only the part beyond the uncertainty of the free model counts.
    """
    loose = found if free else other
    nearest = int(np.argmin(np.abs(found.values) + np.diag(found.covariance)))

    def away(difference: Array, covariance: Array) -> Array:
        steps = np.diff(difference)
        steps = np.sign(steps) * np.sqrt(np.maximum(steps**2 - errors_of_steps(covariance) ** 2, 0.0))
        total = np.concatenate([[0.0], np.cumsum(steps)])
        return np.asarray(total - total[nearest])

    horizontal = away(other.values - found.values, loose.covariance)
    changed = replace(found, covariance=found.covariance + OTHER_MODEL * np.outer(horizontal, horizontal))
    if not free:
        return changed
    vertical = away(other.vertical - found.vertical, loose.vertical_covariance)
    return replace(
        changed,
        vertical_covariance=found.vertical_covariance + OTHER_MODEL * np.outer(vertical, vertical),
        cross_covariance=found.cross_covariance + OTHER_MODEL * np.outer(horizontal, vertical),
    )
