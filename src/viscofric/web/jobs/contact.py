"""Job ``contact``: one contact at a speed and a temperature, at first coarsely, then to the study's accuracy."""

from __future__ import annotations

import math
from typing import Any, Literal, NamedTuple

import numpy as np
from pydantic import Field
from scipy.ndimage import uniform_filter

from viscofric.arrays import Array, centre_line
from viscofric.contact.fields.surface import surface_displacement
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import LOOSE
from viscofric.datasets import plain
from viscofric.friction.cases.case import Case, Rubbers, moved
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.notes import listed
from viscofric.report.texts.contact import contact_rows
from viscofric.study.study_rubber import StudyRubber
from viscofric.web.figures.contact import contact_view
from viscofric.web.jobs.combinations import of_combination, of_material, page_sweep
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.rubbers import study_rubber
from viscofric.web.study_text import study_of

#: Points of a map along its longer edge, and of a profile, at most.
MOST_CELLS, MOST_POINTS = 110, 400
# Free space around the contact in the map, over the contact's length.
_MARGIN = 0.05
# How far a profile reaches behind the contact and ahead of it, over the contact's length.
_BEHIND, _AHEAD = 1.2, 0.6
# Points of the contact's outline at most; a rough surface's spots are shown by colour.
_OUTLINE = 1_500
_DIGITS, _FEW_DIGITS = 6, 3


