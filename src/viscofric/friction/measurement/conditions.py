"""Conditions of a traction test: readings of equal temperature, load, speed and slip; advice where gaps are missing."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.errors import InputError
from viscofric.nominal import LONGEST_CHAIN, SAME_LOAD, clusters, parted
from viscofric.notes import Note, Remedy, setting
from viscofric.traction import TractionRuns
from viscofric.units import shown_celsius, shown_number


@dataclass(frozen=True, eq=False)
class Course:
    """Speed and slip by which readings are grouped."""

    speed: Array  # (n,), magnitude, m/s; the same for all readings of one point
    slip: Array  # (n,), slip over that speed, above zero where the disc is faster than the ball
    notes: tuple[str, ...] = ()
    # scatter of the slip over that of `speed`, where disc and ball jitter equally and independently
    slip_scatter: float = math.sqrt(2.0)


def of_the_disc(runs: TractionRuns) -> Course:
    """Return the disc's speed of each reading; for those of one point of a test, the mean."""
    # A machine that reverses slip at a constant mean speed of disc and ball moves its disc faster with one direction of
    # slip than with the other; readings of one step and time are nevertheless one point. Where such a machine fails to
    # reverse the slip, the slip is below its error and is taken as zero.
    speed = np.abs(runs.disc_speed)
    sense = np.sign(runs.disc_speed)
    slip = sense * (runs.disc_speed - runs.ball_speed)
    notes: tuple[str, ...] = ()
    if runs.step is not None and runs.time is not None:
        timed = np.flatnonzero(np.isfinite(runs.time) & (sense != 0.0))
        _, point = np.unique(np.stack([runs.step[timed], runs.time[timed]], axis=1), axis=0, return_inverse=True)
        point = point.reshape(-1)
        opposed = np.bincount(point, slip[timed] > 0.0) * np.bincount(point, slip[timed] < 0.0) > 0.0
        unclear = timed[_unreversed(runs.step[timed], point, opposed, slip[timed] / speed[timed])]
        if unclear.size:
            largest = 1e3 * float(np.abs(slip[unclear]).max())
            note = Note(
                "slip-not-reversed",
                f"In {unclear.size} of {len(runs)} readings the slip, at most {largest:.2g} mm/s, is not reversed "
                "within the point of the test, unlike at the other points of the step; it is below its error there and "
                "is taken as zero.",
            )
            notes = (note,)
            slip[unclear] = 0.0
        for values in (speed, slip):
            size = np.abs(values[timed])
            mean = (np.bincount(point, size) / np.bincount(point))[point]
            values[timed] = np.where(opposed[point], np.copysign(mean, values[timed]), values[timed])
    return Course(speed, slip / np.where(speed > 0.0, speed, 1.0), notes)


def _unreversed(step: Integers, point: Integers, opposed: Mask, slip: Array) -> Mask:
    """Return the readings of points where small slip is not reversed though most points of the step reverse theirs."""
    several = np.bincount(point) > 1
    _, number = np.unique(step, return_inverse=True)
    step_of = np.zeros(opposed.size, dtype=np.intp)
    step_of[point] = number.reshape(-1)
    reverses = 2 * np.bincount(step_of, opposed & several) > np.bincount(step_of, several)
    size = np.abs(slip)
    largest = np.zeros(opposed.size)
    np.maximum.at(largest, point, size)
    usual = float(np.median(size[opposed[point]])) if np.any(opposed) else 0.0
    return np.asarray((several & ~opposed & reverses[step_of] & (largest < usual))[point])


def of_both(runs: TractionRuns) -> Course:
    """Return the mean speed of disc and ball of each reading, which some tests keep where slip is reversed."""
    speed = 0.5 * np.abs(runs.disc_speed + runs.ball_speed)
    slip = np.sign(runs.disc_speed) * (runs.disc_speed - runs.ball_speed)
    # The slip is a difference of two speeds, `speed` their mean.
    return Course(speed, slip / np.where(speed > 0.0, speed, 1.0), slip_scatter=2.0)


#: Field and label of the gap between nominal speeds, see `viscofric.notes.setting`.
SPEED_TOLERANCE = ("measurement.speed_tolerance", "Gap between speeds")
_NAMED = 8  # steps that a sentence names at most


