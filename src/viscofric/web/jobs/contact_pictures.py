"""Pictures of one contact, thinned for a browser: map of the pressure, outline, and a cut along the motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter

from viscofric.contact.fields.trail import surface_displacement
from viscofric.datasets import plain

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.contact.solution import ContactSolution
    from viscofric.study.cases.case import Case
    from viscofric.study.cases.indenter_case import IndenterCase
    from viscofric.study.run_file import Study
    from viscofric.study.study_rubber import StudyRubber


#: Points of a map along its longer edge, and of a profile, at most.
MOST_CELLS, MOST_POINTS = 110, 400
# Free space around the contact in the map, over the contact's length.
_MARGIN = 0.05
# How far a profile reaches behind the contact and ahead of it, over the contact's length.
_BEHIND, _AHEAD = 1.2, 0.6
# Points of the contact's outline at most; of a rough surface's spots, colours tell.
_OUTLINE = 1_500
_DIGITS, _FEW_DIGITS = 6, 3


@dataclass(frozen=True, eq=False)
class Asked:
    """A contact that the page asks for.

    Attributes
    ----------
    case : Case
    rubber : StudyRubber
    study : Study
    """

    case: Case
    rubber: StudyRubber
    study: Study


class Profile(NamedTuple):
    """What a cut along the motion shows, SI; heights upwards from the undeformed surface.

    Attributes
    ----------
    x : (n,) array
    pressure, surface, indenter : (n,) array
        NaN where there is nothing to show.
    """

    x: Array
    pressure: Array
    surface: Array
    indenter: Array


def around(solution: ContactSolution) -> tuple[Array, Array, Array]:
    """Cut the window down to the contact and a little free space."""
    loaded = solution.pressure > 0.0
    kept = []
    margin = _MARGIN * (solution.front + solution.rear)
    for places, there in ((solution.x, loaded.any(axis=1)), (solution.y, loaded.any(axis=0))):
        low, high = places[there].min() - margin, places[there].max() + margin
        kept.append(np.flatnonzero((places >= low) & (places <= high)))
    along, across = kept
    return solution.x[along], solution.y[across], solution.pressure[np.ix_(along, across)]


def thinned(x: Array, y: Array, field: Array, most: int = MOST_CELLS) -> tuple[Array, Array, Array]:
    """Take means over blocks of cells, so that no edge has more than so many; cells left over at the ends are cut off.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
    field : (nx, ny) array
    most : int
    """
    every = max(1, -(-max(field.shape) // most))
    if every == 1:
        return x, y, field
    rows, columns = (max(1, size // every) for size in field.shape)
    tall, wide = min(every, field.shape[0]), min(every, field.shape[1])
    cut = field[: rows * tall, : columns * wide].reshape(rows, tall, columns, wide)
    return (
        x[: rows * tall].reshape(rows, tall).mean(axis=1),
        y[: columns * wide].reshape(columns, wide).mean(axis=1),
        cut.mean(axis=(1, 3)),
    )


def pressure_map(x: Array, y: Array, pressure: Array) -> dict[str, Any]:
    """Return a map as JSON holds it: ``x``, ``y`` and ``pressure``, a row for each y."""
    along, across, thin = thinned(x, y, pressure)
    return {"x": plain(along, _DIGITS), "y": plain(across, _DIGITS), "pressure": plain(thin.T, _FEW_DIGITS)}


def outline(x: Array, y: Array, pressure: Array) -> list[dict[str, list[float]]]:
    """Return the edge of the contact as lines, (x, y) each, m; the staircase of the loaded cells is smoothed.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
    pressure : (nx, ny) array
    """
    from contourpy import contour_generator

    # Averaged over three cells, the staircase is a curve.
    loaded = uniform_filter((pressure > 0.0).astype(float), 3, mode="constant")
    lines: list[Any] = contour_generator(x, y, loaded.T).lines(0.5)  # type: ignore[assignment]
    every = max(1, -(-sum(len(line) for line in lines) // _OUTLINE))
    return [{"x": plain(line[::every, 0], 5), "y": plain(line[::every, 1], 5)} for line in map(_closed, lines)]


def _closed(line: Any) -> Array:
    return np.asarray(line if np.array_equal(line[0], line[-1]) else np.vstack([line, line[:1]]))


def profile(asked: Asked, case: IndenterCase, solution: ContactSolution) -> Profile:
    """Cut a contact along its centre line, with the trail behind it.

    Where the indenter is elastic, what is solved for is the sum of both bodies' displacements; the rubber's share is
    found from the pressure.
    """
    trail_x, trail = _trail(asked, case, solution)
    x, pressure = solution.x, _centre(solution.y, solution.pressure)
    displacement = _centre(solution.y, solution.displacement)
    gap = displacement - (solution.indentation - case.indenter.height(x, np.zeros_like(x)))
    loaded = pressure > 0.0
    own = np.interp(x, trail_x, trail)
    if case.modulus is None or solution.geometry == "line":  # a line's level is a convention
        trail += float(np.mean((displacement - own)[loaded]))
        own = np.interp(x, trail_x, trail)
    surface = displacement if case.modulus is None else own
    beyond = (trail_x < x[0]) | (trail_x > x[-1])
    order = np.argsort(np.concatenate([x, trail_x[beyond]]))

    def joined(inside: Array, outside: Array) -> Array:
        return np.asarray(np.concatenate([inside, outside[beyond]])[order])

    none = np.full_like(trail_x, np.nan)
    return Profile(
        joined(x, trail_x),
        joined(pressure, np.zeros_like(trail_x)),
        joined(-surface, -trail),
        joined(gap - surface, none),
    )


def _trail(asked: Asked, case: IndenterCase, solution: ContactSolution) -> tuple[Array, Array]:
    """Return the rubber's displacement on the centre line, from well behind the contact to well ahead."""
    modes = asked.rubber.material.modes_at(case.temperature)
    x, y, pressure = solution.x, solution.y, solution.pressure
    if solution.geometry == "point" and all(size % 2 == 0 for size in pressure.shape):
        x, y, pressure = thinned(x, y, pressure, max(pressure.shape) // max(1, max(pressure.shape) // 64))
    length = solution.front + solution.rear
    found = surface_displacement(
        x,
        y,
        pressure,
        speed=case.speed,
        E_inf=modes.E_inf,
        C=modes.C,
        tau=modes.tau,
        poisson_ratio=asked.rubber.material.poisson_ratio,
        layer=case.layer,
        behind=_BEHIND * length,
        ahead=_AHEAD * length,
    )
    return found.x, _centre(found.y, found.displacement)


def _centre(y: Array, field: Array) -> Array:
    """Return the line of a field through the axis."""
    middle = np.flatnonzero(np.isclose(np.abs(y), np.abs(y).min(), rtol=1e-6))
    return np.asarray(field[:, middle].mean(axis=1))


def surface_profile(solution: PeriodicSolution) -> Profile:
    """Cut a rough contact along x where its pressure is largest; see `Profile`."""
    row = int(np.argmax(solution.pressure.max(axis=0)))
    surface = -solution.displacement[:, row]
    return Profile(solution.x, solution.pressure[:, row], surface, surface + solution.gap[:, row])


def shown(cut: Profile) -> dict[str, Any]:
    """Return a cut as JSON holds it; null where there is nothing to show."""
    every = max(1, -(-len(cut.x) // MOST_POINTS))
    return {name: plain(values[::every], 5) for name, values in cut._asdict().items()}
