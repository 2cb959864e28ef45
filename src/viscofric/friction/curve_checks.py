"""Checks of measured friction curves: the freedom of their errors, and whether a rubber can have such friction."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import wrong_argument
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.intervals import threshold
from viscofric.nominal import nominal_rows
from viscofric.notes import Note
from viscofric.units import Quantity, number, shown_celsius

#: Fewer second differences do not give a scatter.
FEWEST_DIFFERENCES = 6
#: Relative errors below this are those of solved contacts, not of a measurement.
SOLVED = 1e-3
#: Above this many times the scatter of neighbours, the scatter of all includes a trend of the errors.
COURSE = 2.0
#: Errors that scatter no more than those of this many degrees of freedom are taken as known.
MANY = 60.0
#: The power μFv dissipated in a linear rubber does not fall as speed rises, to first order in the loss: waves of
#: frequency ω dissipate ω²τ/(1 + ω²τ²) in a mode, and a smaller contact has a higher pressure.
STEEPEST = -1.0
#: Probability of a steeper line by chance.
STEEPER = 1e-4
#: Relative error of numbers that are equal.
ROUNDING = 1e-9
#: Coefficients of a parabola, and the fewest degrees of freedom that give a scatter about several.
PARABOLA, FEWEST_ABOUT = 3, 6
#: Probability of differences by chance from which on friction may be constant.
CHANCE = 0.01
_FEWEST_POINTS = 3


def shared_error(value: Quantity, name: str) -> float:
    """Return a relative standard error that points share; InputError if it is below zero, or not below 1."""
    found = number(value, name)
    if not 0.0 <= found < 1.0:
        words = "must be zero or above, and below 1 (all of the friction)."
        raise wrong_argument(name, value, words, "level-error")
    return found


def error_freedom(curves: FrictionCurves) -> tuple[Array, tuple[Note, ...]]:
    """Return the degrees of freedom of the standard errors of viscoelastic friction, (n,), and a note if inferred."""
    # As given; else the replicates minus one; and where neither is given, from the scatter of the errors over
    # neighbouring speeds: ln s² of f degrees of freedom has the variance ψ′(f/2), and a smooth trend of the errors has
    # no second differences. Infinite where the errors are known, or do not appear to scatter.
    if curves.viscoelastic_freedom is not None:
        return np.maximum(curves.viscoelastic_freedom, 1.0), ()
    freedom = np.where(curves.replicates > 1, curves.replicates - 1.0, np.inf)
    relative = curves.viscoelastic_error / np.maximum(np.abs(curves.viscoelastic), np.finfo(float).tiny)
    wanted = np.isinf(freedom) & np.isfinite(relative) & (relative > 0.0)
    squares, count = 0.0, 0
    for isotherm in nominal_rows(curves.temperature):
        rows = isotherm[wanted[isotherm]]
        bent = np.diff(np.log(relative[rows[np.argsort(curves.speed[rows], kind="stable")]] ** 2), 2)
        squares, count = squares + float(bent @ bent), count + bent.size
    if count < FEWEST_DIFFERENCES or np.median(relative[wanted]) < SOLVED:
        return freedom, ()
    rough = squares / (6.0 * count)  # 1 + 4 + 1 variances in each
    # Without a trend, the scatter of all is a better estimate than that of neighbours.
    everything = float(np.var(np.log(relative[wanted] ** 2), ddof=1))
    seen = freedom_of_scatter(everything if everything < COURSE * rough else rough)
    if seen > MANY:
        return freedom, ()
    note = Note(
        "inferred-freedom",
        "The standard errors of friction scatter from one speed to the next like those of "
        f"{seen + 1.0:.0f} replicates, a number that was not given: it is assumed, and each error is averaged with its "
        "neighbours; give the replicates, or degrees of freedom.",
    )
    return np.where(wanted, seen, freedom), (note,)


def freedom_of_scatter(variance: float) -> float:
    """Return the degrees of freedom f of sample variances with a variance of ln s², which is ψ′(f/2)."""
    from scipy.optimize import brentq
    from scipy.special import polygamma

    least, most = 0.5, 0.5 * MANY
    if variance <= polygamma(1, most):
        return np.inf
    if variance >= polygamma(1, least):
        return 2.0 * least
    return 2.0 * float(brentq(lambda half: float(polygamma(1, half)) - variance, least, most))


def scatter_about_parabolas(curves: FrictionCurves) -> float | None:
    """Return the relative scatter about a parabola in ln v of each temperature; None if points are too few."""
    squares, freedom = 0.0, 0
    for rows in nominal_rows(curves.temperature):
        mine = curves.select(rows)
        different = np.unique(mine.speed).size
        if different <= PARABOLA or not np.all(mine.viscoelastic > 0.0):
            continue
        place = np.log(mine.speed / mine.speed.mean())
        design = np.vander(place / np.ptp(place), PARABOLA)
        values = np.log(mine.viscoelastic)
        left = values - design @ np.linalg.lstsq(design, values, rcond=None)[0]
        squares += float(left @ left)
        freedom += len(mine) - PARABOLA
    if freedom < FEWEST_ABOUT:
        return None
    return float(np.sqrt(squares / max(freedom - 2.0, 0.5 * freedom)))  # of Student's distribution


def implausible(curves: FrictionCurves) -> tuple[Note, ...]:
    """Return notes on friction that no rubber has, "too-steep" and "constant-friction"."""
    # The curves are at one load; points not above zero are ignored, and those of unknown error if others have one.
    curves = curves.select(curves.viscoelastic > 0.0)
    known = np.isfinite(curves.viscoelastic_error)
    if np.any(curves.viscoelastic_error[known] > 0.0):
        curves = curves.select(known)
    else:
        scatter = max(scatter_about_parabolas(curves) or 0.0, ROUNDING)
        curves = replace(curves, viscoelastic_error=scatter * curves.viscoelastic)
    return (*_too_steep(curves), *_constant(curves))


def _too_steep(curves: FrictionCurves) -> Iterator[Note]:
    steepest, where = np.inf, ""
    for rows in nominal_rows(curves.temperature):
        mine = curves.select(rows)
        x = np.log(mine.speed / np.exp(np.log(mine.speed).mean()))
        if len(mine) < _FEWEST_POINTS or not np.any(x):
            continue
        y = np.log(mine.viscoelastic)
        slope = float(x @ y / (x @ x))
        left = y - y.mean() - slope * x
        own = mine.viscoelastic_error / mine.viscoelastic
        about = threshold(len(mine) - 2, STEEPER) ** 2 * float(left @ left) / (len(mine) - 2)
        by_own = threshold(np.inf, STEEPER) ** 2 * float(np.mean(own**2))
        if slope + np.sqrt(max(about, by_own) / (x @ x)) < min(STEEPEST, steepest):
            steepest, where = slope, f"{shown_celsius(float(mine.temperature.mean()))} °C"
    if np.isfinite(steepest):
        yield Note(
            "too-steep",
            f"Friction at {where} falls as v to the power {steepest:.2g}. That of a linear rubber never falls faster "
            "than 1/v, because the power lost in it does not fall with speed; check speeds, forces and lubrication.",
        )


def _constant(curves: FrictionCurves) -> Iterator[Note]:
    from scipy.special import chdtrc

    error = curves.viscoelastic_error
    if len(curves) <= _FEWEST_POINTS or not np.any(error > 0.0):
        return
    weight = 1.0 / np.maximum(error, 1e-3 * error.max()) ** 2
    away = curves.viscoelastic - np.average(curves.viscoelastic, weights=weight)
    if chdtrc(len(curves) - 1, float(weight @ away**2)) >= CHANCE:
        yield Note(
            "constant-friction",
            f"Friction of all {len(curves)} points is the same within its errors, as Coulomb friction is; it may not "
            "come from the rubber's loss; measure at more speeds and temperatures, or separate the two.",
        )
