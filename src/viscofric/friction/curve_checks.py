"""Checks of measured friction curves: the freedom of their errors, and whether a rubber can have such friction."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.errors import wrong_argument
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.intervals import threshold
from viscofric.nominal import nominal_rows
from viscofric.notes import Note, note_of
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.rheology.uncertainty.material_samples import freedom_of_scatter, prior_freedom
from viscofric.units import Quantity, number, plain, shown_celsius, shown_speed

Found = TypeVar("Found")

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
#: Least part of a point's own variance in its distance from a fit, for a distance that is more than rounding.
LEAST_FREEDOM = 1e-6
#: More outliers than this part of the points are scatter, and the mean square of normal scatter without them.
MOST_OUTLYING, INNER_SQUARE = 0.1, 0.623
#: Points count less from this many standard errors on.  Of normal scatter: the mean of squared distances as they count,
#: and the variance of what is fitted over that of the points' weights.
TAILS, MEAN_SQUARE, TAILS_COST = 2.0, 0.921, 1.0195
#: Standard errors from which on, and at which, points far from the others are left out; factor of their variances.
FAR, FARTHEST, LEFT_OUT = 3.0, 6.0, 1e4
#: Scatter over the median of squared distances at most: twice that of normal scatter.
MOST_OVER_MEDIAN = 4.4
#: Most rounds in which they are found, and the relative change of a variance that is none.
ROUNDS, SETTLED = 10, 0.1
#: Fewest errors that have a common one.
FEWEST_ERRORS = 6
#: Within this many standard errors of zero the logarithm of friction is useless: the coefficient itself is then fitted.
CLEAR_OF_ZERO = 4.0
#: … and where some is, a model of it is fitted to ln μ from so many standard errors on, else to μ.
FAR_ABOVE_ZERO = 10.0
#: Code of the note on errors of measured friction that the speeds of a temperature share.
SHARED_BY_SPEEDS = "errors-shared-by-speeds"


@dataclass(frozen=True)
class Decades:
    """A scale of measured values: log10 of those far above `zero`, and linear about zero, where they may lie.

    log10 of z/2 + √(z²/4 + zero²) for a value z: that of z where `zero` is 0.  Values that are known absolutely have
    errors on it of a size that does not depend on them near zero, and all others keep their logarithm.
    """

    zero: float  # size of values that are lost in their errors; 0 if none is

    @classmethod
    def of(cls, values: Array, error: Array) -> Decades:
        """Return the scale of values (n,) with their standard errors, those unknown taken as none."""
        size = np.where(np.isfinite(error), error, 0.0)
        clear = values > CLEAR_OF_ZERO * size
        if np.all(clear):
            return cls(0.0)
        # A value below zero tells that errors are as large; a single error above most others tells nothing of these.
        zero = min(float(np.median(np.maximum(size, -values)[~clear])), float(np.median(size)))
        return cls(zero or float(np.min(np.abs(values[values != 0.0]), initial=1.0)))

    def __call__(self, values: Array) -> Array:
        """Return values (n,) on the scale, in decades."""
        if self.zero == 0.0:
            return np.log10(values)
        return np.asarray(math.log10(self.zero) + np.arcsinh(0.5 * values / self.zero) / LN10)

    def value(self, decades: Array) -> Array:
        """Return what has places (n,) on the scale."""
        power = 10.0**decades
        return np.asarray(power - self.zero**2 / power)

    def near(self, values: Array, error: Array) -> Mask:
        """Return which values (n,) are so near zero that logarithms weighed by the values would be too high."""
        # By 1.5 times the square of the relative error, which many points would show.
        return np.asarray((values <= FAR_ABOVE_ZERO * error) & (self.zero > 0.0))

    def unit(self, values: Array) -> Array:
        """Return what errors of values (n,) are relative to: their change with the natural logarithm on the scale."""
        return np.hypot(values, 2.0 * self.zero)


def friction_unit(curves: FrictionCurves) -> Array:
    """Return what errors of friction are relative to where they are alike, (n,): friction itself, or the largest.

    It is the largest if the errors are then more alike, as those of a force cell are.
    """
    error = curves.viscoelastic_error
    known = np.isfinite(error) & (error > 0.0)
    sizes = np.maximum(Decades.of(curves.viscoelastic, error).unit(curves.viscoelastic), np.finfo(float).tiny)
    if not np.any(known):
        return sizes
    of_friction, of_largest = np.log(error[known] / sizes[known]), np.log(error[known])
    return sizes if np.std(of_friction) < np.std(of_largest) else np.full(len(error), np.abs(curves.viscoelastic).max())


def shared_level(curves: FrictionCurves) -> float:
    """Return the relative error of measured friction that the speeds of a temperature share; 0 where none is noted."""
    notes = map(note_of, curves.notes)
    return max(
        (float(note.values.get("level_error", 0.0)) for note in notes if note.code == SHARED_BY_SPEEDS), default=0.0
    )


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
    # Of points near zero it is friction that scatters in a relative error.
    relative = curves.viscoelastic_error / friction_unit(curves)
    wanted = np.isinf(freedom) & (relative > 0.0) & (relative < 1.0 / CLEAR_OF_ZERO)
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
    seen = freedom_of_scatter(everything if everything < COURSE * rough else rough, 1.0, MANY)
    if seen > MANY:
        return freedom, ()
    note = Note(
        "inferred-freedom",
        "The standard errors of friction scatter from one speed to the next like those of "
        f"{seen + 1.0:.0f} replicates, a number that was not given: it is assumed, and each error is averaged with its "
        "neighbours; give the replicates, or degrees of freedom.",
        values={"replicates": round(seen + 1.0)},
    )
    return np.where(wanted, seen, freedom), (note,)


def outliers(squares: Array, larger: Array, freedom: float, least: float) -> tuple[Array, Mask]:
    """Return squared distances (n,) over the scatter that all but the largest have, and which are too large for chance.

    `squares` are those of distances over their errors, `least` is that of the scatter; one set in a hundred has an
    outlier by chance, and none has more than a tenth of its points besides those that `larger` (n,) leaves out.
    """
    from scipy.special import stdtrit

    left_out = larger >= LEFT_OUT
    inner = np.sort(squares[~left_out])
    inner = inner[: len(inner) - int(MOST_OUTLYING * len(inner))]
    scatter = float(inner.mean()) / (INNER_SQUARE if len(inner) < np.count_nonzero(~left_out) else 1.0)
    over = squares / max(scatter, least)
    known = np.inf if scatter <= least else max(freedom, 1.0)
    far = over > stdtrit(known, 1.0 - 0.5 * CHANCE / len(squares)) ** 2
    several = np.count_nonzero(far & ~left_out) > MOST_OUTLYING * len(inner)
    return over, far & (left_out | (not several))


def with_tails(
    start: Array, fit: Callable[[Array, float], tuple[Found, Array, float]], *, far: bool = True
) -> tuple[Found, Array, Array]:
    """Fit points, those far from the others with less weight, or none if `far`.

    `start` (n,) are factors of the variances of points, one where nothing is known of them.  `fit` takes such factors
    and the one of all, and returns what it found, the squared distances (n,) of the points over their errors, and the
    factor of all of these.  Returns what was found last, the factors, and the squares.
    """
    # Scatter is normal within `TAILS` standard errors, and has the tails of Student's t of three degrees of freedom
    # beyond: points count less by the square of their distance. No point moves a fit by more than one at the edge does,
    # and it costs less than Student's distribution itself: of normal scatter 3 % of the variance (that of five degrees
    # of freedom 6 %). P. J. Huber, Robust Statistics (Wiley, 1981). From that fit on, points farther than `FAR` lose
    # what is left of their weight, which normal scatter hardly has (F. R. Hampel et al., Robust Statistics (Wiley,
    # 1986), ch. 2.6): many of them would enlarge the scatter, and hide.
    larger, scale, from_robust = start, 1.0, bool(np.any(start > 1.0))
    for _ in range(2 * ROUNDS):
        found, squares, after = fit(larger, scale)
        before, larger, scale = scale * larger, _counted_less(squares / after, far=from_robust), after
        if far and not from_robust and _settled(before, scale * larger):
            from_robust, larger = True, _counted_less(squares / scale, far=True)
        if from_robust is far and _settled(before, scale * larger):
            break
    return found, larger, squares


def _counted_less(squares: Array, *, far: bool) -> Array:
    larger = np.maximum(squares / TAILS**2, 1.0)
    left = np.clip((FARTHEST - np.sqrt(squares)) / (FARTHEST - FAR), 0.0, 1.0) if far else 1.0
    return np.minimum(larger / np.maximum(left, 1.0 / LEFT_OUT), LEFT_OUT) if far else larger


def _settled(before: Array, after: Array) -> bool:
    return bool(np.all(np.abs(np.log(after / before)) < SETTLED))


def scatter_of(squares: float, freedom: float, larger: Array, distances: Array | None = None) -> float:
    """Return the factor of variances from the sum of squared residuals with weights, and their freedom.

    `larger` (n,) are the factors of single points, `distances` (n,) their squared distances over their variances, if
    they are those from one curve.
    """
    mean = squares / (MEAN_SQUARE * max(freedom - np.count_nonzero(larger >= LEFT_OUT), 1.0))
    # As many outliers as a fifth of the freedom would make it grow without limit.
    median = 0.0 if distances is None else float(np.median(distances))
    return min(mean, MOST_OVER_MEDIAN * median) if median > 0.0 else mean


def outlying_points(speed: Array, temperature: Array, away: Array, *, relative: bool = False) -> tuple[Note, ...]:
    """Return a note on points (n,) that count less, if there are any; `away` is zero for others.

    It is in standard errors, or relative to friction where none are stated.
    """
    worst, rows = int(np.argmax(away)), np.flatnonzero(away)
    if not rows.size:
        return ()
    by = f"{plain(100.0 * away[worst], 2)} % of friction" if relative else f"{plain(away[worst], 2)} standard errors"
    note = Note(
        "outlying-points",
        f"{rows.size} of {away.size} points, farthest that at {shown_speed(float(speed[worst]))} and "
        f"{shown_celsius(float(temperature[worst]))} °C by {by}, lie off the others by more than "
        "chance explains and count less; check them.",
        values={
            "points": int(rows.size),
            "of": int(away.size),
            "speed": speed[rows].tolist(),
            "temperature": temperature[rows].tolist(),
            "relative" if relative else "standard_errors": away[rows].tolist(),
        },
    )
    return (note,)


def standard_errors(curves: FrictionCurves) -> Array:
    """Return standard errors of friction, moderated towards the common one relative to `friction_unit`."""
    # The scatter of few replicates is a poor estimate, with an error of a quarter for eight; weights by it would make
    # the fit worse than its errors. With ν0 the freedom of the common variance s0², that of a point is (ν0 s0² + ν
    # s²)/(ν0 + ν); ν0 follows from the scatter of ln s² beyond chance. The error of a mean then has Student's
    # distribution of ν0 + ν degrees of freedom, whose variance is larger by (ν0 + ν)/(ν0 + ν − 2) (G. K. Smyth, Stat.
    # Appl. Genet. Mol. Biol. 3 (2004) 3).
    unit = friction_unit(curves)
    errors = curves.viscoelastic_error / unit
    freedom, _ = error_freedom(curves)
    known = np.isfinite(freedom) & (errors > 0.0)
    if np.count_nonzero(known) < FEWEST_ERRORS:
        return curves.viscoelastic_error
    errors[known] = np.sqrt(moderated_variances(errors[known] ** 2, freedom[known]))
    return np.asarray(errors * unit)


def moderated_variances(variances: Array, freedom: Array) -> Array:
    """Return sample variances (n,) with their degrees of freedom (n,), shrunk towards the common one."""
    # They are those of Student's distribution.
    from scipy.special import digamma

    half = 0.5 * freedom
    logarithms = np.log(variances) - digamma(half) + np.log(half)
    prior = prior_freedom(logarithms, freedom)
    common = float(np.exp(np.mean(logarithms)))
    if np.isinf(prior):  # all have one variance
        total = float(np.sum(freedom))
        return np.full(len(variances), float(freedom @ variances) / max(total - 2.0, 0.5 * total))
    common *= float(np.exp(digamma(0.5 * prior)) / (0.5 * prior))
    together = prior + freedom
    return np.asarray((prior * common + freedom * variances) / np.maximum(together - 2.0, 0.5 * together))


def scatter_about_parabolas(curves: FrictionCurves) -> float | None:
    """Return the relative scatter about a parabola in ln v of each temperature; None if points are too few."""
    squares, freedom = 0.0, 0
    for rows in nominal_rows(curves.temperature):
        speed, friction = curves.speed[rows], curves.viscoelastic[rows]
        if np.unique(speed).size <= PARABOLA or not np.all(friction > 0.0):
            continue
        place = np.log(speed / speed.mean())
        design = np.vander(place / np.ptp(place), PARABOLA)
        values = np.log(friction)
        left = values - design @ np.linalg.lstsq(design, values, rcond=None)[0]
        squares += float(left @ left)
        freedom += len(rows) - PARABOLA
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
        x = np.log(curves.speed[rows] / np.exp(np.log(curves.speed[rows]).mean()))
        if len(rows) < _FEWEST_POINTS or not np.any(x):
            continue
        y = np.log(curves.viscoelastic[rows])
        slope = float(x @ y / (x @ x))
        left = y - y.mean() - slope * x
        own = curves.viscoelastic_error[rows] / curves.viscoelastic[rows]
        about = threshold(len(rows) - 2, STEEPER) ** 2 * float(left @ left) / (len(rows) - 2)
        by_own = threshold(np.inf, STEEPER) ** 2 * float(np.mean(own**2))
        if slope + np.sqrt(max(about, by_own) / (x @ x)) < min(STEEPEST, steepest):
            steepest, where = slope, f"{shown_celsius(float(curves.temperature[rows].mean()))} °C"
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
