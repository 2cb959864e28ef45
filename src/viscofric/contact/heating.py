"""Rise of temperature of a solved contact by its own friction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np
import scipy.fft

from viscofric.arrays import Array, Indices, convolved
from viscofric.contact.fields.dissipation import Dissipation, Modes, dissipation
from viscofric.contact.heated import ThermalContact
from viscofric.contact.heated_result import Heat
from viscofric.contact.solution import ContactSolution
from viscofric.heat.heating import HeatBalance, Heating, ThermalResistances
from viscofric.heat.influence import Diffusion
from viscofric.heat.means import disc_mean, strip_mean
from viscofric.thermal import ThermalProperties

#: Cells along the contact, and room behind, ahead of and beside it, in half lengths of the contact.
_CELLS, _MAPPED = 18, 40
_BEHIND, _AHEAD, _BESIDE = 2.0, 0.6, 0.6


class LoadedContact(Protocol):
    """What rises of temperature per heat are found from: a solved contact, or one under an assumed pressure."""

    @property
    def speed(self) -> float:
        """Along x, m/s."""

    @property
    def friction_force(self) -> float:
        """Viscoelastic, N or N/m."""

    @property
    def contact_area(self) -> float:
        """Of the loaded cells, m² or m."""

    @property
    def x(self) -> Array:
        """Cell centres along the motion (nx,), m."""

    @property
    def y(self) -> Array:
        """Cell centres across (ny,), m; one of a line contact."""

    @property
    def pressure(self) -> Array:
        """Of the cells (nx, ny), Pa."""


@dataclass(frozen=True)
class FreeThermalContact(ThermalContact):
    """Contact of an indenter at any rise of temperature."""

    def heat(self, solution: Any, kelvin: float, relative: ThermalResistances | None = None) -> Heat:
        """Return the heats of a contact solved at a temperature; its resistances `relative` to `closed`, if known.

        Then the numbers of a contact are enough, without its fields.
        """
        if relative is None:
            resistances = thermal_resistances(solution, self.modes(kelvin), self.material.poisson_ratio, self.heating)
        else:
            rubber, other = self.closed(solution.contact_area, 0.5 * (solution.front + solution.rear))
            track = self.heating.track_resistance(self.size(solution.contact_area), abs(self.speed))
            below = [rubber * part for part in relative[:4]]
            parts: Any = (*below, track, other * relative.counterface, relative.beyond)
            resistances = ThermalResistances(*parts)
        return Heat(
            resistances,
            self.heating.coulomb_heat(solution.load, self.speed),
            abs(solution.friction_coefficient * solution.load * solution.speed),
            solution.contact_area,
            0.5 * (solution.front + solution.rear),
        )

    def area(self, solution: ContactSolution) -> float:
        """Return the area of a solved contact, m² or m."""
        return solution.contact_area

    def size(self, area: float) -> float:
        """Return the half-width of a line contact, or the radius of a disc of equal area, m."""
        return 0.5 * area if self.line else math.sqrt(area / math.pi)

    def closed(self, area: float, size: float) -> tuple[float, float]:
        """Return the rise of the rubber's face and of the counterface's per heat, of a disc or strip of the area."""
        return self.heating.face_resistances(abs(self.speed), self.size(area), self.line)

    def scaled(self, heat: Heat, larger: Array) -> ThermalResistances:
        """Return resistances of larger contacts (n,): they change as those of discs or strips."""
        line, size = self.line, self.size(heat.area)
        mean = strip_mean if line else disc_mean

        def factor(body: ThermalProperties, velocity: float) -> Array:
            """Return the power of the area that the resistance follows, as a factor."""
            peclet = np.maximum(velocity * size / (2.0 * body.diffusivity) * np.array([1.0, 1.1]), 1e-9)
            first, second = (mean(float(one), hertz=True) for one in peclet)
            # Per heat, the rise of a disc falls as its mean in units of q̄ a over a, that of a strip as the mean alone.
            power = np.log(second / first) / np.log(1.1) - (0.0 if line else 1.0)
            return np.asarray(larger ** (power if line else 0.5 * power))

        one, speed = heat.resistances, abs(self.speed)
        rubber = factor(self.heating.rubber, speed)
        other = factor(self.heating.counterface, abs(self.heating.over_counterface(speed)))
        parts: Any = (*(rubber * part for part in one[:4]), one.track, one.counterface * other, one.beyond)
        return ThermalResistances(*parts)


def thermal_resistances(
    solution: LoadedContact, modes: Modes, poisson_ratio: float, heating: Heating
) -> ThermalResistances:
    """Return rises of a contact per heat; `modes` are those at the temperature at which it was solved.

    The mean over the face is over the contact.  Heat on the face is distributed like the pressure, and that of the loss
    as it is released below (in a half-space); what is released beyond the cells does not reach the contact.
    """
    speed, loss = abs(solution.speed), abs(solution.friction_force * solution.speed)
    cells = Cells.of(solution, _CELLS)
    radius = cells.radius(solution)
    flux, face = cells.pressure / cells.pressure.sum(), cells.inside
    released = dissipation(cells.x, cells.y, cells.pressure, modes, poisson_ratio, speed, radius)
    found = float(released.power.sum())
    weight = released.power / found if found > 0.0 else released.power
    power = released._replace(power=_per_loss(released, loss))
    other_speed = abs(heating.over_counterface(speed))
    other = math.inf
    if not (cells.is_line and other_speed == 0.0):
        other = cells.mean_rise(cells.influence(Diffusion(heating.counterface, other_speed)), flux[None], face[None])
    rises = cells.rises(Diffusion(heating.rubber, speed), flux, face, power, weight)
    beyond = 1.0 - float(power.power.sum()) if found > 0.0 else 0.0
    return ThermalResistances(*rises, heating.track_resistance(radius, speed), other, max(beyond, 0.0))


class FaceTemperature(NamedTuple):
    """Rise of temperature (nx, ny), K, of the rubber's surface at x (nx,) and y (ny,), m; the contact moves towards +x.

    `contact` (nx, ny) is the share of each cell that lies in the contact.
    """

    x: Array
    y: Array
    rise: Array
    contact: Array


def face_temperature(
    solution: ContactSolution,
    modes: Modes,
    poisson_ratio: float,
    heating: Heating,
    coulomb: float,
) -> FaceTemperature:
    """Return where the rubber's surface is how warm, under and behind a contact; see `thermal_resistances`.

    The Coulomb heat, W or W/m, is shared such that both faces are equally warm on average; where they touch they may
    differ.
    """
    loss = abs(solution.friction_force * solution.speed)
    balance = HeatBalance.of(thermal_resistances(solution, modes, poisson_ratio, heating), coulomb, loss)
    speed, cells = abs(solution.speed), Cells.of(solution, _MAPPED)
    radius = cells.radius(solution)
    released = dissipation(cells.x, cells.y, cells.pressure, modes, poisson_ratio, speed, radius)
    entering = (coulomb - balance.counterface_heat) * cells.pressure / cells.pressure.sum()
    influence = cells.influence(Diffusion(heating.rubber, speed), lambda lengths: _to_face(released, lengths))
    heat = np.concatenate([entering[None], loss * _per_loss(released, loss)])
    rise = convolved(influence, heat) + balance.track_rise
    return FaceTemperature(cells.x, cells.y, rise, cells.inside / cells.inside.max())


def _per_loss(released: Dissipation, loss: float) -> Array:
    """Return the shares of the layers' cells in the loss; what is missing in their sum is released beyond the cells."""
    found = float(released.power.sum())
    return released.power / max(loss, found) if found > 0.0 else released.power


