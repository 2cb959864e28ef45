"""The usable rows of a record, averaged, and the fewest knots of what was prescribed."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array, Integers, scatter
from viscofric.contact.indenters.indenter import Indenter
from viscofric.friction.identification.indentation.contact import Contact, Points, Trial
from viscofric.friction.identification.indentation.record import IndentationRecord
from viscofric.motion.springs import PLACES, SHARES, elastic_radius, profile
from viscofric.rheology.spectra.misfit import REACH

#: Rows are averaged over so many equal parts of each decade of time since the last kink of the prescribed quantity.
PARTS = 20
#: … or since the first row, if there are more kinks than this; not at all, if the contact shrinks.
MOST_KINKS = 12
#: Allowed error of omitting knots of the prescribed quantity, relative to its largest value; for many rows also their
#: scatter, up to a part of the largest value.
SIMPLIFIED, MANY_ROWS, SCATTERS, MOST_SIMPLIFIED = 1e-6, 400, 3.0, 1e-3
#: A smaller fall of the depth, relative to the largest depth, does not count as shrinking.
LEAST_FALL = 1e-4
#: A response below this many standard errors is left out: the error of its logarithm is not normal.
CLEAR = 5.0
#: So is one below this part of the largest while the contact shrinks: it depends on the zeros of load and depth.
ENDING = 0.05
#: X is tabulated up to this multiple of the contact radius at the largest depth, as errors extend beyond it.
BEYOND, _RADII = 2.0, 400


class Reduced:
    """X(δ) of a body of revolution, m²: the load over the plane-strain modulus E/(1−ν²)."""

    def __init__(self, indenter: Indenter, largest: float) -> None:
        self._radius = elastic_radius(indenter, largest, None, 1.0)
        self._depths = self._values = None
        if not indenter.has_walls:
            radii = self._radius * np.geomspace(1e-6, BEYOND, _RADII)
            self._depths = profile(indenter, radii)
            inner = profile(indenter, radii[:, None] * PLACES) @ SHARES
            self._radii = radii
            self._values = 2.0 * radii * (self._depths - inner)

    def __call__(self, depth: Array) -> Array:
        """Return X, m², zero above the surface."""
        pressed = np.maximum(depth, 0.0)
        if self._depths is None or self._values is None:
            return np.asarray(2.0 * self._radius * pressed)
        least = float(self._depths[0])
        logs = np.interp(np.log(np.maximum(pressed, least)), np.log(self._depths), np.log(self._values))
        return np.asarray(np.where(pressed > least, np.exp(logs), 0.0))

    def slope(self, depth: Array) -> Array:
        """Return dX/dδ, the contact diameter, m."""
        pressed = np.maximum(depth, 0.0)
        if self._depths is None:
            return np.where(pressed > 0.0, 2.0 * self._radius, 0.0)
        logs = np.interp(np.log(np.maximum(pressed, float(self._depths[0]))), np.log(self._depths), np.log(self._radii))
        return np.asarray(np.where(pressed > 0.0, 2.0 * np.exp(logs), 0.0))

    @property
    def radius(self) -> float:
        """Contact radius at the largest depth, m."""
        return self._radius


@dataclass(frozen=True, eq=False, kw_only=True)
class Rows(Points):
    """Usable rows of a record, averaged to its points."""

    creep: bool  # whether the load was prescribed: the response is then X in m², else the load in N
    time: Array  # (r,), since the start, s
    depth: Array  # (r,), m, not below zero
    average: Array  # (n, r)
    knots: Array  # (k,), s
    values: Array  # (k,), what was prescribed, linear between the knots
    unclear: int  # rows of the contact left out, as the response is not clearly above its scatter


class RowsContact(Rows, Contact):
    """What contacts of averaged rows have in common."""

    def ends(self, trial: Trial) -> tuple[float, float, float]:
        """Return the angular frequencies, rad/s, of which steps over the measured times hold E'' and |E|."""
        short, long = self.lags
        high = REACH["creep" if self.creep else "relaxation"] / short
        return 1.0 / long, max(high, 1.0 / long), 1.0 / short


def usable_rows(record: IndentationRecord, reduced: Reduced, shrinks: int) -> Rows | None:
    """Return the usable rows of a record, whose contact shrinks from a row on; None without any."""
    time = record.time - record.start
    creep = record.control == "load"
    load, depth = (np.maximum(column, 0.0) for column in (record.load, record.indentation))
    prescribed, measured = (load, depth) if creep else (depth, load)
    prescribed[: _contact(prescribed)] = 0.0
    response = reduced(depth) if creep else load
    error = None
    if record.error is not None:
        up = record.indentation + record.error
        moved = reduced(up) - response if creep else record.error
        error = moved / np.maximum(response, 1e-300)
    knots, values = _knots(time, prescribed)
    bends, jumps = changes(knots, values)
    kinks = knots[(bends != 0.0) | (jumps != 0.0)]
    jumping = knots[jumps != 0.0]
    before = max(int(np.argmax(values > 0.0)) - 1, 0)
    starts, early = float(knots[before]), int(knots[before + 1] > knots[before])
    knots, values = (np.append(one[before : before + early], one[before:]) for one in (knots, values))
    after = (time > starts) & ~np.isin(time, jumping)
    clear = after & (response > 0.0)
    clear &= measured > CLEAR * scatter(measured) if error is None else error < 1.0 / CLEAR
    late = np.arange(len(time)) >= shrinks
    clear &= ~late | ((load > ENDING * load.max()) & (response > ENDING * response.max()))
    unclear = int(np.count_nonzero(after & ~clear))
    if not (len(kinks) and np.any(clear)):
        return None
    time, response = time[clear], response[clear]
    last = np.searchsorted(kinks, time, side="left") - 1 if len(kinks) <= MOST_KINKS else np.zeros(len(time), int)
    since = time - kinks[last]
    number = np.arange(len(time)) if np.any(late) and len(kinks) > MOST_KINKS else _parts(since, last)
    count = np.bincount(number).astype(float)
    average = np.zeros((len(count), len(number)))
    average[number, np.arange(len(number))] = 1.0 / count[number]
    mean = average @ response
    return Rows(
        along=average @ time,
        response=mean,
        error=None if error is None else np.sqrt((average**2) @ (error[clear] * response) ** 2) / mean,
        count=count,
        lags=(float(since.min()), float(time.max() - kinks[0])),
        parts=(("X" if creep else "load", slice(0, len(count))),),
        creep=creep,
        time=time,
        depth=depth[clear],
        average=average,
        knots=knots,
        values=values,
        unclear=unclear,
    )


def _contact(prescribed: Array) -> int:
    """Return the row before which a record shows no more than scatter: the approach to the surface."""
    return int(np.argmax(prescribed > SCATTERS * scatter(prescribed)))


def shrinks(record: IndentationRecord) -> int:
    """Return the row from which the contact shrinks; the number of rows if it does not."""
    # It may shrink once the prescribed quantity falls by more than its scatter. Under a falling load the depth may
    # still grow for a while.
    prescribed = record.load if record.control == "load" else record.indentation
    largest = np.maximum.accumulate(prescribed)
    noise, least = scatter(prescribed), LEAST_FALL * float(np.max(prescribed))
    fallen = np.flatnonzero(largest - prescribed > max(8.0 * noise, least))
    if not len(fallen):
        return len(prescribed)
    peak = largest[fallen[0]]
    begins = int(np.flatnonzero(prescribed[: fallen[0]] >= peak - max(3.0 * noise, 0.1 * least))[-1]) + 1
    if record.control == "indentation":
        return begins
    depth = record.indentation
    allowed = max(3.0 * scatter(depth), LEAST_FALL * float(np.max(depth)))
    shrunk = np.flatnonzero((np.maximum.accumulate(depth) - depth > allowed)[begins:])
    return begins + int(shrunk[0]) if len(shrunk) else len(depth)


def _knots(time: Array, values: Array) -> tuple[Array, Array]:
    """Return the fewest knots between which the prescribed quantity is linear, to its scatter; zero before."""
    most = float(np.max(values))
    tolerance = SIMPLIFIED * most
    if len(values) > MANY_ROWS:
        tolerance = max(tolerance, min(SCATTERS * scatter(values), MOST_SIMPLIFIED * most))
    keep = np.zeros(len(time), dtype=bool)
    keep[[0, -1]] = True
    keep[1:] |= np.diff(time) == 0.0  # jumps
    keep[:-1] |= np.diff(time) == 0.0
    places = np.flatnonzero(keep)
    pieces = list(pairwise(places))
    while pieces:  # D. H. Douglas, T. K. Peucker, Cartographica 10 (1973) 112
        low, high = pieces.pop()
        if high - low < 2 or time[high] == time[low]:
            continue
        share = (time[low : high + 1] - time[low]) / (time[high] - time[low])
        away = np.abs(values[low : high + 1] - values[low] - share * (values[high] - values[low]))
        worst = low + int(np.argmax(away))
        if away[worst - low] > tolerance:
            keep[worst] = True
            pieces += [(low, worst), (worst, high)]
    knots, chosen = time[keep], values[keep]
    level = np.isclose(np.diff(chosen), 0.0, rtol=0.0, atol=tolerance)
    chosen = chosen.copy()
    for place in np.flatnonzero(level):  # a hold is level
        chosen[place + 1] = chosen[place]
    # Before the start nothing acts; the first value acts from there on.
    early = 2 if knots[0] > 0.0 else 1
    return np.append(np.zeros(early), knots), np.concatenate([[0.0], np.repeat(chosen[0], early - 1), chosen])


def changes(knots: Array, values: Array) -> tuple[Array, Array]:
    """Return the change of slope and the jump at each knot."""
    steps, rises = np.diff(knots), np.diff(values)
    slopes = np.divide(rises, steps, out=np.zeros_like(rises), where=steps > 0.0)
    changes = np.zeros(len(knots))
    changes[:-1] += slopes
    changes[1:] -= slopes
    jumps = np.zeros(len(knots))
    jumps[1:] = np.where(steps == 0.0, rises, 0.0)
    return changes, jumps


def _parts(since: Array, kink: Integers) -> Integers:
    """Return the number of the average that each row belongs to."""
    part = np.floor(np.log10(np.maximum(since, 1e-300)) * PARTS + 1e-9).astype(np.int64)
    return np.asarray(np.unique(np.stack([kink, part], axis=1), axis=0, return_inverse=True)[1]).ravel()
