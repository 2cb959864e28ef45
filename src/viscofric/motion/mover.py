"""A checked contact problem, and the protocol of movers, the contacts that a march advances by steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.motion.schedule import Instant, Schedule
from viscofric.rheology.material import Material

State = TypeVar("State")

#: Retardation times that steps after a jump resolve, in the shortest step.
QUICK = 100.0
#: First part of the accuracy that one step may add to the difference of the chains; see `viscofric.motion.march`.
SHARE = 0.05


@dataclass(frozen=True, eq=False)
class Problem:
    """A contact in motion."""

    material: Material  # its Poisson ratio; the modes are those of the schedule
    indenter: Indenter | PeriodicSurface
    schedule: Schedule
    accuracy: float  # relative, of friction, depth, load and energy
    layer: Layer | None
    counterface: float  # (1 − ν_i²)/E_i of an elastic indenter, 1/Pa

    @property
    def plane_strain(self) -> float:
        """1 − ν²."""
        return 1.0 - self.material.poisson_ratio**2

    @property
    def kind(self) -> str:
        """Kind of contact: "point", "line" or "periodic"."""
        geometry = getattr(self.indenter, "geometry", None)
        return "periodic" if geometry is None else ("line", "point")[geometry.dimension - 1]


class Sizes(NamedTuple):
    """Estimated errors, absolute, or sizes that they are compared with: accuracies are relative to the latter."""

    load: float
    depth: float
    friction: float
    energy: float


class Observation(NamedTuple):
    """Observed quantities of a contact at one time.

    Forces and energies are per length in a line contact, and per area in a periodic one.
    """

    load: float  # N (N/m; mean pressure, Pa)
    depth: float  # indentation, m
    #: Force of the indenter on the material along x and y, whose work is that of friction
    friction_force: tuple[float, float]
    area: float  # of contact, m² (m; a fraction)
    #: stored, dissipated: Energy in the material, and what it has dissipated since the start, J (J/m; J/m²), computed
    #: from the modes and not from the work of load and friction, which the march adds up itself
    stored: float
    dissipated: float
    extents: Mapping[str, float]  # ``contact_radius``, or ``front``, ``rear`` and ``half_width``, m
    #: Errors of load, depth, friction and dissipated energy that shorter steps do not reduce: by the number of
    #: springs, and by merged modes
    left_out: Sizes = Sizes(0.0, 0.0, 0.0, 0.0)
    #: Friction from the pressure on the indenter's slopes, of contacts on cells; zero for others
    force_on_slopes: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Field:
    """A pressure on its own coordinates (m), relative to the indenter's axis."""

    axes: Mapping[str, Array]  # name of each dimension (``r``; ``x`` and ``y``) → its points
    pressure: Array = field(repr=False)  # Pa, along these dimensions
    error: float = 0.0  # largest error of it by steps, Pa

    def apart(self, other: Field) -> float:
        """Return the largest difference from a pressure on points of the same lattice, where both have points, Pa."""
        here, there = [], []
        for name, one in self.axes.items():
            two = other.axes[name]
            first = max(one[0], two[0])
            i, j = int(np.argmin(np.abs(one - first))), int(np.argmin(np.abs(two - first)))
            count = min(len(one) - i, len(two) - j)
            here.append(slice(i, i + count))
            there.append(slice(j, j + count))
        return float(np.abs(self.pressure[tuple(here)] - other.pressure[tuple(there)]).max(initial=0.0))


class Mover(Protocol[State]):
    """A contact that can be moved through a schedule by steps.

    States are immutable: a step makes a new one, so that any may be stored and continued from.  What has a body here is
    so of most contacts.
    """

    #: First part of the accuracy that one step may add to the difference of the chains, between times asked for.
    share: float = SHARE

    @property
    def scales(self) -> Sizes:
        """Least sizes to compare with, above zero: depth of the stiffest response, load of the softest one."""
        ...

    def floor(self, largest: Sizes) -> Sizes:
        """Return the errors by contact conditions that are met to a tolerance, from the largest values so far."""
        return Sizes(0.0, 0.0, 0.0, 0.0)

    @property
    def can_tighten(self) -> bool:
        """Whether the contact conditions can be met more closely."""
        return False

    def tighten(self) -> None:
        """Meet the contact conditions more closely from now on."""
        return

    @property
    def quickest(self) -> float:
        """Time in which the response to a jump changes noticeably, s of the clock."""
        ...

    def begin(self) -> State:
        """Return the state just before the start: nothing has happened, or what `Schedule.before` says."""
        ...

    def step(self, state: State, start: Instant, end: Instant) -> State:
        """Return the state at the end of a step; the memory is exact for a pressure that is linear in between."""
        # A jump is a step with ``end.clock - start.clock == 0``: the response of the glassy modulus.
        ...

    def settle(self, state: State, instant: Instant, shortest: float) -> State:
        """Return the state soon after a jump, in which modes too quick for steps have followed; others as they are."""
        # `shortest` is the time of the shortest step that follows, s.
        ...

    def accept(self, state: State, instant: Instant) -> None:
        """Raise a `ViscofricError` where the method does not hold for a state that the march has accepted."""
        return

    def observe(self, state: State) -> Observation:
        """Return the observed quantities of a state."""
        ...

    def pressure(self, state: State) -> Field:
        """Return the pressure of a state."""
        ...

    def pointwise_difference(self, one: State, other: State) -> float:
        """Return the root of the sum of the squares by which the friction of each point differs between two states."""
        return 0.0

    def rate_change(self, first: State, middle: State, last: State, start: Instant, end: Instant) -> float:
        """Return how much more friction changes in another step like the last one, if points touch or leave at rest.

        The states are those at the ends of the last two steps, of one length; the last one has this start and end.
        """
        return 0.0

    def early(self, since: float) -> float:
        """Return how many times as large `Observation.left_out` is so soon after a jump, s of the clock."""
        return 1.0

    def ticks(self, start: Instant, end: Instant) -> Array | None:
        """Return the times since the start at which steps may end, up to the end; None if any."""
        return None

    # --- of a repeated history ---------------------------------------------------------------------------------

    def memory_of(self, state: State) -> NDArray[Any]:
        """Return the memory, scaled so that half the square of its norm is the energy that it stores."""
        ...

    def with_memory(self, state: State, memory: NDArray[Any]) -> State:
        """Return a state with another memory, with its dissipated energy set to zero."""
        ...

    def recovered(self, change: NDArray[Any], touched: Array, start: Instant, end: Instant) -> NDArray[Any]:
        """Return the change of a memory over a period, divided by 1 − e^z."""
        # Where points in contact stay where they are, by the corresponding matrix (`recovery_at_depth`). `touched` is
        # the part of the period in which each point of `touching` touched.
        ...

    def memory_from(self, coarser: Any, memory: NDArray[Any]) -> NDArray[Any]:
        """Return the memory of a mover of the same kind on another grid, where there are several."""
        return memory

    def touching(self, state: State) -> Array:
        """Return 1 for each point that touches, 0 for the others; empty where `recovered` does not need it."""
        return np.empty(0)

    def coarser_load(self, state: State) -> float:
        """Return the load by half of the points at the same depth; the same load where grids are compared instead."""
        return self.observe(state).load