def _to_face(released: Dissipation, lengths: Array) -> Array:
    """Return the factors of `Diffusion.influence` on the face, and from each layer to it, uniform across its depth."""
    from scipy.special import erf

    ends = np.concatenate([[0.0], np.cumsum(released.thickness)])[:, None]
    to_face = 0.5 * math.sqrt(math.pi) * lengths / released.thickness[:, None] * np.diff(erf(ends / lengths), axis=0)
    return np.concatenate([np.ones((1, len(lengths))), to_face])


def _between_depths(released: Dissipation) -> Callable[[Array], Array]:
    """Return factors from layers, uniform across the depths that they stand for, to their nodes: all pairs.

    The layers are far thicker than the heat of a fast contact spreads.
    """
    from scipy.special import erf

    ends = np.concatenate([[0.0], np.cumsum(released.thickness)])
    node = released.depth[:, None, None]
    low, high, thickness = ends[:-1, None], ends[1:, None], released.thickness[:, None]

    def factors(lengths: Array) -> Array:
        inside = erf((node - low) / lengths) - erf((node - high) / lengths)
        image = erf((node + high) / lengths) - erf((node + low) / lengths)
        return np.asarray(0.25 * math.sqrt(math.pi) * lengths / thickness * (inside + image)).reshape(-1, len(lengths))

    return factors