@dataclass(frozen=True, eq=False)
class Gapless:
    """Note on readings without gaps."""

    runs: TractionRuns
    values: Array  # (n,), of each reading, to be grouped
    expression: str  # their name in Python
    noun: str
    shown: Callable[[float], str]
    shown_unit: str
    gap: float  # between nominal values, absolute or relative
    relative: bool = True
    # field and label of the tolerance, see `viscofric.notes.setting`; empty where it is fixed
    option: tuple[str, str] | tuple[()] = ()
    unit: str = ""  # of the tolerance

    def __call__(self, low: float, high: float) -> Note:
        """Return a note on values without a gap from `low` to `high`, with a remedy."""
        inside = (self.values >= low) & (self.values <= high)
        allowed = self.gap * (high if self.relative else 1.0)
        moving, middle = self._unsteady(inside, allowed), float(np.median(self.values[inside]))
        values = {
            "of": self.expression,
            "low": float(low),
            "high": float(high),
            "unsteady_steps": moving,
            "middle": middle,
            "within": float(allowed),
        }
        selection = self._selection(moving, f"{middle:.4g}", f"{allowed:.2g}")
        span = f"{self.shown(low)} to {self.shown(high)} {self.shown_unit}"
        words = f"{self.noun} from {span} has no gaps and cannot be grouped into nominal values"
        if not self.option:
            words += f" (a gap is {100 * self.gap:g} %); "
            return Note("no-gap", words, remedy=selection + ".", values=values)
        wide = (math.log(high / low) if self.relative else high - low) / LONGEST_CHAIN
        # Rounded up to two digits.
        wide = float(f"{1.05 * wide:.1e}")
        one = setting(*self.option, f"{wide:g}{self.unit}")
        several = f"; if there are several, one below {self.gap:g}{self.unit}; or "
        remedy = ": if there is one nominal value, give " + one + several + selection + "."
        return Note("no-gap", words, remedy=remedy, values={**values, "tolerance": wide})

    def numbered(self, rows: Integers) -> Integers:
        """Return the numbers of the nominal values of readings, ascending; InputError where they have no gaps."""
        values = self.values[rows]
        return clusters(values, self.gap * (values if self.relative else np.ones(values.size)), self)

    def _unsteady(self, inside: Mask, allowed: float) -> list[int]:
        """Return the steps whose values change by more than is allowed, if these are some and few."""
        if self.runs.step is None:
            return []
        steps = np.unique(self.runs.step[inside]).tolist()
        spans = [np.ptp(self.values[inside & (self.runs.step == step)]) for step in steps]
        moving = [step for step, span in zip(steps, spans, strict=True) if span > allowed]
        return moving if len(moving) <= _NAMED and len(moving) < np.unique(self.runs.step).size else []

    def _selection(self, moving: list[int], middle: str, allowed: str) -> Remedy:
        """Return the selection to make: all steps except unsteady ones, or values near the median."""
        if moving:
            words = f"step {moving[0]} is" if len(moving) == 1 else f"steps {', '.join(map(str, moving))} are"
            listed = ",".join(map(str, moving))
            return f"{words} not steady; leave such steps out, by " + Remedy(
                f"runs.select(except_steps={moving})",
                f"--except-steps {listed}",
                f"except_steps = {moving} under [measurement]",
                f"“Steps to leave out”: {listed.replace(',', ', ')}",
                "measurement.except_steps",
            )
        return "leave out unsteady readings" + Remedy(
            f", such as by runs.select(abs({self.expression} - {middle}) < {allowed})",
            " (--except-steps)",
            " (except_steps under [measurement])",
            " by “Steps to leave out”",
            "measurement.except_steps",
        )


# Width of the intervals that swept slip is cut into, in tolerances: the largest range of readings of one slip.
_INTERVAL = 4.0
# Slip over speed below which a ball rolls, however still the speeds are.
_PURE_ROLLING = 1e-3


