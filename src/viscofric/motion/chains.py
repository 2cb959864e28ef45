"""What a march is made of: two chains of states, the difference between them, moments, and how far it has come."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Generic, NamedTuple

from viscofric.motion.mover import Field, Mover, Observation, Sizes, State
from viscofric.motion.schedule import Instant

#: Energies are so many times as accurate as the rest, for a balance of a tenth of the accuracy.
_ENERGIES = 3.0
#: Part of a difference that counts after the next step.
_FADING = 0.7


#: Errors of the fine chain over the difference of the chains: a third, and a margin.  The margin is larger for load and
#: depth, whose order is nearer to the first where springs or cells are touched within a step; friction is judged by it
#: on grids as well, energies by their balance.
_OF_STEPS = Sizes(0.8, 0.8, 0.4, 0.4)


class Link(NamedTuple, Generic[State]):
    """A state of one chain with what is seen of it, and the work so far: all of it, and that of friction."""

    state: State
    seen: Observation
    work: float
    rubbed: float = 0.0


class Pair(NamedTuple, Generic[State]):
    """Both chains at one time."""

    coarse: Link[State]
    fine: Link[State]


class Difference(NamedTuple):
    """Fine less coarse chain."""

    load: float = 0.0
    depth: float = 0.0
    along: float = 0.0  # friction
    across: float = 0.0
    work: float = 0.0
    dissipated: float = 0.0
    slopes_along: float = 0.0  # friction from the pressure on slopes
    slopes_across: float = 0.0
    #: Friction, from single points: see `Mover.pointwise_difference` and `Mover.rate_change`
    points: float = 0.0


#: Of equal chains.
SAME = Difference()


@dataclass(frozen=True, eq=False)
class Reached(Generic[State]):
    """How far a march has come: all that another one needs to go on as if there had been no end."""

    pair: Pair[State]
    time: float | None = None  # s; None: the start of the schedule
    since: float = 0.0  # the last kink, s
    jumped: bool = False  # whether a jump at this time has been taken
    told: float = -math.inf  # time of the last moment returned, s
    scales: Sizes | None = None  # largest values so far
    #: Difference of the chains that errors are estimated from: the present one, or a part of an earlier larger one
    spread: Difference = SAME
    pace: float = 0.0  # next step, s, or a number of ticks; zero: as after a jump
    share: float | None = None  # of the accuracy, that a step may add
    stored: float | None = None  # energy in the material before the first start, J; None: what it is now
    limited: bool = False  # whether a step from tick to tick was longer than the accuracy asks for


def difference(pair: Pair[State]) -> Difference:
    """Return fine less coarse."""
    coarse, fine = pair.coarse.seen, pair.fine.seen
    along, across = (two - one for one, two in zip(coarse.friction_force, fine.friction_force, strict=True))
    slopes = (two - one for one, two in zip(coarse.force_on_slopes, fine.force_on_slopes, strict=True))
    work, dissipated = pair.fine.work - pair.coarse.work, fine.dissipated - coarse.dissipated
    return Difference(fine.load - coarse.load, fine.depth - coarse.depth, along, across, work, dissipated, *slopes)


def over_scales(off: Difference, scales: Sizes) -> tuple[float, ...]:
    """Return the differences that steps are judged by, in parts of the scales; of themselves before the first load."""
    energy = scales.energy / _ENERGIES
    each = (scales.load, scales.depth, scales.friction, scales.friction, energy, energy)
    return tuple(one / (scale or abs(one) or 1.0) for one, scale in zip(off, each, strict=False))


@dataclass(frozen=True, eq=False)
class Moment(Generic[State]):
    """One returned time: what was seen, the work so far, the estimated errors, and the part of friction in the work.

    `slopes` is the estimated error of the friction from the pressure on slopes.
    """

    instant: Instant
    seen: Observation
    work: float
    errors: Sizes
    field: Field | None
    rubbed: float = 0.0
    slopes: float = 0.0

    def on_slopes(self) -> Moment[State]:
        """Return the moment with the friction from the pressure on slopes in place of the other."""
        seen = self.seen._replace(friction_force=self.seen.force_on_slopes)
        return replace(self, seen=seen, errors=self.errors._replace(friction=self.slopes))


def faded(spread: Difference, pair: Pair[State], points: float) -> Difference:
    """Return the size of the difference of the chains, or a part of an earlier one: it may pass through zero."""
    off = difference(pair)._replace(points=points)
    return Difference(*(max(abs(now), _FADING * then) for now, then in zip(off, spread, strict=True)))


def field_of(mover: Mover[State], pair: Pair[State]) -> Field:
    """Return the pressure of the fine chain, with its difference from that of the coarse one as its error."""
    coarse, fine = (mover.pressure(link.state) for link in pair)
    return replace(fine, error=fine.apart(coarse))


def _of_the_rest(errors: Sizes, instant: Instant) -> Sizes:
    """Return errors without that of what is prescribed."""
    return errors._replace(**{"load" if instant.depth is None and instant.gap is None else "depth": 0.0})


def errors_of_steps(spread: Difference) -> Sizes:
    """Return the errors by steps, from the difference of the chains."""
    each = spread.load, spread.depth, math.hypot(spread.along, spread.across), max(spread.work, spread.dissipated)
    steps = Sizes(*(part * one for part, one in zip(_OF_STEPS, each, strict=True)))
    # Those of points that touch or leave within a step are of first order, and cancel in the friction only by chance.
    return steps._replace(friction=max(steps.friction, spread.points))


def moment_of(
    pair: Pair[State],
    instant: Instant,
    held: Field | None,
    spread: Difference,
    floor: Sizes,
    *,
    early: Sizes,
    extrapolate: bool,
) -> Moment[State]:
    """Return what the chains say of one time: the energies extrapolated, and the rest too on request."""
    # Errors are those of steps, by the spread, what the mover leaves out, `early` times that, and by the contact
    # conditions, the floor.
    coarse, fine = pair
    left_out = Sizes(*(times * one for times, one in zip(early, fine.seen.left_out, strict=True)))
    left_out, floor = (_of_the_rest(one, instant) for one in (left_out, floor))
    off = difference(pair)
    steps = errors_of_steps(spread)
    errors = Sizes(*(sum(parts) for parts in zip(steps, left_out, floor, strict=True)))
    slopes = _OF_STEPS.friction * math.hypot(spread.slopes_along, spread.slopes_across) + left_out[2] + floor.friction
    # Sums over all steps are smooth enough to be extrapolated.
    stored, dissipated, work, rubbed = (
        two + (two - one) / 3.0
        for one, two in (
            (coarse.seen.stored, fine.seen.stored),
            (coarse.seen.dissipated, fine.seen.dissipated),
            (coarse.work, fine.work),
            (coarse.rubbed, fine.rubbed),
        )
    )
    seen = fine.seen._replace(stored=stored, dissipated=dissipated, left_out=left_out)
    if extrapolate:
        (x, y), (along, across) = seen.friction_force, seen.force_on_slopes
        seen = seen._replace(
            load=seen.load + off.load / 3.0,
            depth=seen.depth + off.depth / 3.0,
            friction_force=(x + off.along / 3.0, y + off.across / 3.0),
            force_on_slopes=(along + off.slopes_along / 3.0, across + off.slopes_across / 3.0),
        )
    return Moment(instant, seen, work, errors, held, rubbed, slopes)


@dataclass(frozen=True, eq=False)
class Track(Generic[State]):
    """What a march has found."""

    moments: list[Moment[State]]
    steps: int  # taken (of the coarse chain, those of the last march)
    rejected: int
    interrupted: bool  # whether the march was interrupted before the end
    reached: Reached[State]  # states of both chains at the last time, from which another march may continue
    stored: float = 0.0  # energy in the material before the start

    def joined(self, later: Track[State]) -> Track[State]:
        """Return what this march and a later one that continues it have found."""
        return replace(
            later,
            moments=[*self.moments, *later.moments],
            steps=self.steps + later.steps,
            rejected=self.rejected + later.rejected,
            stored=self.stored,
        )
