"""Separate viscoelastic from Coulomb friction in the signed traction runs of a mini-traction machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.measurement.conditions import Condition, conditions, where
from viscofric.friction.measurement.doubts import doubts, outliers
from viscofric.friction.measurement.separation import Entry, regressors
from viscofric.units import Quantity, positive, to_si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import TractionRuns

    Array: TypeAlias = NDArray[np.float64]

# (sgn u_disc, sgn(u_disc − u_ball)) in words
_WORDS = {
    (sign, slip): f"u_disc {'<' if sign < 0 else '>'} 0 with u_disc − u_ball {'<' if slip < 0 else '>'} 0"
    for sign in (-1, 1)
    for slip in (-1, 1)
}


def separate(
    runs: TractionRuns,
    *,
    zero: Quantity | None = None,
    speed_tolerance: float = 0.05,
    temperature_tolerance: Quantity = 1.0,
) -> FrictionCurves:
    """Separate viscoelastic friction from Coulomb friction and from the force cell's zero.

    Parameters
    ----------
    runs : TractionRuns
        Readings with signed surface velocities.
    zero : float, str or pint.Quantity, optional
        Zero reading O of the force cell where it is known, N; fitted at each condition if left out.
    speed_tolerance : float
        Relative gap that parts nominal speeds, slips and loads from each other; measured ones scatter by
        less.
    temperature_tolerance : float, str or pint.Quantity
        Gap that parts nominal temperatures, K.

    Returns
    -------
    FrictionCurves
        One entry per temperature, load, magnitude of disc speed and magnitude of slip, in that order.
        Temperatures and speeds are the means over all readings of the same nominal value.

    Raises
    ------
    InputError
        If there are no readings, conditions cannot be told apart, or the sign configurations measured at
        one of them do not suffice.

    Notes
    -----
    The force on the cell is

        F = O + F_N [μ_c sgn(u_disc − u_ball) + μ_v sgn(u_disc)],

    which is the paper's Eqs. 9a–d whatever the names of the configurations.  It is fitted by least squares
    with each reading's own measured load F_N.  Where every replicate of a condition has all configurations
    that the condition has, each replicate is fitted by itself: coefficients are means over the replicates,
    scatter their standard deviation s, standard errors s/√n with n − 1 degrees of freedom.  Otherwise all
    readings are fitted together and standard errors come from the scatter of the residuals; the scatter
    given is then the standard error times √n.  Both are infinite where nothing is left over to tell them
    from.

    With four configurations a fourth coefficient, of −sgn(u_disc) sgn(u_disc − u_ball) F_N, is fitted as
    well: the
    consistency, (F_I − F_II + F_III − F_IV)/4F_N, zero in the model.

    No reading is dropped.  One is noted that differs from the median of its configuration by more than five
    standard deviations (1.4826 × the median absolute deviation), of its condition and of the whole test.

    Examples
    --------
    >>> import numpy as np, viscofric as vf
    >>> runs = vf.TractionRuns(
    ...     disc_speed=np.array([-0.1, -0.1, 0.1, 0.1]),
    ...     ball_speed=np.array([-0.15, -0.05, 0.15, 0.05]),
    ...     traction_force=np.array([0.6, -1.4, -0.4, 1.6]),
    ...     load=np.full(4, 25.0),
    ...     temperature=np.full(4, 303.15),
    ...     replicate=np.ones(4),
    ... )
    >>> curves = vf.separate(runs)
    >>> curves.offset.round(6), curves.viscoelastic.round(6), curves.coulomb.round(6)
    (array([0.1]), array([0.02]), array([0.04]))
    """
    if not 0.0 < speed_tolerance < 1.0:
        raise InputError(f"speed_tolerance = {speed_tolerance!r}: must lie between 0 and 1, such as 0.05.")
    known = None if zero is None else to_si(zero, "N", "zero")
    kelvin = positive(temperature_tolerance, "delta_degC", "temperature_tolerance")
    groups, notes = conditions(runs, speed_tolerance, kelvin)
    if not groups:
        raise InputError("traction runs hold no reading with the disc in motion: nothing to separate.")
    _insist_on_configurations(groups, known)
    entries = [Entry.of(runs, group, known) for group in groups]
    sliding = any(entry.slides for entry in entries)
    checked = any(entry.checks for entry in entries)

    def column(number: int, kind: str) -> Array:
        return np.array([getattr(entry, kind)[number] for entry in entries])

    return FrictionCurves(
        speed=np.array([group.speed for group in groups]),
        temperature=np.array([group.temperature for group in groups]),
        load=np.array([group.load for group in groups]),
        viscoelastic=column(1, "value"),
        viscoelastic_error=column(1, "error"),
        viscoelastic_scatter=column(1, "scatter"),
        replicates=np.array([entry.replicates for entry in entries]),
        coulomb=column(2, "value") if sliding else None,
        coulomb_error=column(2, "error") if sliding else None,
        coulomb_scatter=column(2, "scatter") if sliding else None,
        consistency=column(3, "value") if checked else None,
        consistency_error=column(3, "error") if checked else None,
        source=runs.source,
        notes=(*runs.notes, *notes, *doubts(groups, entries), *outliers(runs, groups, entries)),
        slip=np.array([group.slip for group in groups]),
        offset=column(0, "value"),
    )


def _insist_on_configurations(groups: list[Condition], zero: float | None) -> None:
    """Raise where the signs alone, whatever the jitter of the loads, do not tell the unknowns apart."""
    poor = [g for g in groups if np.linalg.matrix_rank(regressors(g, zero)) < _unknowns(g, zero)]
    if not poor:
        return
    first = poor[0]
    there = set(zip(first.disc_sign.astype(int), first.slip_sign.astype(int), strict=True))
    missing = [words for signs, words in _WORDS.items() if signs not in there]
    rolls = not np.any(first.slip_sign)
    advice = f"measure also {' or '.join(missing)}"
    if rolls:
        advice = "measure also with the velocities of disc and ball reversed"
    unknowns = ["the force cell's zero"] * (zero is None) + ["viscoelastic"] + ["Coulomb"] * (not rolls)
    told = " from ".join(unknowns[:2]) if rolls else f"{', '.join(unknowns[:-1])} and {unknowns[-1]}"
    if zero is None:
        advice += ", or read the force cell with ball and disc apart and give that zero (zero= in Python)"
    because = "slip is zero (pure rolling) and " if rolls else ""
    raise InputError(
        f"{where(poor, len(groups))} {because}the signs of the velocities do not tell {told} friction apart; {advice}."
    )


def _unknowns(group: Condition, zero: float | None) -> int:
    return 1 + (zero is None) + bool(np.any(group.slip_sign))