class Profile(NamedTuple):
    """A cut along the motion, (n,) each, SI, NaN where nothing is to be shown; heights from the undeformed surface."""

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
    """Average over blocks of cells, at most `most` along each edge; cells left over at the ends are cut off."""
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
    """Return the edge of the contact as lines, (x, y) each, m; the staircase of the loaded cells is smoothed."""
    from contourpy import contour_generator

    # Averaged over three cells, the staircase is a curve.
    loaded = uniform_filter((pressure > 0.0).astype(float), 3, mode="constant")
    lines: list[Any] = contour_generator(x, y, loaded.T).lines(0.5)  # type: ignore[assignment]
    every = max(1, -(-sum(len(line) for line in lines) // _OUTLINE))
    return [{"x": plain(line[::every, 0], 5), "y": plain(line[::every, 1], 5)} for line in map(_closed, lines)]


def _closed(line: Any) -> Array:
    return np.asarray(line if np.array_equal(line[0], line[-1]) else np.vstack([line, line[:1]]))


def profile(rubber: StudyRubber, case: IndenterCase, solution: ContactSolution) -> Profile:
    """Cut a contact along its centre line, with the trail behind it and the rubber's share of the displacement."""
    trail_x, trail = _trail(rubber, case, solution)
    x, pressure = solution.x, centre_line(solution.y, solution.pressure)
    displacement = centre_line(solution.y, solution.displacement)
    gap = displacement - (solution.indentation - case.indenter.height(x, np.zeros_like(x)))
    loaded = pressure > 0.0
    own = np.interp(x, trail_x, trail)
    if case.modulus is None or solution.geometry == "line":  # a line's level is a convention
        trail += float(np.mean((displacement - own)[loaded]))
        own = np.interp(x, trail_x, trail)
    surface = displacement if case.modulus is None else own
    half = 0.5 * (x[1] - x[0])  # the trail may be at the same places, but for rounding
    beyond = (trail_x < x[0] - half) | (trail_x > x[-1] + half)
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


def _trail(rubber: StudyRubber, case: IndenterCase, solution: ContactSolution) -> tuple[Array, Array]:
    """Return the rubber's displacement on the centre line, from well behind the contact to well ahead."""
    modes = rubber.material.modes_at(case.temperature)
    x, y, pressure = solution.x, solution.y, solution.pressure
    if solution.geometry == "point" and all(size % 2 == 0 for size in pressure.shape):
        x, y, pressure = thinned(x, y, pressure, max(pressure.shape) // max(1, max(pressure.shape) // 32))
    length = solution.front + solution.rear
    found = surface_displacement(
        x,
        y,
        pressure,
        speed=case.speed,
        E_inf=modes.E_inf,
        C=modes.C,
        tau=modes.tau,
        poisson_ratio=rubber.material.poisson_ratio,
        layer=case.layer,
        behind=_BEHIND * length,
        ahead=_AHEAD * length,
    )
    return found.x, centre_line(found.y, found.displacement)


def surface_profile(solution: PeriodicSolution) -> Profile:
    """Cut a rough contact along x where its pressure is largest; see `Profile`."""
    row = int(np.argmax(solution.pressure.max(axis=0)))
    surface = -solution.displacement[:, row]
    return Profile(solution.x, solution.pressure[:, row], surface, surface + solution.gap[:, row])


def shown(cut: Profile) -> dict[str, Any]:
    """Return a cut as JSON holds it; null where there is nothing to show."""
    every = max(1, -(-len(cut.x) // MOST_POINTS))
    return {name: plain(values[::every], 5) for name, values in cut._asdict().items()}


def pictures(
    case: Case, rubber: StudyRubber, solution: ContactSolution | PeriodicSolution, *, sharp: bool
) -> dict[str, Any]:
    """Return everything that the page shows of a contact, SI; `sharp`: whether it is to the study's accuracy.

    Each of ``numbers`` has ``value`` and ``error``; ``within`` is 1 where the rubber was measured at the contact's
    frequencies, 0 where it is extrapolated, null where that is not known.
    """
    within = rubber.is_within(case, case.record(solution))
    warnings = dict.fromkeys([*solution.warnings, *rubber.material.notes_at(case.temperature)])
    shared: dict[str, Any] = {
        "stage": "sharp" if sharp else "coarse",
        "speed": case.speed,
        "temperature": case.temperature,
        # Warnings on the material itself belong to other steps.
        **listed("warnings", warnings, "page"),
    }
    drawn: Any = _of_surface if case.geometry == "rough" else _of_indenter
    found: dict[str, Any] = drawn(rubber, case, solution)
    found["numbers"]["within"] = _with_error(None if within is None else float(within))
    found |= shared
    return found | contact_view(found, case, contact_rows(solution))


def _of_indenter(rubber: StudyRubber, case: IndenterCase, solution: ContactSolution) -> dict[str, Any]:
    line = solution.geometry == "line"
    return {
        "kind": solution.geometry,
        "direction": 0.0,
        "numbers": _numbers(solution, _of_case(rubber, case, solution)),
        "map": None if line else pressure_map(*around(solution)),
        "outline": [] if line else outline(solution.x, solution.y, solution.pressure),
        "profile": shown(profile(rubber, case, solution)),
    }


def _of_surface(rubber: StudyRubber, case: SurfaceCase, solution: PeriodicSolution) -> dict[str, Any]:
    line = solution.pressure.shape[1] == 1
    shortest, longest = case.surface.wavelengths
    return {
        "kind": "rough",
        "direction": math.atan2(solution.direction[1], solution.direction[0]),
        "numbers": _numbers(
            solution,
            {
                "pressure": solution.mean_pressure,
                "slowest_frequency": 2.0 * math.pi * case.speed / longest,
                "fastest_frequency": 2.0 * math.pi * case.speed / shortest,
                **_rubber_at(rubber, case, 2.0 * math.pi * case.speed / shortest),
                "points": max(solution.pressure.shape),
                "points_requested": max(case.surface.shape),
            },
        ),
        "map": None if line else pressure_map(solution.x, solution.y, solution.pressure),
        "outline": [],
        "profile": shown(surface_profile(solution)),
    }


def _with_error(value: float | None, error: float | None = None) -> dict[str, float | None]:
    return {"value": value, "error": error}


def _numbers(solution: ContactSolution | PeriodicSolution, more: dict[str, float]) -> dict[str, Any]:
    """Return the numbers of a contact, each with its error where it has one, and `more` without errors."""
    own = {name: _with_error(value, error) for name, (_, value, _, error) in solution.number_rows.items()}
    return dict(plain(own | {name: _with_error(value) for name, value in more.items()}, _DIGITS))


def _of_case(rubber: StudyRubber, case: IndenterCase, solution: ContactSolution) -> dict[str, float]:
    """Return what depends on the indenter's and the rubber's range too."""
    length = solution.front + solution.rear
    half = solution.half_width if math.isfinite(solution.half_width) else 0.5 * length
    frequency = case.speed / (0.5 * length)
    return {
        "reach": max(half, solution.front, solution.rear) / case.indenter.reach,
        "frequency": frequency,
        **_rubber_at(rubber, case, frequency),
    }


def _rubber_at(rubber: StudyRubber, case: Case, frequency: float) -> dict[str, float]:
    """Tell what the rubber is at a frequency (rad/s) and the contact's temperature."""
    modulus = complex(rubber.material.modes_at(case.temperature).complex_modulus(frequency))
    alpha = float(rubber.shift(case.temperature))
    return {
        "storage_modulus": modulus.real,
        "loss_factor": modulus.imag / modulus.real,
        "shift_factor": alpha,
        "reduced_speed": alpha * case.speed,
    }


#: Accuracy of coarse replies, the loosest that a run file may ask for.
COARSE = 0.1
#: Points along the longer edge of the surfaces of coarse replies: coarser likenesses of those with more.
COARSE_POINTS = 128


class Options(JobOptions):
    """Which contact of the study is wanted, and how well."""

    speed: float = Field(gt=0.0, lt=1e9)  # speed, temperature: m/s and K, instead of the study's
    temperature: float = Field(gt=0.0, lt=1e5)
    #: Of all else that the study varies (loads, radii, seeds …); see `viscofric.web.jobs.combinations`
    combination: int = Field(0, ge=0, lt=1_000_000)
    #: A coarse reply, one to the study's accuracy, or the first as a part and the second as the result
    stages: Literal["coarse", "sharp", "both"] = "both"


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Solve one contact, coarsely or to the study's accuracy; then its numbers are those of a study of it alone."""
    _, checked = study_of(study, context.files)
    first = of_combination(page_sweep(checked), options.combination)
    rubber = study_rubber(of_material(study, first.material), context, [options.temperature])
    case = moved(first, material=0, speed=options.speed, temperature=options.temperature)
    accuracy = checked.solver.accuracy
    rubbers = Rubbers([rubber.material], {})
    if options.stages != "sharp":
        solution: Any = case.solution(rubbers, COARSE, COARSE_POINTS)
        # Grids are refined until they promise the accuracy: where the first of them do, no others are looked at, if a
        # study begins with the same grids.
        same = case.geometry == "line" or (case.geometry == "point" and accuracy >= LOOSE)
        allowed = accuracy * abs(solution.friction_coefficient)
        settled = same and solution.diagnostics.friction_error <= allowed
        found = pictures(case, rubber, solution, sharp=settled)
        if settled or options.stages == "coarse":
            return found
        context.part(found)
    return pictures(case, rubber, case.solution(rubbers, accuracy), sharp=True)
