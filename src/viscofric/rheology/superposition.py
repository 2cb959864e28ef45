"""Time–temperature superposition: isotherms shifted onto one master curve at a reference temperature."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from viscofric.data import MasterCurve
from viscofric.errors import InputError, SuperpositionError
from viscofric.rheology.common_curve import common_shifts
from viscofric.rheology.overlap import Join, LogSweep, OverlapQuality, failures, join, overlap_quality
from viscofric.rheology.shift_factors import ShiftFactors, referenced_covariance
from viscofric.threads import one_blas_thread
from viscofric.units import celsius, kelvin_hint, positive, to_si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import Isotherm, IsothermalSweeps
    from viscofric.units import Quantity

    Array = NDArray[np.float64]

#: Neighbours whose moduli cannot be brought closer than this (decades, joint rms) are not joined.
LARGEST_MISFIT = 0.15


@dataclass(frozen=True, eq=False)
class Superposition:
    """What `superpose` finds.

    Parameters
    ----------
    shift_factors : ShiftFactors
        α at the temperatures that were joined, with standard errors.
    master_curve : MasterCurve
        Tensile, at the reference.
    quality : OverlapQuality
        How well neighbours overlap: rms of log10 E' and of log10 E''.
    notes : tuple of str
        What the reader noted, and what was converted or left out here: one sentence each.
    """

    shift_factors: ShiftFactors
    master_curve: MasterCurve
    quality: OverlapQuality
    notes: tuple[str, ...] = ()


@one_blas_thread
def superpose(sweeps: IsothermalSweeps, reference: Quantity, poisson_ratio: float = 0.5) -> Superposition:
    """Shift isotherms along the frequency axis onto one master curve, by E' and E'' jointly, all at once.

    Parameters
    ----------
    sweeps : IsothermalSweeps
        At least two isotherms that overlap.
    reference : float or quantity
        Temperature of the master curve, measured or in between; K, or text such as ``"30 degC"``.
    poisson_ratio : float
        Turns shear moduli into tensile ones, E = 2(1+ν)G; without effect on moduli measured in tension.

    Returns
    -------
    Superposition

    Raises
    ------
    SuperpositionError
        If there are fewer than two isotherms, one has fewer than two points, or neighbours do not overlap.  A
        single isotherm at the cold or the hot end that does not reach the others is left out, with a note.
    InputError
        If the reference lies outside the temperatures that were joined, or ν outside 0 to 0.5.

    Notes
    -----
    Neighbours are first joined pair by pair, then all shifts are refined together against common curves of
    log E' and log E'' (`common_curve`).  No vertical shift is made (b = 1).
    """
    kelvin = positive(reference, "K", "reference")
    if not 0.0 <= to_si(poisson_ratio, "dimensionless", "poisson_ratio") <= 0.5:
        raise InputError(f"poisson_ratio = {poisson_ratio!r}: must lie between 0 and 0.5.")
    tensile = sweeps.in_tension(poisson_ratio)
    isotherms, joins, left_out = _joined(tensile.isotherms)
    temperatures = np.array([isotherm.temperature for isotherm in isotherms])
    logs = [LogSweep.of(isotherm) for isotherm in isotherms]
    found = common_shifts(logs, joins)
    if not temperatures[0] <= kelvin <= temperatures[-1]:
        raise InputError(
            f"reference = {celsius(kelvin):z.1f} °C lies outside the joined isotherms, "
            f"{_shown(temperatures[0])} to {_shown(temperatures[-1])}{kelvin_hint(kelvin)}. "
            f"{' '.join(left_out)}".rstrip()
        )
    shift_factors = ShiftFactors(
        temperatures, found.values, kelvin, referenced_covariance(temperatures, found.covariance, kelvin)
    )
    return Superposition(
        shift_factors,
        _master_curve(isotherms, shift_factors),
        overlap_quality(logs, shift_factors.log10_values),
        (*tensile.notes, *left_out, *_disagreements(isotherms, joins)),
    )


def _shown(kelvin: float) -> str:
    return f"{celsius(kelvin):z.1f} °C"


def _joined(isotherms: tuple[Isotherm, ...]) -> tuple[tuple[Isotherm, ...], list[Join], tuple[str, ...]]:
    """Join neighbours, and leave out single isotherms at the ends that reach no other."""
    if len(isotherms) < 2:
        raise SuperpositionError(f"{len(isotherms)} isotherm cannot be superposed; at least two are needed.")
    for isotherm in isotherms:
        if len(isotherm) < 2:
            raise SuperpositionError(
                f"the isotherm at {_shown(isotherm.temperature)} has only one usable frequency; two or more are needed."
            )
    logs = [LogSweep.of(isotherm) for isotherm in isotherms]
    joins = [join(colder, warmer) for colder, warmer in pairwise(logs)]
    joined = np.array([found.misfit <= LARGEST_MISFIT for found in joins])
    if not joined.any():
        raise SuperpositionError(_gap(isotherms, 0))
    first, last = int(np.argmax(joined)), len(joined) - int(np.argmax(joined[::-1]))
    broken = np.flatnonzero(~joined[first:last])
    if broken.size:
        raise SuperpositionError(_gap(isotherms, first + int(broken[0])))
    notes = tuple(
        f"The isotherm at {_shown(isotherms[place].temperature)} was left out: {_gap(isotherms, gap)}"
        for place, gap in [(p, p) for p in range(first)] + [(p, p - 1) for p in range(last + 1, len(isotherms))]
    )
    return isotherms[first : last + 1], joins[first:last], notes


def _gap(isotherms: tuple[Isotherm, ...], place: int) -> str:
    colder, warmer = isotherms[place], isotherms[place + 1]
    return (
        f"the sweeps at {_shown(colder.temperature)} and {_shown(warmer.temperature)} do not overlap "
        f"(no shift brings their moduli within {LARGEST_MISFIT:g} decades of each other); "
        "measure in between or over more frequencies."
    )


def _disagreements(isotherms: tuple[Isotherm, ...], joins: list[Join]) -> tuple[str, ...]:
    return tuple(
        f"The sweeps at {_shown(isotherms[place].temperature)} and "
        f"{_shown(isotherms[place + 1].temperature)} disagree by "
        f"{joins[place].misfit:.2g} decades, many times what is typical here; they were "
        "joined where they overlap best, with a large uncertainty."
        for place in failures(joins)
    )


def _master_curve(isotherms: tuple[Isotherm, ...], shift_factors: ShiftFactors) -> MasterCurve:
    shifts = zip(isotherms, shift_factors.log10_values, strict=True)
    frequency = np.concatenate([isotherm.angular_frequency * 10.0**shift for isotherm, shift in shifts])
    order = np.argsort(frequency, kind="stable")
    temperature = np.repeat([i.temperature for i in isotherms], [len(i) for i in isotherms])
    return MasterCurve(
        frequency[order],
        np.concatenate([isotherm.storage_modulus for isotherm in isotherms])[order],
        np.concatenate([isotherm.loss_modulus for isotherm in isotherms])[order],
        temperature[order],
        shift_factors.reference,
    )
