"""Isotherms of any kind, given by logarithms: joined, shifted by fitted, fixed or given factors, with notes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Isotherm
from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.shifts.law_comparison import course_notes
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.superposition.common_shifts import CommonShifts, common_shifts
from viscofric.rheology.superposition.consistency import drift, neighbour_distances
from viscofric.rheology.superposition.joined_isotherms import (
    BOTH,
    JoinedIsotherms,
    Quantities,
    Tested,
    as_given,
    join_isotherms,
    on_gaps,
    ranges,
    shown,
    steps_at,
    usable,
)
from viscofric.rheology.superposition.overlap import (
    PAIR_UNCERTAINTY,
    LogSweep,
    overlap_quality,
    own_shifts,
)
from viscofric.rheology.superposition.shift_problem import Gauge
from viscofric.step_tests import StepTest
from viscofric.units import kelvin_hint, positive, shown_celsius, to_si

#: A temperature is that of an isotherm within this part of the distance to the next one.
NEAR = 0.25
#: Where the reference lies between isotherms, iteration fixes factors relative to its interpolated zero, to this.
EXACT = 1e-9  # decades
REPETITIONS = 12
#: A law close to its pole moves sweeps farther than this, beyond the largest floating-point number.
LARGEST_SHIFT = 100.0  # decades


def held_places(fixed: Mapping[Any, float], temperatures: Array, reference: float) -> dict[int, float]:
    """Return log10 α by the index of the isotherm, of fixed factors by temperature as users write it."""
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
    around = np.flatnonzero(weights_between(temperatures, np.array([reference])))
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
    temperatures, sweeps = _temperatures(joined), joined.logs
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
    """Return the shifts of a law or table; with `free`, fit vertical ones."""
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
        weights = weights_between(shift.temperatures, temperatures)
        covariance = weights @ shift.covariance @ weights.T
    if not free:
        return CommonShifts(values, covariance, np.zeros(len(values)), nothing, nothing)
    gauge = _gauge(temperatures, reference, dict(enumerate(values)), free)
    found = common_shifts(joined.logs, joined.joins, gauge)
    return CommonShifts(values, covariance, found.vertical, found.vertical_covariance, nothing)


def _temperatures(joined: JoinedIsotherms[Any]) -> Array:
    return np.array([isotherm.temperature for isotherm in joined.isotherms])


def _gauge(temperatures: Array, reference: float, held: dict[int, float], free: bool) -> Gauge:
    weights = weights_between(temperatures, np.array([reference]))[0]
    vertical = np.array([np.interp(reference, temperatures, unit) for unit in np.eye(len(temperatures))])
    return Gauge(1.0 / temperatures, weights, vertical, held, free)


#: Weight of the alternative model, with a free vertical shift or without one, where isotherms drift.
OTHER_MODEL = 0.5


def shifted_isotherms(
    isotherms: tuple[Tested, ...],
    logs: list[LogSweep],
    kelvin: float,
    known: VerticalShift | None,
    free: bool,
    shift: ShiftLaw | None,
    fixed: Mapping[Any, float] | None,
    quantities: Quantities,
) -> tuple[JoinedIsotherms[Tested], dict[str, Any]]:
    """Join and shift isotherms given by their logarithms; `known` is b(T) where it is not fitted.

    Returns them free of the vertical shift, and the attributes of a `Superposed` but for its master curve.
    """
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
            f"{shown(temperatures[0])} to {shown(temperatures[-1])}",
            code="reference-outside",
            remedy=kelvin_hint(kelvin) + "".join(f" {note}" for note in joined.notes),
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
        notes += _on_steps(temperatures, found, len(quantities.weights))
        unidentified = steps_at(temperatures, unidentified_places(found))
        if not fixed:
            notes += course_notes(temperatures, found.values, found.covariance)
    if free:
        known = VerticalShiftFactors(temperatures, found.vertical, kelvin, found.vertical_covariance)
        joined = joined.less(known.log10_values)
        notes += _on_vertical(temperatures, found.vertical_covariance)
    if (shift is not None or fixed) and (own := own_shifts(joined.logs, factors.log10_values)).wrong:
        said = f"The given shift factors do not join the isotherms: {own.clause}."
        notes.append(Note("given-factors-wrong", said))
    quality = overlap_quality(joined.logs, factors.log10_values)
    notes += on_gaps(temperatures, quality)
    return joined, {
        "shift_factors": factors,
        "quality": quality,
        "notes": tuple(notes),
        "isotherms": joined.isotherms,
        "vertical_shift": known,
        "cross_covariance": found.cross_covariance if free else None,
        "offsets": found.offsets,
        "unidentified": unidentified,
    }


def _drifts(isotherms: Sequence[Isotherm | StepTest], log10_b: Array) -> bool:
    """Return whether sweeps drift to one side; step tests, of one quantity, cannot be compared without their shifts."""
    sweeps = [one for one in isotherms if isinstance(one, Isotherm)]
    return bool(sweeps) and drift(neighbour_distances(sweeps, log10_b)) is not None


def _between_models(found: CommonShifts, other: CommonShifts, free: bool) -> CommonShifts:
    """Add the difference of the alternative model to the errors: with a free vertical shift, or without if `free`."""
    # Isotherms that drift contradict the requested model; each of the two models is given half of the weight, so that
    # their difference adds half its square to the variance (S. T. Buckland et al., Biometrics 53 (1997) 603). Of the
    # difference of each step, only the part beyond the uncertainty of the free model counts.
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


#: Steps of log10 α with a larger standard error are not identified by the isotherms …
UNIDENTIFIED = 0.3  # decades
#: … nor are those with a larger one than this whose sign is not known …
SIGN_UNKNOWN = 0.1  # decades
#: … nor steps of log10 b with a larger one, which is mostly that of their prior.
VERTICAL_UNIDENTIFIED = 0.02  # decades


def _on_steps(temperatures: Array, found: CommonShifts, quantities: int) -> Iterator[Note]:
    """Yield notes on neighbours that a common curve moved apart, and on steps of α that are not identified."""
    if found.parted:
        one, why, cure = "moduli", "", ""
        if quantities > 1:
            one, why = "storage moduli", ", because E' and E'' do not agree on the shift"
            cure = " Look for loss moduli that the instrument itself makes, as a resonance does at its highest "
            cure += "frequencies."
        yield Note(
            "joined-by-pairs",
            f"The isotherms from {ranges(steps_at(temperatures, found.parted))} were joined pair by pair: one common "
            f"curve would move them apart although their {one} overlap{why}; each step there is uncertain by "
            f"{PAIR_UNCERTAINTY:g} decades or more.{cure}",
        )
    places = unidentified_places(found)
    if places:
        yield Note(
            "alpha-not-identified",
            f"α is not identified from {ranges(steps_at(temperatures, places))}: the isotherms there join about as "
            "well over a wide range of shifts, as where moduli change too little for their scatter (standard error of "
            f"a step up to {max(errors_of_steps(found.covariance)[places]):.1g} decades).",
        )


def _on_vertical(temperatures: Array, covariance: Array) -> Iterator[Note]:
    """Yield a note on the temperatures between which the isotherms do not determine b."""
    errors = errors_of_steps(covariance)
    places = np.flatnonzero(errors > VERTICAL_UNIDENTIFIED)
    if places.size:
        yield Note(
            "vertical-not-identified",
            f"b is not identified from {ranges(steps_at(temperatures, places))}: there the isotherms do not separate "
            f"it from α (standard error of a step up to {100.0 * (10.0 ** errors[places].max() - 1.0):.0f} %).",
        )


def unidentified_places(found: CommonShifts) -> list[int]:
    """Return the indices of steps of log10 α that the isotherms do not determine."""
    errors = errors_of_steps(found.covariance)
    either_sign = (errors > SIGN_UNKNOWN) & (np.abs(np.diff(found.values)) < 2.0 * errors)
    return [int(place) for place in np.flatnonzero((errors > UNIDENTIFIED) | either_sign)]


def errors_of_steps(covariance: Array) -> Array:
    """Return the standard errors of differences between neighbours."""
    variance = np.diag(covariance)
    return np.sqrt(np.maximum(variance[1:] + variance[:-1] - 2.0 * np.diag(covariance, 1), 0.0))
