"""Growing contacts: the response as a linear functional of the creep compliance or the relaxation modulus.

While the contact of a body of revolution grows, load and depth of a viscoelastic half-space follow from those of an
elastic one by the correspondence principle (E. H. Lee, J. R. M. Radok, J. Appl. Mech. 27 (1960) 438): with
X(δ) = 2 ∫₀ᵃ (δ − g(s)) ds of the one-dimensional profile g, g(a) = δ, which is (4/3) √R δ^{3/2} of a ball,

    X(δ(t)) = (1−ν²) ∫ J(t−s) dF(s),        F(t) = ∫ E(t−s) dX(δ(s))/(1−ν²).

The prescribed quantity I is linear between knots s_m, where its slope changes by κ_m or it jumps by Δ_m, so that

    ∫ R(t−s) dI(s) = Σ κ_m (t−s_m) M(t−s_m) + Σ Δ_m R(t−s_m),    M(t) = ∫₀ᵗ R ds/t,

with R = J or E: weights of R and of its mean M, which are interpolated over ln t.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from viscofric.motion.springs import elastic_radius, profile

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.identification.indentation.record import IndentationRecord


#: Points per decade of time at which J or E is evaluated; interpolation by cubics is then good to 1e-5 of it.
GRID = 20
#: Rows are averaged over so many equal parts of each decade of time since the last kink of the prescribed quantity.
PARTS = 20
#: … or since the first row, if there are more kinks than this.
MOST_KINKS = 12
#: Allowed error of omitting knots of the prescribed quantity, relative to its largest value; for many rows also their
#: scatter, up to a part of the largest value.
SIMPLIFIED, MANY_ROWS, SCATTERS, MOST_SIMPLIFIED = 1e-6, 400, 3.0, 1e-3
#: A smaller fall of the depth, relative to the largest depth, does not count as shrinking.
LEAST_FALL = 1e-4
#: Ratio of prescribed depths between which X is taken as linear, good to 1.5e-4 of it, and the least depth over the
#: largest one at which that is so.
FINE, LEAST_DEPTH = 1.04, 1e-4
#: A response below this many standard errors is left out: the error of its logarithm is not normal.
CLEAR = 5.0
#: Times below this fraction of the first row's time are not resolved.
SHORTEST = 1e-5
#: X is tabulated up to this multiple of the contact radius at the largest depth, as errors extend beyond it.
BEYOND, _RADII = 2.0, 400
BLOCK = 500_000  # lags at once


class Reduced:
    """X(δ) of a body of revolution, m²: the load over the plane-strain modulus E/(1−ν²)."""

    def __init__(self, indenter: Indenter, largest: float) -> None:
        self._radius = elastic_radius(indenter, largest, None, 1.0)
        self._depths = self._values = None
        if not indenter.has_walls:
            nodes, weights = np.polynomial.legendre.leggauss(20)
            radii = self._radius * np.geomspace(1e-6, BEYOND, _RADII)
            self._depths = profile(indenter, radii)
            inner = profile(indenter, 0.5 * radii[:, None] * (nodes + 1.0)) @ (0.5 * weights)
            self._values = 2.0 * radii * (self._depths - inner)

    def __call__(self, depth: Array) -> Array:
        """Return X, m², zero above the surface."""
        pressed = np.maximum(depth, 0.0)
        if self._depths is None or self._values is None:
            return np.asarray(2.0 * self._radius * pressed)
        least = float(self._depths[0])
        logs = np.interp(np.log(np.maximum(pressed, least)), np.log(self._depths), np.log(self._values))
        return np.asarray(np.where(pressed > least, np.exp(logs), 0.0))

    @property
    def radius(self) -> float:
        """Contact radius at the largest depth, m."""
        return self._radius


@dataclass(frozen=True, eq=False)
class Growing:
    """The usable rows of a record, averaged, as linear functionals of J (load prescribed) or E (depth prescribed)."""

    creep: bool
    time: Array  # (n,), since the start, mean of the rows averaged, s
    lags: tuple[float, float]  # shortest and longest time since a change of what was prescribed, s
    response: Array  # (n,), X in m², or load in N
    error: Array | None  # (n,), relative standard error; None where it is not known
    count: Array  # (n,), rows averaged
    grid: Array  # (G,), times at which R and M are evaluated, s
    weights: Array  # (n, 2G), of M and of R: their product with both is the response times E/(1−ν²), or its inverse
    shrinking: int  # rows left out from where the contact shrinks
    unclear: int  # rows of the contact left out, as the response is not clearly above its scatter

    def __len__(self) -> int:
        return len(self.time)


def growing(record: IndentationRecord, reduced: Reduced, *, has_walls: bool) -> Growing:
    """Return the usable rows of a record, up to where the contact begins to shrink."""
    end = len(record) if has_walls else _shrinks(record)
    time = record.time[:end] - record.start
    creep = record.control == "load"
    load, depth = (np.maximum(column[:end], 0.0) for column in (record.load, record.indentation))
    prescribed, measured = (load, depth) if creep else (depth, load)
    prescribed[: _contact(prescribed)] = 0.0
    response = reduced(depth) if creep else load
    error = None
    if record.error is not None:
        up = record.indentation[:end] + record.error[:end]
        moved = reduced(up) - response if creep else record.error[:end]
        error = moved / np.maximum(response, 1e-300)
    knots, values = _knots(time, prescribed)
    changes, jumps = _changes(knots, values)
    kinks = knots[(changes != 0.0) | (jumps != 0.0)]
    if not creep:
        knots, depths = _subdivided(knots, values)
        values = reduced(depths)
        changes, jumps = _changes(knots, values)
    starts = float(knots[max(int(np.argmax(values > 0.0)) - 1, 0)])
    after = (time > starts) & ~np.isin(time, knots[jumps != 0.0])
    clear = after & (response > 0.0)
    clear &= measured > CLEAR * _scatter(measured) if error is None else error < 1.0 / CLEAR
    left_out = len(record) - end, int(np.count_nonzero(after & ~clear))
    if not (len(kinks) and np.any(clear)):
        none = np.zeros(0)
        return Growing(creep, none, (np.inf, 0.0), none, None, none, none, np.zeros((0, 0)), *left_out)
    time, response = time[clear], response[clear]
    last = np.searchsorted(kinks, time, side="left") - 1 if len(kinks) <= MOST_KINKS else np.zeros(len(time), int)
    since = time - kinks[last]
    number = _parts(since, last)
    grid, weights = _weights(time, knots, changes, jumps)
    count = np.bincount(number).astype(float)
    average = np.zeros((len(count), len(number)))
    average[number, np.arange(len(number))] = 1.0 / count[number]
    mean = average @ response
    spread = None
    if error is not None:
        spread = np.sqrt((average**2) @ (error[clear] * response) ** 2) / mean
    lags = float(since.min()), float(time.max() - kinks[0])
    return Growing(creep, average @ time, lags, mean, spread, count, grid, average @ weights, *left_out)


def _contact(prescribed: Array) -> int:
    """Return the row before which a record shows no more than scatter: the approach to the surface."""
    return int(np.argmax(prescribed > SCATTERS * _scatter(prescribed)))


def _shrinks(record: IndentationRecord) -> int:
    """Return the row from which the contact shrinks; the number of rows if it does not.

    It may shrink once the prescribed quantity falls by more than its scatter.  Under a falling load the depth may still
    grow for a while.
    """
    prescribed = record.load if record.control == "load" else record.indentation
    largest = np.maximum.accumulate(prescribed)
    scatter, least = _scatter(prescribed), LEAST_FALL * float(np.max(prescribed))
    fallen = np.flatnonzero(largest - prescribed > max(8.0 * scatter, least))
    if not len(fallen):
        return len(prescribed)
    peak = largest[fallen[0]]
    begins = int(np.flatnonzero(prescribed[: fallen[0]] >= peak - max(3.0 * scatter, 0.1 * least))[-1]) + 1
    if record.control == "indentation":
        return begins
    depth = record.indentation
    allowed = max(3.0 * _scatter(depth), LEAST_FALL * float(np.max(depth)))
    shrunk = np.flatnonzero((np.maximum.accumulate(depth) - depth > allowed)[begins:])
    return begins + int(shrunk[0]) if len(shrunk) else len(depth)


def _scatter(values: Array) -> float:
    """Return the scatter of rows about a smooth curve from the median of their second differences."""
    return float(1.4826 * np.median(np.abs(np.diff(values, 2))) / np.sqrt(6.0))


def _knots(time: Array, values: Array) -> tuple[Array, Array]:
    """Return the fewest knots between which the prescribed quantity is linear, to its scatter; zero before."""
    most = float(np.max(values))
    tolerance = SIMPLIFIED * most
    if len(values) > MANY_ROWS:
        tolerance = max(tolerance, min(SCATTERS * _scatter(values), MOST_SIMPLIFIED * most))
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


def _subdivided(knots: Array, depths: Array) -> tuple[Array, Array]:
    """Return depths at more knots, since X is not linear in the depth."""
    times, values = [knots[:1]], [depths[:1]]
    for (start, above), (end, below) in pairwise(zip(knots, depths, strict=True)):
        within = np.array([below])
        if end > start and below > above:
            least = max(above, LEAST_DEPTH * below)
            count = int(np.ceil(np.log(below / least) / np.log(FINE)))
            within = np.geomspace(least, below, count + 1)[int(least == above) :]
        share = (within - above) / (below - above) if below != above else np.ones(1)
        times.append(start + share * (end - start))
        values.append(within)
    return np.concatenate(times), np.concatenate(values)


def _changes(knots: Array, values: Array) -> tuple[Array, Array]:
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


def _weights(time: Array, knots: Array, changes: Array, jumps: Array) -> tuple[Array, Array]:
    """Return the grid of times (G,) and the weights (n, 2G) of M and of R on it; `time` (n,) lies after a knot."""
    acting = (changes != 0.0) | (jumps != 0.0)
    knots, changes, jumps = knots[acting], changes[acting], jumps[acting]
    low = float(np.min(time - knots[np.searchsorted(knots, time, side="left") - 1]))
    low = max(low, SHORTEST * float(time.min() - knots[0]))
    high = float(time.max() - knots[0])
    count = max(4, int(np.ceil(GRID * np.log10(high / low))) + 1)
    spacing = max(np.log(high / low) / (count - 1), 1e-3)
    weights = np.zeros(len(time) * 2 * count)
    for block in np.array_split(np.arange(len(time)), max(1, len(time) * len(knots) // BLOCK)):
        lags = time[block, None] - knots
        rows, columns = np.nonzero(lags > 0.0)
        lag = lags[rows, columns]
        place = np.log(np.maximum(lag / low, 1.0)) / spacing
        cell = np.clip(np.floor(place).astype(int) - 1, 0, count - 4)
        x = place - cell
        for node in range(4):  # Lagrange's cubics
            others = [other for other in range(4) if other != node]
            share = np.prod([(x - other) / (node - other) for other in others], axis=0)
            of_mean, of_value = block[rows] * 2 * count + cell + node, (block[rows] * 2 + 1) * count + cell + node
            weights += np.bincount(of_mean, share * changes[columns] * lag, len(weights))
            weights += np.bincount(of_value, share * jumps[columns], len(weights))
    return low * np.exp(spacing * np.arange(count)), weights.reshape(len(time), -1)
