"""Measurements of a mini-traction machine, reading by reading and step by step."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import insist_on, sentences, text
from viscofric.arrays import Array, Integers, Mask
from viscofric.data import picked, read_only, whole_numbers, with_rows
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, brief
from viscofric.notes import Note, Remedy, setting
from viscofric.showing import Plotted, Rows, Shown
from viscofric.units import COLDEST_PLAUSIBLE, shown_celsius


@dataclass(frozen=True)
class TractionStep(Shown):
    """One step of a traction test.

    Attributes
    ----------
    number : int
        As in `TractionRuns.step`: that of the file, counted on through all files.
    source : str
        The file that holds the step.
    kind, description, started : str
        As in the file: ``"BOD_TIMED"``, ``"running-in"``, ``"23/03/2018 10:12:01"``; else empty.
    readings : int
        Number of its readings.
    load, temperature, speed : float
        Means over its readings: N, K and the magnitude of the disc's speed, m/s.
    slip_ratio : float
        Mean of ``|u_disc - u_ball|`` over the mean of the two speeds' magnitudes.
    """

    number: int
    source: str = ""
    kind: str = ""
    description: str = ""
    started: str = ""
    readings: int = 0
    load: float = math.nan
    temperature: float = math.nan
    speed: float = math.nan
    slip_ratio: float = math.nan

    def _shown(self) -> Rows:
        return (
            ("number", self.number),
            ("kind", self.kind or None),
            ("description", self.description or None),
            ("readings", self.readings),
            ("load", self.load, "N"),
            ("temperature", self.temperature, "°C"),
            ("speed", self.speed, "m/s"),
            ("slip", self.slip_ratio, "%"),
        )

    def __str__(self) -> str:
        words = ", ".join(word for word in (self.kind, self.description and repr(self.description)) if word)
        what = f"step {self.number}" + (f" ({words})" if words else "")
        means = f"{self.load:.4g} N, {shown_celsius(self.temperature)} °C, {1e3 * self.speed:.4g} mm/s"
        return f"{what}: {self.readings} readings at {means}, slip {100 * self.slip_ratio:.3g} %"


#: Column of `TractionRuns` -> unit, long name.
_COLUMNS = {
    "disc_speed": ("m/s", "signed surface velocity of the disc"),
    "ball_speed": ("m/s", "signed surface velocity of the ball"),
    "traction_force": ("N", "signed traction force, zero reading included"),
    "load": ("N", "normal load"),
    "temperature": ("K", "temperature"),
    "replicate": ("1", "number of the repetition"),
    "zero_force": ("N", "reading of the force cell without traction"),
    "time": ("s", "time since the first reading"),
    "step": ("1", "number of the step"),
    "track_radius": ("m", "radius of the ball's track on the disc"),
}

#: Above every friction coefficient of rubber; larger values have another unit, or are damaged.
LARGEST_FRICTION = 10.0
#: Where all coefficients are smaller, a force has another unit: no force cell resolves them.
LEAST_FRICTION = 1e-4
#: No friction test of rubber is as fast.
LARGEST_SPEED = 100.0  # m/s
#: Rubbers are tested within this: temperatures that are all above it look like kelvin taken for °C, below it like °C.
PLAUSIBLE_TEMPERATURES = (COLDEST_PLAUSIBLE, 473.15)  # K


def notes_on_friction(friction: ArrayLike, temperature: ArrayLike, speed: ArrayLike) -> tuple[Note, ...]:
    """Return notes on friction coefficients, temperatures (K) and speeds (m/s) that suggest a wrong unit."""
    sizes = np.abs(np.asarray(friction, dtype=float))
    kelvin, fastest = np.asarray(temperature, dtype=float), float(np.max(np.abs(speed), initial=0.0))
    largest = float(np.max(sizes, initial=0.0))
    notes = []
    count = int(np.count_nonzero(sizes > LARGEST_FRICTION))
    if count or 0.0 < largest < LEAST_FRICTION:
        said = f"{count} of {sizes.size} friction coefficients are above {LARGEST_FRICTION:g}, up to {largest:.3g}"
        if not count:
            said = f"No friction coefficient is above {largest:.2g}"
        said += "; check the units of force and load, and the zero of the force."
        notes.append(Note("implausible-friction", said, values={"largest": largest}))
    if kelvin.size and (kelvin.max() < PLAUSIBLE_TEMPERATURES[0] or kelvin.min() > PLAUSIBLE_TEMPERATURES[1]):
        cold = kelvin.max() < PLAUSIBLE_TEMPERATURES[0]
        low, high = (f"{one:.4g}" if cold else shown_celsius(one) for one in (kelvin.min(), kelvin.max()))
        said = f"{low} to {high} K look like °C" if cold else f"{low} to {high} °C look like kelvin"
        notes.append(Note("implausible-temperature", f"Temperatures of {said}; check the unit of the temperature."))
    if fastest > LARGEST_SPEED:
        said = f"Speeds reach {fastest:.4g} m/s, more than any friction test of rubber; check the unit of the speeds."
        notes.append(Note("implausible-speed", said, values={"fastest": fastest}))
    return tuple(notes)


#: Friction repeats no better, as a part of it.
REPEATS = 0.01


def notes_on_copies(measured: ArrayLike, *columns: ArrayLike) -> tuple[Note, ...]:
    """Return a note on rows, at least half of them equal to others, unless rounding of what was measured (n,) does."""
    rows = np.stack([np.asarray(column, dtype=float) for column in (measured, *columns)], axis=1)
    count = len(rows) - len(np.unique(rows, axis=0))
    if not count or 2 * count < len(rows):
        return ()
    expected = _equal_by_rounding(rows[:, 0], np.unique(rows[:, 1:], axis=0, return_inverse=True)[1].ravel())
    if count <= expected + 3.0 * np.sqrt(expected):
        return ()
    said = f"{count} of {len(rows)} rows are equal to others in all columns and count as measurements of their own"
    remedy = "; if they are copies, leave them out: errors would be too small."
    return (Note("copied-rows", said + remedy, values={"rows": count, "of": len(rows)}),)


def _equal_by_rounding(measured: Array, condition: Integers) -> float:
    """Return how many of the readings (n,) rounding is expected to make equal to others of their condition (n,)."""
    from scipy.special import ndtr

    steps = np.diff(np.unique(measured))
    steps = steps[steps > 1e-9 * np.abs(measured).max()]
    if not steps.size:  # one value, rounded by an unknown amount
        return 0.0
    resolution, equal = float(steps.min()), 0.0
    order = np.argsort(condition, kind="stable")
    for values in np.split(measured[order], np.flatnonzero(np.diff(condition[order])) + 1):
        scatter = max(float(np.std(values)), REPEATS * abs(float(np.mean(values))), 0.1 * resolution)
        if len(values) * resolution < 0.1 * scatter:  # pairs only, of ρ(x) resolution: ∫ρ² = 1/(2 √π scatter)
            equal += 0.25 * len(values) * (len(values) - 1.0) * resolution / (np.sqrt(np.pi) * scatter)
            continue
        reach = min(np.ceil(5.0 * scatter / resolution), 1e5) + 0.5
        ends = (np.arange(-reach, reach + 1.0) * resolution + values[0] - np.mean(values)) / scatter
        equal += len(values) - float(np.sum(1.0 - (1.0 - np.diff(ndtr(ends))) ** len(values)))
    return equal


@dataclass(frozen=True, eq=False)
class TractionRuns(Plotted):
    """Traction measurements of a mini-traction machine, one row per reading.

    Velocities are signed: the sign of `disc_speed` is the direction in which the rubber is deformed, the
    sign of ``disc_speed - ball_speed`` that of sliding.

    Parameters
    ----------
    disc_speed, ball_speed : (n,) array
        Signed surface velocities, m/s.
    traction_force : (n,) array
        Signed force on the ball's force cell, zero reading included, N.
    load : (n,) array
        Measured normal load, N.
    temperature : (n,) array
        K.
    replicate : (n,) array of int
        Number of the repetition that a row belongs to.  Readings of one `step` are never repetitions.
    source : str
        Origin, such as names of files.
    notes : tuple of str
        What the reader found doubtful or changed: one sentence each.
    zero_force : (n,) array, optional
        Reading of the force cell without traction, N; NaN where it was not recorded.
    time : (n,) array, optional
        Since the first reading, s; NaN where it was not recorded.
    step : (n,) array of int, optional
        Number of the step of the test that a row belongs to, counted through all files.
    track_radius : (n,) array, optional
        Of the ball's track on the disc, m; NaN where it was not recorded.
    steps : tuple of TractionStep
        The steps that `step` numbers, as described in the files; counts and means are those of the rows, and steps
        without rows are left out.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> disc, ball = np.array([-0.1, -0.1, 0.1, 0.1]), np.array([-0.15, -0.05, 0.15, 0.05])
    >>> force = 0.3 + 1.1 * np.sign(disc - ball) + 0.4 * np.sign(disc)
    >>> runs = vf.readers.TractionRuns(
    ...     disc, ball, force, load=np.full(4, 25.0), temperature=np.full(4, 303.15), replicate=np.ones(4)
    ... )
    >>> vf.separate(runs).coulomb.round(3)  # 1.1 N of 25 N
    array([0.044])
    """

    disc_speed: Array
    ball_speed: Array
    traction_force: Array
    load: Array
    temperature: Array
    replicate: Integers
    source: str = ""
    notes: tuple[str, ...] = ()
    zero_force: Array | None = None
    time: Array | None = None
    step: Integers | None = None
    track_radius: Array | None = None
    steps: tuple[TractionStep, ...] = ()

    def __post_init__(self) -> None:
        rows = read_only(self.disc_speed, "disc_speed of traction runs").size
        for name in ("disc_speed", "ball_speed", "traction_force", "load", "temperature"):
            column = read_only(getattr(self, name), f"{name} of traction runs")
            if column.shape != (rows,) or not np.all(np.isfinite(column)):
                raise InputError(
                    f"{name} of traction runs must be one row of finite numbers, one per reading.", code="not-a-number"
                )
            object.__setattr__(self, name, column)
        for name in ("zero_force", "time", "track_radius"):
            if getattr(self, name) is None:
                continue
            column = read_only(getattr(self, name), f"{name} of traction runs")
            if column.shape != (rows,) or np.any(np.isinf(column)):
                raise InputError(
                    f"{name} of traction runs must hold one number per reading, NaN where it is not known.",
                    code="wrong-length",
                )
            object.__setattr__(self, name, column)
        for name in ("replicate", "step"):
            if getattr(self, name) is None and name == "step":
                continue
            numbers = whole_numbers(getattr(self, name), f"{name} of traction runs")
            if numbers.shape != (rows,):
                raise InputError(
                    f"{name} of traction runs must hold one whole number per reading.", code="not-a-whole-number"
                )
            object.__setattr__(self, name, numbers)
        if rows and not np.all(self.load > 0):
            raise InputError("load of traction runs must be above zero in every reading.", code="not-positive")
        text(self.source, "source of traction runs")
        object.__setattr__(self, "notes", sentences(self.notes, "notes of traction runs"))
        insist_on(self.steps, "steps", tuple, list, right="a tuple of TractionStep")
        for one in self.steps:
            insist_on(one, "one of the steps", TractionStep)
        object.__setattr__(self, "steps", _summarised(self, self.steps))

    def __len__(self) -> int:
        return len(self.disc_speed)

    def _shown(self) -> Rows:
        return (
            ("readings", len(self)),
            ("disc speed", self.disc_speed, "m/s"),
            ("ball speed", self.ball_speed, "m/s"),
            ("load", self.load, "N"),
            ("temperature", self.temperature, "°C"),
            ("traction force", self.traction_force, "N"),
            ("replicates", len(np.unique(self.replicate))),
            ("steps", self.steps),
            ("source", self.source or None),
            ("notes", self.notes),
        )

    def select(
        self,
        rows: ArrayLike | None = None,
        *,
        steps: int | Sequence[int] | None = None,
        except_steps: int | Sequence[int] | None = None,
    ) -> TractionRuns:
        """Return some of the readings: ``runs.select(runs.temperature > 330)``, ``runs.select(steps=[2, 4])``.

        Parameters
        ----------
        rows : (n,) array of bool, or array of int, optional
            Which readings to keep, or their places; if left out, all.
        steps, except_steps : int or sequence of int, optional
            Numbers of the steps to keep, or to leave out, of these readings.

        Returns
        -------
        TractionRuns
            With a note on how many readings it holds; times and replicate numbers stay as they are.

        Raises
        ------
        InputError
            If nothing is selected, `rows` does not fit the readings, or there are no such steps.
        """
        chosen = np.arange(len(self)) if rows is None else picked(rows, len(self), "readings")
        for name, wanted, keep in (("steps", steps, True), ("except_steps", except_steps, False)):
            if wanted is not None:
                chosen = chosen[self._in_steps(name, wanted)[chosen] == keep]
        if not chosen.size:
            raise InputError(
                "the selection contains no reading; the steps are listed by runs.steps.", code="wrong-selection"
            )
        counts = {"readings": int(chosen.size), "of": len(self)}
        note = Note("readings-selected", f"{chosen.size} of {len(self)} readings are selected.", values=counts)
        return replace(with_rows(self, chosen), notes=(*self.notes, note))

    def to_dataset(self) -> Dataset:
        """Return the readings along the dimension ``reading``.

        Returns
        -------
        xarray.Dataset
            The columns of the runs under the same names, in the same units; those that were not recorded are left out.
            The attribute is ``source``.
        """
        columns = {name: (getattr(self, name), *meaning) for name, meaning in _COLUMNS.items()}
        return dataset(
            "reading",
            {name: None if entry[0] is None else entry for name, entry in columns.items()},
            attributes={"source": self.source},
        )

    def _in_steps(self, name: str, wanted: int | Sequence[int]) -> Mask:
        """Return which readings belong to some steps, which must exist."""
        numbers = np.atleast_1d(whole_numbers(wanted, name))
        argument = Remedy(f"{name} = {brief(wanted)}")
        if name == "except_steps":
            argument = setting("measurement.except_steps", "Steps to leave out", ",".join(map(str, numbers)))
        if self.step is None:
            raise InputError("", code="no-steps", remedy=argument + ": these traction runs have no numbers of steps.")
        known = np.isin(numbers, self.step)
        if not np.all(known):
            there = f": there is no step {numbers[~known][0]}; steps go from {self.step.min()} to {self.step.max()}."
            raise InputError("", code="no-such-step", remedy=argument + there)
        return np.isin(self.step, numbers)


def _summarised(runs: TractionRuns, known: Iterable[TractionStep]) -> tuple[TractionStep, ...]:
    """Return the steps that have readings, in the order of their numbers, with counts and means of these."""
    if runs.step is None or not len(runs):
        return ()
    numbers, place, counts = np.unique(runs.step, return_inverse=True, return_counts=True)
    stated = {step.number: step for step in known}

    def mean(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[float]:
        return [float(value) for value in np.bincount(place, values) / counts]

    disc, ball = np.abs(runs.disc_speed), np.abs(runs.ball_speed)
    slip = np.bincount(place, np.abs(runs.disc_speed - runs.ball_speed))
    rolling = np.bincount(place, 0.5 * (disc + ball))
    ratio = np.divide(slip, rolling, out=np.zeros(slip.shape), where=rolling > 0.0)
    columns = zip(numbers, counts, mean(runs.load), mean(runs.temperature), mean(disc), ratio, strict=True)
    return tuple(
        replace(
            stated.get(int(number), TractionStep(int(number))),
            readings=int(count),
            load=load,
            temperature=temperature,
            speed=speed,
            slip_ratio=float(slip_ratio),
        )
        for number, count, load, temperature, speed, slip_ratio in columns
    )