@dataclass(frozen=True, eq=False)
class Condition:
    """The readings taken at one temperature, load, magnitude of the disc's speed and magnitude of the slip."""

    rows: Integers  # (n,), of the traction runs
    temperature: float  # K, mean over all readings of that nominal temperature
    speed: float  # m/s, mean over all readings of that nominal speed
    load: float  # N, mean over the condition
    slip: float  # m/s, mean over the condition
    disc_sign: Array  # (n,), sgn(u_disc) = ±1
    slip_sign: Array  # (n,), sgn(u_disc − u_ball) = ±1, or 0 in pure rolling

    def __str__(self) -> str:
        return f"{shown_celsius(self.temperature)} °C and {1e3 * self.speed:.4g} mm/s"

    @cached_property
    def signs(self) -> frozenset[tuple[int, int]]:
        """The different pairs of sgn(u_disc) and sgn(u_disc − u_ball)."""
        return frozenset((round(one / 3), one - 3 * round(one / 3)) for one in set(self.configurations.tolist()))

    @cached_property
    def configurations(self) -> Integers:
        """Number of the sign configuration of each reading."""
        return np.asarray(3 * self.disc_sign + self.slip_sign, dtype=np.int64)

    def alike(self, other: Condition) -> bool:
        """Whether another condition has the same temperature, and a load within the tolerance."""
        return self.temperature == other.temperature and abs(other.load - self.load) <= SAME_LOAD * self.load

    def beside(self, other: Condition) -> bool:
        """Whether another condition has the same speed, too, at whatever slip."""
        return self.speed == other.speed and self.alike(other)

    def regressors(self, *, offset: bool, coulomb: bool) -> Array:
        """Return the signs (n, 3) of zero, viscoelastic and Coulomb friction; zeros for what is not fitted."""
        count = self.rows.size
        return np.stack([np.full(count, float(offset)), self.disc_sign, self.slip_sign * float(coulomb)], axis=1)

    def determines(self, *, offset: bool, coulomb: bool) -> bool:
        """Whether the signs alone, whatever the jitter of the loads, determine the unknowns."""
        return _full_rank(self.signs, offset, coulomb)


@lru_cache(maxsize=512)
def _full_rank(signs: frozenset[tuple[int, int]], offset: bool, coulomb: bool) -> bool:
    unknowns = 1 + offset + (coulomb and any(slip for _, slip in signs))
    columns = [(float(offset), disc, slip * coulomb) for disc, slip in signs]
    return int(np.linalg.matrix_rank(np.array(columns))) == unknowns


def conditions(
    runs: TractionRuns,
    course: Course,
    speed_tolerance: float,
    temperature_tolerance: float,
    load_tolerance: float = SAME_LOAD,
) -> tuple[list[Condition], tuple[str, ...]]:
    """Group the readings of a traction test by their measured temperature, load, speed and slip, in this order."""
    # Values are sorted, and a gap wider than the tolerance starts the next nominal value. The tolerance of temperature
    # is in K, those of speed and load are relative. The tolerance of the slip ratio follows from the measured
    # jitter of the speeds, since slip is a small difference of two of them: it is three standard deviations of that
    # difference, at least a tenth of the speeds' tolerance. Slip of either sense within it, or with a mean within three
    # of its own standard deviations, is pure rolling. Slip that was swept without gaps is cut into intervals four
    # tolerances wide. Readings at zero speed of the disc are left out. Returns notes too: on readings left out, taken
    # as pure rolling, or cut into intervals.
    moving = np.flatnonzero((runs.disc_speed != 0.0) & (course.speed > 0.0))
    notes = list(course.notes)
    if moving.size < len(runs):
        notes.append(
            Note(
                "disc-at-rest",
                f"{len(runs) - moving.size} of {len(runs)} readings were taken with the disc at rest and left out.",
                values={"readings": len(runs) - moving.size, "of": len(runs)},
            )
        )
    if not moving.size:
        return [], tuple(notes)
    temperature, speed, load = runs.temperature[moving], course.speed[moving], runs.load[moving]
    of_temperature = Gapless(
        *(runs, runs.temperature, "runs.temperature", "temperature", shown_celsius, "°C", temperature_tolerance),
        relative=False,
        option=("measurement.temperature_tolerance", "Gap between temperatures"),
        unit=" K",
    )
    of_load = Gapless(runs, runs.load, "runs.load", "load", lambda one: shown_number(one, ".4g"), "N", load_tolerance)
    of_speed = Gapless(
        *(runs, course.speed, "abs(runs.disc_speed)", "disc_speed", lambda one: shown_number(1e3 * one, ".4g"), "mm/s"),
        speed_tolerance,
        option=SPEED_TOLERANCE,
    )
    isotherm, loading, pace = (one.numbered(moving) for one in (of_temperature, of_load, of_speed))
    mean_speed = np.bincount(pace, speed) / np.bincount(pace)
    mean_temperature = np.bincount(isotherm, temperature) / np.bincount(isotherm)
    jitter = _jitter(speed / mean_speed[pace], np.stack([pace, course.slip[moving] > 0.0], axis=1))
    jittering = 3.0 * course.slip_scatter * jitter
    slip = np.abs(runs.disc_speed[moving] - runs.ball_speed[moving])
    disc_sign = np.sign(runs.disc_speed[moving])
    found, swept = [], 0
    for here in equal_rows(np.stack([isotherm, loading, pace], axis=1)):
        direction, sliding, cut = _slips(course.slip[moving][here], speed_tolerance, jittering)
        swept += cut
        for part in equal_rows(sliding):
            rows = here[part]
            found.append(
                Condition(
                    rows=moving[rows],
                    temperature=float(mean_temperature[isotherm[rows[0]]]),
                    speed=float(mean_speed[pace[rows[0]]]),
                    load=float(load[rows].mean()),
                    slip=float(slip[rows].mean()),
                    disc_sign=disc_sign[rows],
                    slip_sign=disc_sign[rows] * direction[part],
                )
            )
    rolling = [one for one in found if not np.any(one.slip_sign) and one.slip > 0.0]
    if rolling:
        notes.append(
            Note(
                "slip-is-rolling",
                f"{where(rolling, len(found))} the slip ({1e3 * rolling[0].slip:.2g} mm/s) is not significant "
                "and is taken as pure rolling; viscoelastic friction includes Coulomb friction of such slip.",
            )
        )
    if swept:
        notes.append(
            Note(
                "slip-swept",
                f"At {swept} set{'s' if swept > 1 else ''} of temperature, load and speed the slip was swept without "
                "gaps and is cut into intervals; Coulomb friction is its mean over each of them.",
            )
        )
    return found, tuple(notes)


