"""Separation of viscoelastic from Coulomb friction in the signed traction runs of a mini-traction machine."""

from __future__ import annotations

from typing import Literal

import numpy as np

from viscofric.arguments import insist_on
from viscofric.errors import check_choice
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.measurement.assumed_coulomb import Assumed
from viscofric.friction.measurement.doubts import constant_force, doubts, outlier_notes, without_unnoticed_slip
from viscofric.friction.measurement.doubts import outliers as far_readings
from viscofric.friction.measurement.drift import Drift
from viscofric.friction.measurement.errors import between_runs
from viscofric.friction.measurement.fit import Entry, Fit, Uneven
from viscofric.friction.measurement.grouping import grouped
from viscofric.friction.measurement.zeros import Zeros, another_zero
from viscofric.notes import Note
from viscofric.traction import TractionRuns
from viscofric.units import Quantity, positive, share

# Iterations of friction and of its change with speed, which corrects it a little.
_ROUNDS = 4


def separate(
    runs: TractionRuns,
    *,
    zero: Quantity | tuple[Quantity, Quantity] | None = None,
    coulomb: float | tuple[float, float] | Literal["constant"] | None = None,
    outliers: Literal["keep", "leave out"] = "keep",
    speed_tolerance: float = 0.05,
    temperature_tolerance: Quantity = 1.0,
) -> FrictionCurves:
    """Separate viscoelastic friction from Coulomb friction and from the force cell's zero.

    Parameters
    ----------
    runs : TractionRuns
        Readings with signed surface velocities.
    zero : float, str or pint.Quantity, or two of them, optional
        Known zero reading O of the force cell, N, and its standard error.  If left out, O is fitted where the signs of
        the velocities determine it, and `runs.zero_force` used elsewhere.
    coulomb : float, (float, float) or "constant", optional
        Assumption where only one direction of slip was measured, which is refused otherwise: a known Coulomb friction
        coefficient, with its standard error; or one that is the same at all speeds of a temperature and load, and as
        large as the friction measured there allows, so that viscoelastic friction is the part that varies with speed,
        a lower limit.
    outliers : {"keep", "leave out"}
        Treatment of readings that differ from the median of their configuration by more than five standard deviations,
        the largest of those of their configuration, their condition and the whole test, each estimated by the median
        absolute deviation.  They are noted in either case.
    speed_tolerance : float
        Relative gap between nominal speeds and slips; measured ones scatter by less.  For loads it is 5 %,
        or 15 % where nothing can be separated otherwise.
    temperature_tolerance : float, str or pint.Quantity
        Gap between nominal temperatures, K.

    Returns
    -------
    FrictionCurves
        One entry per temperature, load, magnitude of disc speed and magnitude of slip, in that order.
        Temperatures and speeds are the means over all readings of the same nominal value.  `assumption` is the
        assumption made, if any.

    Raises
    ------
    InputError
        If there are no readings, nominal conditions cannot be distinguished, or the sign configurations measured
        suffice at none of them.

    Notes
    -----
    The force on the cell is

        F = O + F_N [μ_c sgn(u_disc − u_ball) + μ_v sgn(u_disc)],

    that is Eqs. 9a–d of [1]_, whatever the names of the configurations.  It is fitted by least squares
    with each reading's own measured load F_N.  Where every replicate of a condition has all configurations
    that the condition has, each replicate is fitted by itself: coefficients are means over the replicates,
    scatter their standard deviation s, standard errors s/√n with n − 1 degrees of freedom.  Otherwise all
    readings are fitted together and the scatter is the standard error times √n.

    Readings of one step and configuration are one pass over a condition, not repetitions of the test, whatever their
    replicate numbers: they share the deviations of their run, and are correlated.  Where readings are fitted together,
    standard errors follow from the residuals of the means of the passes, such as the fourth combination of four
    configurations measured once; or from the sums of residuals over steps where there are enough steps with several
    configurations (K.-Y. Liang, S. L. Zeger, Biometrika 73 (1986) 13).

    Where this leaves a condition fewer than four degrees of freedom, the variance is the larger one of its own and
    that of all conditions together, as a part of the friction squared; the scatter is that of one replicate.  Runs
    may differ alike at all their speeds or at each speed anew; the variances of the runs' means over the speeds of a
    temperature and of the rest give the degrees of freedom (F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110).
    Errors that the speeds share are noted with their size: they are not independent from point to point, for which
    `shift_friction` has ``level_error``.

    Where no pass was repeated and there are no residuals, errors follow from the readings within the passes, as
    autoregressive series of first order; they do not include the variation from run to run, which is noted.  They are
    infinite where there is one reading in each pass.

    Readings of a configuration that fall into two groups of opposite sign come from runs whose speeds have no signs;
    their conditions are left out with a note, or refused where there are no others.

    With four configurations a fourth coefficient, of −sgn(u_disc) sgn(u_disc − u_ball) F_N, is fitted as
    well: the consistency, (F_I − F_II + F_III − F_IV)/4F_N, zero in the model.  Where it is larger than the scatter of
    replicates explains, standard errors include its expected square, since what makes the configurations inconsistent,
    such as wear from one to the next, changes the coefficients by as much.

    One direction of the disc with slip reversed gives O + F_v, half the sum of the two forces, and F_c, half their
    difference, so that viscoelastic friction is no better known than O.  Each reading is then taken above the zero
    recorded with it.  The standard error of one recording, √(½ mean (z_{k+1} − z_k)²) over the recordings of the
    test, adds to those of friction unless the scatter of the replicates includes it: not at all where each has its own
    recordings, in full where they share one.  Degrees of freedom are combined after Welch and Satterthwaite.

    Slip not significantly different from zero is taken as pure rolling, though it may transmit much of Coulomb
    friction.  Where readings with slip at the same temperature, load and speed contradict this, they are left out.

    A linear drift of the zero is estimated from the zeros of repeated conditions, by lines of one common slope (of all
    conditions of a temperature and load where repetitions follow each other at once), and removed before configurations
    measured one after the other are compared; zeros recorded more than once are used reading by reading if the forces
    follow them.  A linear change of Coulomb friction, as by wear, is estimated from the runs of each temperature, and
    taken out of viscoelastic friction, unless the consistency contradicts it; where replicates of a condition follow
    each other at once, from those of each condition.  Where the consistency would not show it, it may be running in
    that repeats itself: half of it is taken out and the errors include the other half.  Errors include the expected
    squares of rates that are not significant.

    Readings of one step and time are one point of the test and count at their mean speed.  Where the disc's speeds
    put no reversed slips together, those of equal mean speed of disc and ball are.  Viscoelastic friction is then the
    one at that speed, and its change between the disc's speeds, from a polynomial through the nearest speeds of the
    test, is removed.  The remaining uncertainty, for a curve as steep and sharp as that of a single retardation time,
    is in the standard errors, which are wide for large slips and few speeds.

    References
    ----------
    .. [1] C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338–343.

    Examples
    --------
    >>> import numpy as np, viscofric as vf
    >>> runs = vf.readers.TractionRuns(
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
    insist_on(runs, "runs", TractionRuns, right="TractionRuns, as read_mtm() gives them")
    check_choice(outliers, "outliers", "keep", "leave out")
    gap = share(speed_tolerance, "speed_tolerance", example=0.05)
    assumed = Assumed.of(coulomb)
    kelvin = positive(temperature_tolerance, "delta_degC", "temperature_tolerance")
    entries, found_notes = _separated(runs, zero, assumed, gap, kelvin)
    far = far_readings(runs, entries)
    notes = outlier_notes(runs, far, left_out=outliers == "leave out")
    if far and outliers == "leave out":
        rest = runs.select(np.setdiff1d(np.arange(len(runs)), [row for _, row in far]))
        entries, found_notes = _separated(rest, zero, assumed, gap, kelvin)
    return _curves(runs, entries, assumed, [*found_notes, *notes])


def _separated(
    runs: TractionRuns,
    zero: Quantity | tuple[Quantity, Quantity] | None,
    assumed: Assumed,
    speed_tolerance: float,
    temperature_tolerance: float,
) -> tuple[list[Entry], list[str]]:
    """Separate a test without a search for outliers; return results by condition, and notes."""
    zeros = Zeros.known(runs, zero)
    groups, notes = grouped(runs, zeros, assumed, speed_tolerance, temperature_tolerance)
    uneven = Uneven.of(runs, groups, speed_tolerance)
    bare, entries = list[Entry](), list[Entry]()  # without and with the error of friction's change over speed
    for number in range(1 + _ROUNDS if uneven else 1):
        if number:
            uneven = uneven.with_growths(bare, entries)
        both = zip(groups, uneven.growths, strict=True)
        fits = [Fit.of(runs, group, zeros, assumed.at(group, zeros), growth) for group, growth in both]
        drift = Drift.of(fits)
        errors, freedom, error_notes = between_runs(fits, drift.weights)
        bare = [drift.entry(fit, zeros, *one) for fit, *one in zip(fits, errors, freedom, strict=True)]
        entries = [uneven.widened(place, one) for place, one in enumerate(bare)]
    notes += uneven.notes(entries)
    entries, slip_notes = without_unnoticed_slip(entries)
    entries = assumed.completed(entries)
    groups = [entry.group for entry in entries]
    resting = [entry.group for entry in entries if not entry.fit.fits_offset]
    return entries, [
        *notes,
        *slip_notes,
        *zeros.notes(groups, resting),
        *zeros.drift(float(np.mean([group.load for group in groups]))),
        *drift.notes([entry.fit for entry in entries]),
        *error_notes,
        *constant_force(runs),
        *doubts(entries, zeros),
        *another_zero(runs, groups, zeros),
    ]


def _curves(runs: TractionRuns, entries: list[Entry], assumed: Assumed, notes: list[str]) -> FrictionCurves:
    """Return one entry for each condition."""
    groups = [entry.group for entry in entries]
    sliding = any(entry.fit.slides for entry in entries)
    checked = any(entry.fit.checks for entry in entries)
    assumption = assumed.sentence([entry.group for entry in entries if entry.fit.coulomb is not None], len(groups))
    if not assumption and not assumed.nothing:
        unused = "The given Coulomb friction is not used: the signs of the speeds determine it."
        notes = [*notes, Note("coulomb-not-used", unused)]
    numbers = np.array([[entry.value, entry.error, entry.scatter, entry.freedom] for entry in entries])
    value, error, scatter, freedom = np.moveaxis(numbers, 1, 0)  # (k, 4) each
    return FrictionCurves(
        speed=np.array([group.speed for group in groups]),
        temperature=np.array([group.temperature for group in groups]),
        load=np.array([group.load for group in groups]),
        viscoelastic=value[:, 1],
        viscoelastic_error=error[:, 1],
        viscoelastic_scatter=scatter[:, 1],
        viscoelastic_freedom=freedom[:, 1],
        replicates=np.array([entry.fit.replicates for entry in entries]),
        coulomb=value[:, 2] if sliding else None,
        coulomb_error=error[:, 2] if sliding else None,
        coulomb_scatter=scatter[:, 2] if sliding else None,
        coulomb_freedom=freedom[:, 2] if sliding else None,
        consistency=value[:, 3] if checked else None,
        consistency_error=error[:, 3] if checked else None,
        source=runs.source,
        notes=(*runs.notes, *([assumption] if assumption else []), *notes),
        slip=np.array([group.slip for group in groups]),
        offset=value[:, 0],
        assumption=assumption,
    )
