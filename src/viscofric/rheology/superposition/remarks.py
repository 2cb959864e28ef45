"""Notes on superposed isotherms: undetermined shifts, and neighbours that join badly."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note
from viscofric.rheology.superposition.joined_isotherms import ranges
from viscofric.rheology.superposition.overlap import PAIR_UNCERTAINTY, LogSweep, OverlapQuality, own_shifts

if TYPE_CHECKING:
    from collections.abc import Iterable

    from viscofric.arrays import Array


#: Steps of log10 α with a larger standard error are not identified by the isotherms …
UNIDENTIFIED = 0.3  # decades
#: … nor are those with a larger one than this whose sign is not known …
SIGN_UNKNOWN = 0.1  # decades
#: … nor steps of log10 b with a larger one, which is mostly that of their prior.
VERTICAL_UNIDENTIFIED = 0.02  # decades


def badly_given(logs: list[LogSweep], log10_shifts: Array) -> list[str]:
    """Return a note that the given shift factors join the isotherms badly on the whole."""
    found = own_shifts(logs, log10_shifts)
    text = f"The given shift factors do not join the isotherms: {found.clause}."
    return [Note("given-factors-wrong", text)] if found.wrong else []


def joined_by_pairs(temperatures: Array, places: tuple[int, ...], quantities: int) -> list[str]:
    """Return a note on the temperatures where a common curve moved neighbours past each other."""
    if not places:
        return []
    one, why, cure = "moduli", "", ""
    if quantities > 1:
        one, why = "storage moduli", ", because E' and E'' do not agree on the shift"
        cure = " Look for loss moduli that the instrument itself makes, as a resonance does at its highest frequencies."
    sentence = (
        f"The isotherms from {ranges(steps_at(temperatures, places))} were joined pair by pair: one common curve would "
        f"move them past each other although their {one} overlap{why}; each step there is uncertain by "
        f"{PAIR_UNCERTAINTY:g} decades or more.{cure}"
    )
    return [Note("joined-by-pairs", sentence)]


def without_overlap(temperatures: Array, quality: OverlapQuality) -> list[str]:
    """Return a note on the neighbours that do not overlap once shifted."""
    if not quality.gaps:
        return []
    sentence = (
        f"{quality.without_overlap} of {quality.neighbours} pairs of neighbouring isotherms do not overlap once "
        f"shifted, from {ranges(steps_at(temperatures, quality.gaps))}: nothing measured tests the shift there."
    )
    return [Note("no-overlap", sentence)]


def unidentified_places(values: Array, covariance: Array) -> list[int]:
    """Return the indices of steps of log10 α that the isotherms do not determine."""
    errors = errors_of_steps(covariance)
    either_sign = (errors > SIGN_UNKNOWN) & (np.abs(np.diff(values)) < 2.0 * errors)
    return [int(place) for place in np.flatnonzero((errors > UNIDENTIFIED) | either_sign)]


def unidentified_steps(steps: tuple[tuple[float, float], ...], error: float) -> list[str]:
    """Return a note on the temperatures between which the isotherms do not determine α."""
    if not steps:
        return []
    sentence = (
        f"α is not identified from {ranges(steps)}: the isotherms there join about as well over a wide range of "
        "shifts, as where moduli change too little for their scatter (standard error of a step up to "
        f"{error:.1g} decades)."
    )
    return [Note("alpha-not-identified", sentence)]


def unidentified_vertical(temperatures: Array, covariance: Array) -> list[str]:
    """Return a note on the temperatures between which the isotherms do not determine b."""
    errors = errors_of_steps(covariance)
    places = np.flatnonzero(errors > VERTICAL_UNIDENTIFIED)
    if not places.size:
        return []
    sentence = (
        f"b is not identified from {ranges(steps_at(temperatures, places))}: there the isotherms do not separate it "
        f"from α (standard error of a step up to {100.0 * (10.0 ** errors[places].max() - 1.0):.0f} %)."
    )
    return [Note("vertical-not-identified", sentence)]


def steps_at(temperatures: Array, places: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return the two temperatures of each step."""
    return tuple((float(temperatures[place]), float(temperatures[place + 1])) for place in places)


def errors_of_steps(covariance: Array) -> Array:
    """Return the standard errors of differences between neighbours."""
    variance = np.diag(covariance)
    return np.sqrt(np.maximum(variance[1:] + variance[:-1] - 2.0 * np.diag(covariance, 1), 0.0))