def _jitter(speed: Array, senses: Integers) -> float:
    """Return the standard deviation of relative speeds, apart from their difference between the senses of slip."""
    # Where a ball rolls, the sense of its slip is jitter too, and the speeds of one sense scatter less than all do, by
    # a factor of √(1 − 2/π) = 0.603 where the disc alone jitters and all is normal.
    apart = speed.copy()
    for rows in equal_rows(senses):
        apart[rows] -= speed[rows].mean()
    return min(float(np.std(speed)), float(np.std(apart)) / math.sqrt(1.0 - 2.0 / math.pi))


def equal_rows(keys: Integers) -> list[Integers]:
    """Return the indices of equal keys, numbers (n,) or rows (n, k), in ascending order of the keys."""
    _, number = np.unique(keys, axis=0, return_inverse=True)
    return parted(number.reshape(-1), 0)


def where(some: list[Condition], total: int) -> str:
    """Return the conditions as the start of a sentence; of several, their number and the first."""
    if len(some) == 1:
        return f"At {some[0]}"
    return f"At {len(some)} of {total} conditions, the first being {some[0]},"


def _slips(ratio: Array, tolerance: float, jittering: float) -> tuple[Array, Integers, bool]:
    """Return the sense of sliding (±1 or 0), indices of the magnitudes above what jitter makes, and whether swept."""
    resolution = max(0.1 * tolerance, jittering)

    def numbered(values: Array) -> Integers:
        return clusters(
            values,
            np.maximum(tolerance * np.abs(values), resolution),
            # Not seen by users: slip without gaps is cut into intervals.
            lambda low, high: f"slip from {low:.3g} to {high:.3g} of the disc's speed has no gap.",
        )

    try:
        signed = numbered(ratio)
        count = np.bincount(signed)
        mean = np.bincount(signed, ratio) / count
        low, high = np.full(count.size, np.inf), np.full(count.size, -np.inf)
        np.minimum.at(low, signed, ratio)
        np.maximum.at(high, signed, ratio)
        rolls = ((low <= 0.0) & (high >= 0.0)) | (np.abs(mean) < np.maximum(_PURE_ROLLING, jittering / np.sqrt(count)))
        direction = np.where(rolls, 0.0, np.sign(mean))[signed]
        magnitude = np.where(rolls, 0.0, np.abs(mean))[signed]
        # Rolling and sliding are separate, however slow.
        return direction, np.where(direction == 0.0, 0, numbered(magnitude) + 1), False
    except InputError:
        pass
    size = np.abs(ratio)
    direction = np.where(size < resolution, 0.0, np.sign(ratio))
    # In tolerances, which are absolute below the knee and relative above it.
    knee = resolution / tolerance
    steps = np.where(size < knee, size / resolution, (1.0 + np.log(np.maximum(size / knee, 1.0))) / tolerance)
    return direction, np.where(direction == 0.0, 0, 1 + (steps / _INTERVAL).astype(np.int64)), True
