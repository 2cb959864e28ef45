"""The two chains of states of a march, and the difference between them."""

from __future__ import annotations

from typing import Generic, NamedTuple

from viscofric.motion.mover import Observation, Scales, State

#: Energies are so many times as accurate as the rest, for a balance of a tenth of the accuracy.
_ENERGIES = 3.0


class Errors(NamedTuple):
    """Estimated errors at one time, absolute."""

    load: float
    depth: float
    friction: float
    energy: float


class Link(NamedTuple, Generic[State]):
    """A state of one chain with what is seen of it, and the work so far."""

    state: State
    seen: Observation
    work: float


class Pair(NamedTuple, Generic[State]):
    """Both chains at one time."""

    coarse: Link[State]
    fine: Link[State]


class Difference(NamedTuple):
    """Fine less coarse chain."""

    load: float
    depth: float
    along: float  # friction
    across: float
    work: float
    dissipated: float


def difference(pair: Pair[State]) -> Difference:
    """Return fine less coarse."""
    coarse, fine = pair.coarse.seen, pair.fine.seen
    along, across = (two - one for one, two in zip(coarse.friction_force, fine.friction_force, strict=True))
    work = pair.fine.work - pair.coarse.work
    return Difference(
        fine.load - coarse.load, fine.depth - coarse.depth, along, across, work, fine.dissipated - coarse.dissipated
    )


def over_scales(off: Difference, scales: Scales) -> tuple[float, ...]:
    """Return a difference in parts of the scales."""
    energy = scales.energy / _ENERGIES
    each = (scales.load, scales.depth, scales.friction, scales.friction, energy, energy)
    return tuple(one / scale for one, scale in zip(off, each, strict=True))