class Cells:
    """Pressure (nx, ny) and weights of the mean over the contact on coarse cells, in motion towards +x."""

    def __init__(self, x: Array, y: Array, pressure: Array, inside: Array) -> None:
        self.x, self.y, self.pressure = x, y, pressure
        self.inside = inside / inside.sum()
        self.is_line = len(y) == 1
        self.cell = x[1] - x[0], math.inf if self.is_line else y[1] - y[0]

    @classmethod
    def of(cls, solution: LoadedContact, across_contact: int) -> Cells:
        """Return so many cells along the contact, those of the solution put together, and room around it."""
        pressure = solution.pressure[::-1] if solution.speed < 0.0 else solution.pressure
        loaded = np.asarray(pressure > 0.0, dtype=np.float64)
        rows = np.flatnonzero(loaded.any(axis=1))
        length = int(rows[-1] - rows[0] + 1)
        size = max(1, round(length / across_contact))
        half = 0.5 * length
        forward = solution.x if solution.speed >= 0.0 else -solution.x[::-1]
        along = cls._room(rows, size, _BEHIND * half, _AHEAD * half)
        if pressure.shape[1] == 1:
            blocks = [_blocks(one[:, 0], along, size)[:, None] / size for one in (pressure, loaded)]
            return cls(_row(along, size, forward), np.zeros(1), *blocks)
        columns = np.flatnonzero(loaded.any(axis=0))
        across = cls._room(columns, size, _BESIDE * half, _BESIDE * half)
        both = [_blocks(_blocks(one, along, size).T, across, size).T / size**2 for one in (pressure, loaded)]
        return cls(_row(along, size, forward), _row(across, size, solution.y), *both)

    def radius(self, solution: LoadedContact) -> float:
        """Return the half-width of a line contact, or the radius of a disc of equal area, m."""
        return 0.5 * solution.contact_area if self.is_line else math.sqrt(solution.contact_area / math.pi)

    @classmethod
    def of_disc(cls, radius: float) -> Cells:
        """Return cells of a disc under a uniform pressure."""
        step = 2.0 * radius / _CELLS
        place: Array = step * (np.arange(float(_CELLS)) - 0.5 * (_CELLS - 1))
        inside = np.asarray(np.hypot(place[:, None], place) < radius, dtype=np.float64)
        return cls(place, place, inside, inside)

    @staticmethod
    def _room(loaded: Indices, size: int, before: float, after: float) -> tuple[int, int]:
        """Return the first row of a grid of blocks around loaded rows, and the number of blocks."""
        blocks = math.ceil((loaded[-1] - loaded[0] + 1) / size)
        first = math.ceil(before / size)
        return int(loaded[0]) - first * size, first + blocks + math.ceil(after / size)

    def influence(self, diffusion: Diffusion, depth: Callable[[Array], Array] | None = None) -> Array:
        """Return the rise (k, 2 nx − 1, ny), K/W, at all offsets from a cell, for each of the factors of depths."""
        nx, ny = self.pressure.shape
        x = self.cell[0] * np.arange(1.0 - nx, nx)
        y = np.zeros(1) if self.is_line else self.cell[1] * np.arange(0.0, ny)
        area = self.cell[0] if self.is_line else self.cell[0] * self.cell[1]
        return np.asarray(diffusion.influence(x, y, self.cell, depth).reshape(-1, 2 * nx - 1, ny) / area)

    def rises(
        self, diffusion: Diffusion, flux: Array, face: Array, released: Dissipation, weight: Array
    ) -> tuple[float, float, float, float]:
        """Return mean rises by heat (nx, ny) on the face and by that of layers (nz, nx, ny), W.

        Over the face, with its weights, by the one and the other; then over the layers, with theirs.
        """
        layers, between = len(released.depth), _between_depths(released)

        def factors(lengths: Array) -> Array:
            """Return those of `Diffusion.influence`: on the face, from each depth to it or back, and between depths."""
            return np.concatenate([_to_face(released, lengths), between(lengths)])

        on_face, to_face, below = np.split(self.influence(diffusion, factors), [1, 1 + layers])
        return (
            self.mean_rise(on_face, flux[None], face[None]),
            self.mean_rise(to_face, released.power, face[None]),
            self.mean_rise(to_face, flux[None], weight),
            self.mean_rise(below, released.power, weight),
        )

    def rises_below(self, diffusion: Diffusion, released: Dissipation) -> tuple[float, float, float, float]:
        """Return the same by heat and loss that are spread as the weights of the face; layers with a power (nz,)."""
        power, between = released.power, _between_depths(released)
        both = np.multiply.outer(power, power).ravel()

        def factors(lengths: Array) -> Array:
            on_face, *to_face = _to_face(released, lengths)
            return np.stack([on_face, power @ np.array(to_face), both @ between(lengths)])

        face, loss, below = (
            self.mean_rise(one[None], self.inside[None], self.inside[None])
            for one in self.influence(diffusion, factors)
        )
        return face, loss, loss, below

    def mean_rise(self, influence: Array, heat: Array, weight: Array) -> float:
        """Return the rise, K, by heat (m, nx, ny), W, averaged with weights (n, nx, ny), over all pairs of layers."""
        nx, ny = self.pressure.shape
        padded = [scipy.fft.next_fast_len(size, real=True) for size in (3 * nx - 2, 2 * ny - 1)]
        # Σ w(x) I(x − x') q(x'): offsets of each pair of layers by correlation, across to both sides.
        pairs = np.conj(scipy.fft.rfft2(heat, padded)) * scipy.fft.rfft2(weight, padded)[:, None]
        offsets = scipy.fft.irfft2(pairs, padded)
        sides = offsets[..., :ny].copy()
        if ny > 1:
            sides[..., 1:] += offsets[..., -1:-ny:-1]
        rows = np.arange(1 - nx, nx)
        return float(np.sum(sides[..., rows, :].reshape(influence.shape) * influence))


def _row(blocks: tuple[int, int], size: int, centres: Array) -> Array:
    """Return the centres of a number of blocks of cells from a first cell on, given those of the cells."""
    step = float(centres[1] - centres[0])
    first = centres[0] + step * (blocks[0] + 0.5 * (size - 1))
    return np.asarray(first + step * size * np.arange(blocks[1]), dtype=np.float64)


def _blocks(values: Array, rows: tuple[int, int], size: int) -> Array:
    """Return sums over blocks of rows, from a first row on that may lie before the array; there is nothing beyond."""
    first, count = rows
    room = np.zeros((count * size, *values.shape[1:]))
    low, high = max(first, 0), min(first + count * size, len(values))
    room[low - first : high - first] = values[low:high]
    return np.asarray(room.reshape(count, size, *values.shape[1:]).sum(axis=1))
