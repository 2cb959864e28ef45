"""A history for one material: SI values at any time, and the material's clock, exact for linear temperatures.

At the temperature T every retardation time is α(T) τ (E(ω, T) = E(α(T) ω), T₀)).  A body whose temperature changes
follows the clock

    dξ/dt = α(T₁)/α(T(t))

with the modes at the first temperature T₁.  Between two given times T is linear; the integral is taken by
Gauss's rule on parts that are halved until it no longer changes.

References
----------
L. W. Morland, E. H. Lee, Trans. Soc. Rheol. 4 (1960) 233, doi:10.1122/1.548856.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate, islice, pairwise
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, gauss
from viscofric.errors import InputError
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Relative error of a part of the clock.
_EXACT = 1e-12
#: Change of the velocity, in the larger one, from which on a motion starts anew.
_BEND = 0.25
#: A kink of the law (of Tg, of a table) is enclosed by this many halvings.
_HALVINGS = 40
_NODES, _WEIGHTS = gauss(12)


class Reading(float):
    """Reading of a clock, s: that at a given time of a history plus the time since, so that differences are exact."""

    __slots__ = ("given", "since")
    given: float
    since: float

    def __new__(cls, given: float, since: float) -> Reading:
        """Return the sum, with both parts."""
        found = super().__new__(cls, given + since)
        found.given, found.since = given, since
        return found

    def __reduce__(self) -> tuple[type[Reading], tuple[float, float]]:
        return Reading, (self.given, self.since)

    def __sub__(self, other: float) -> float:
        if isinstance(other, Reading):
            return (self.given - other.given) + (self.since - other.since)
        return float(self) - other


class Instant(NamedTuple):
    """What is prescribed at one time, or on one side of a jump; SI."""

    time: float  # s
    clock: Reading  # the material's time ξ since the start, s
    position: Array  # (2,): m
    load: float | None = None  # load, depth, pressure, gap: the one that is prescribed
    depth: float | None = None
    pressure: float | None = None
    gap: float | None = None


@dataclass(frozen=True, eq=False)
class Schedule:
    """A history in SI units for one material."""

    #: Modes that go with the clock: those at the temperature, or at the first one if it changes
    spectrum: RetardationSpectrum
    control: str  # "load", "indentation", "pressure" or "gap"
    before: str  # "untouched", "at rest" or "sliding"
    kinks: Array  # (m,): times at which any rate changes or a value jumps, with the first and the last time; s
    _time: Array = field(repr=False)
    _value: Array = field(repr=False)
    _position: Array = field(repr=False)
    _speed: Array | None = field(repr=False)
    _temperature: Array | None = field(repr=False)
    _clocks: tuple[_Clock, ...] = field(repr=False)

    @property
    def start(self) -> float:
        """First time, s."""
        return float(self.kinks[0])

    @property
    def end(self) -> float:
        """Last time, s."""
        return float(self.kinks[-1])

    @property
    def given(self) -> Array:
        """Times of the points given, each once; s."""
        return np.unique(self._time)

    @property
    def duration(self) -> float:
        """The whole history by the material's clock, s."""
        return self.at(self.end).clock

    @property
    def largest(self) -> float:
        """Largest value of what is prescribed (load, depth, pressure or gap)."""
        return float(self._value.max())

    def insist_on_contact(self) -> float:
        """Return the largest value of what is prescribed; InputError if it is not above zero."""
        if self.largest > 0.0:
            return self.largest
        said = f"{self.control}: never above zero, so that there is no contact; give one that is."
        raise InputError(said, code="no-contact", values={"argument": self.control})

    @property
    def is_held(self) -> bool:
        """Whether a depth or gap is prescribed, without motion along the surface."""
        moves = np.any(self._position != self._position[0]) or (self._speed is not None and np.any(self._speed))
        return self.control in ("indentation", "gap") and not moves

    def jumps_at(self, time: float) -> bool:
        """Return whether two points have this time, a kink."""
        return int(np.count_nonzero(self._time == time)) == 2

    def at(self, time: float, *, after: bool = True, since: float = 0.0) -> Instant:
        """Return what is prescribed at a time, after its jump or before it, or so long after it, s."""
        # Soon after a time, the sum of both would be rounded.
        node = int(np.searchsorted(self._time, time))
        place = self._interval(time + since, after=after)
        if since > 0.0:
            first = self._interval(time, after=True)
            while place > first and (time - self._time[place]) + since <= 0.0:
                place -= 1
            place = max(place, first)
        elapsed = float((time - self._time[place]) + since)
        if since == 0.0 and node < len(self._time) and self._time[node] == time:
            clock = Reading(self._given[node], 0.0)
            node += after and self.jumps_at(time)
            value, position = float(self._value[node]), self._position[node]
        else:
            share = elapsed / (self._time[place + 1] - self._time[place])
            value = float((1.0 - share) * self._value[place] + share * self._value[place + 1])
            position = self._between(place, elapsed)
            clock = Reading(self._given[place], self._clocks[place].after(elapsed))
        named = {"depth" if self.control == "indentation" else self.control: value}
        return Instant(float(time + since), clock, position, **named)

    def velocity(self, time: float, *, after: bool = True) -> Array:
        """Return the velocity (2,) at a time, on one side of a kink, m/s; before the start, that of steady sliding."""
        if time == self.start and not after:
            if self.before != "sliding":
                return np.zeros(2)
            if self._speed is not None:
                return np.asarray(self._speed[0])
        place = self._interval(time, after=after)
        start, end = self._time[place], self._time[place + 1]
        if self._speed is None:
            return np.asarray((self._position[place + 1] - self._position[place]) / (end - start))
        share = (time - start) / (end - start)
        return np.asarray((1.0 - share) * self._speed[place] + share * self._speed[place + 1])

    def rates(self, start: float, end: float) -> tuple[float, float]:
        """Return the least and the largest dξ/dt between two times; equal times mean the side after a jump."""
        first, last = self._interval(start, after=True), self._interval(end, after=False)
        found = [
            clock.rate(min(max(time - begun, 0.0), clock.length))  # monotone within an interval
            for begun, clock in islice(zip(self._time, self._clocks, strict=False), first, max(first, last) + 1)
            if clock.length > 0.0
            for time in (start, end)
        ]
        return min(found), max(found)

    def fastest(self, start: float, end: float, *, by_clock: bool = True) -> Array:
        """Return the largest velocity (2,), per time of the material's clock or per time, between two times; m/s."""
        times = [start, *self.kinks[(self.kinks > start) & (self.kinks < end)].tolist(), end]
        found = [
            self.velocity(time, after=time == begin) / (self.rates(begin, until)[0] if by_clock else 1.0)
            for begin, until in pairwise(times)
            for time in {begin, until}
        ]
        return max(found, key=lambda velocity: math.hypot(*velocity))

    def quickest_change(self, start: float, end: float) -> float:
        """Return the largest rate of what is prescribed between two times, over its largest value, 1/s of the clock."""
        times = [start, *self.kinks[(self.kinks > start) & (self.kinks < end)].tolist(), end]
        found = [0.0]
        for begin, until in pairwise(times):
            if until > begin and self.largest > 0.0:
                first, last = (sum(filter(None, one[3:])) for one in (self.at(begin), self.at(until, after=False)))
                found.append(abs(last - first) / (self.largest * self.rates(begin, until)[0] * (until - begin)))
        return max(found)

    def since_jump(self, instant: Instant) -> float:
        """Return the time since the last jump or start, or the first contact with an untouched body, s of the clock."""
        before = self._jumps[self._jumps <= instant.time]
        return instant.clock - self.at(float(before[-1])).clock if len(before) else math.inf

    def since_control_jump(self, instant: Instant) -> tuple[float, float]:
        """Return the time since the last jump of what is prescribed, s of the clock, and what part of it jumped.

        Load, depth and energies have changed by no more than this part soon after it; at a given depth, by all.
        """
        jumps = [time for time in self._jumps.tolist() if time <= instant.time and self._jumped_part(time) > 0.0]
        if not jumps:
            return math.inf, 0.0
        return instant.clock - self.at(jumps[-1]).clock, self._jumped_part(jumps[-1])

    def _jumped_part(self, time: float) -> float:
        """Return by what part of themselves load, depth and energies may change soon after a time: 0 without a jump."""
        if time == self.start and self.before == "untouched":
            return 1.0
        before, after = self.at(time, after=False), self.at(time)
        if self.control not in ("load", "pressure"):
            return float(before[3:] != after[3:])
        one, two = (abs(float(getattr(instant, self.control))) for instant in (before, after))
        return min(1.0, 2.0 * abs(two - one) / (max(one, two) or 1.0))

    @cached_property
    def _jumps(self) -> Array:
        """Times of jumps, starts and turns, and of the first contact with an untouched body, ascending, s."""
        every = self.kinks.tolist()
        found = [time for time in every if self.jumps_at(time) or self.starts_at(time)]
        return np.array([self.start, *found] if self.before == "untouched" else found)

    def starts_at(self, time: float) -> bool:
        """Return whether a motion starts, stops or turns at a time: the velocity changes by a quarter or more."""
        before, after = (self.velocity(time, after=one) for one in (False, True))
        return math.hypot(*(after - before)) > _BEND * max(math.hypot(*before), math.hypot(*after))

    def temperature(self, time: float, *, after: bool = True) -> float | None:
        """Return the temperature at a time, K."""
        if self._temperature is None:
            return None
        place = self._interval(time, after=after)
        share = (time - self._time[place]) / (self._time[place + 1] - self._time[place])
        return float((1.0 - share) * self._temperature[place] + share * self._temperature[place + 1])

    def _interval(self, time: float, *, after: bool) -> int:
        """Return the interval of positive length that holds a time."""
        place = int(np.searchsorted(self._time, time, side="right" if after else "left")) - 1
        place = min(max(place, 0), len(self._time) - 2)
        step = 1 if after else -1
        while self._time[place + 1] == self._time[place]:
            if not 0 <= place + step < len(self._time) - 1:
                step = -step
            place += step
        return place

    @cached_property
    def _given(self) -> list[float]:
        """The clock at each given time, s."""
        return list(accumulate((clock.whole for clock in self._clocks), initial=0.0))

    def _between(self, place: int, elapsed: float) -> Array:
        """Return the position so long after the beginning of an interval."""
        share = elapsed / (self._time[place + 1] - self._time[place])
        if self._speed is None:
            return np.asarray((1.0 - share) * self._position[place] + share * self._position[place + 1])
        mean = self._speed[place] + 0.5 * share * (self._speed[place + 1] - self._speed[place])
        return np.asarray(self._position[place] + elapsed * mean)


def make_schedule(
    material: Material,
    time: Array,
    control: str,
    value: Array,
    position: Array,
    speed: Array | None,
    temperature: Array | None,
    before: str,
) -> Schedule:
    """Return the schedule of checked columns; see `viscofric.motion.history.History`."""
    changes = temperature is not None and bool(np.any(temperature != temperature[0]))
    first = None if temperature is None else float(temperature[0])
    spectrum = material.modes_at(first)
    law = material.shift if changes else None
    if changes and material.vertical_shift is not None:
        raise InputError(
            "temperature: changes in a material with a vertical shift, and moduli at constant temperatures do not "
            "determine its effect on earlier stress; give one temperature, or a Material without vertical_shift.",
            code="vertical-shift",
        )
    clocks = []
    for place in range(len(time) - 1):
        ends = None if temperature is None else (float(temperature[place]), float(temperature[place + 1]))
        clocks.append(_clock(float(time[place + 1] - time[place]), ends, law, first))
    return Schedule(
        spectrum, control, before, np.unique(time), time, value, position, speed, temperature, tuple(clocks)
    )


@dataclass(frozen=True, eq=False)
class _Clock:
    """ξ since the beginning of an interval: at the ends of parts, and by Gauss's rule within them."""

    time: Array  # ends of the parts, s since the beginning
    value: Array  # ξ there, s
    ends: tuple[float, float] | None  # temperatures
    law: ShiftLaw | None
    first: float | None

    @property
    def length(self) -> float:
        return float(self.time[-1])

    @property
    def whole(self) -> float:
        return float(self.value[-1])

    def rate(self, time: float) -> float:
        return 1.0 if self.law is None else float(self._rate(np.asarray(time)))

    def after(self, time: float) -> float:
        if self.law is None:
            return time
        place = int(np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2))
        if time == self.time[place + 1]:
            return float(self.value[place + 1])
        return float(self.value[place] + self._part(self.time[place], time))

    def _rate(self, time: Array) -> Array:
        """α(T₁)/α(T)."""
        low, high = self.ends  # type: ignore[misc]
        share = time / self.time[-1]
        decades = self.law.log10(low + share * (high - low))  # type: ignore[union-attr]
        return np.asarray(10.0 ** (self.law.log10(self.first) - decades))  # type: ignore[union-attr, arg-type]

    def _part(self, start: float, end: float) -> float:
        return float((end - start) * (_WEIGHTS @ self._rate(start + (end - start) * _NODES)))


def _clock(length: float, ends: tuple[float, float] | None, law: ShiftLaw | None, first: float | None) -> _Clock:
    both = np.array([0.0, length])
    if law is None or ends is None or length == 0.0:
        return _Clock(both, both, ends, None, first)
    whole = _Clock(both, both, ends, law, first)
    low, high = ends
    law.log10([low, high])  # raises outside the range of the law
    parts: list[tuple[float, float]] = []
    waiting = [(0.0, length, whole._part(0.0, length), 0)]
    while waiting:
        left, right, value, depth = waiting.pop()
        middle = 0.5 * (left + right)
        halves = whole._part(left, middle), whole._part(middle, right)
        settled = abs(sum(halves) - value) <= _EXACT * abs(value)
        if settled or depth == _HALVINGS or not left < middle < right:
            parts += [(middle, halves[0]), (right, halves[1])]
        else:
            waiting += [(middle, right, halves[1], depth + 1), (left, middle, halves[0], depth + 1)]
    times = np.array([0.0, *(time for time, _ in parts)])
    values = np.concatenate([[0.0], np.cumsum([value for _, value in parts])])
    return _Clock(times, values, ends, law, first)
