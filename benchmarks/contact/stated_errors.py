"""Whether the errors that contacts state hold: random contacts against solutions that are ten times as accurate.

Usage: python benchmarks/contact/stated_errors.py [--periodic] [--count 300] [--first 0] [--accuracy 1e-3 1e-2]
       [--json FILE]

Ball, cylinder, ellipsoid, cone, height map, ball and cylinder on a layer in turn; 1 to 40 modes over up to six decades,
E_inf/E0 from 1.5 to 1e4, the longest memory vτ/a0 from 1e-3 to 1e3, the load or the indentation given, and an accuracy
between the two.  Each is compared with the same contact at a tenth of the accuracy, and on finer cells at any rate.
An error counts as holding where the difference is no more than it and the error that the finer solution states for
itself; `strict` leaves the latter out.  A largest pressure that is not resolved is compared, too.  Of derivatives
it is the largest difference of the logarithmic ones.  Cases that reach no accuracy are counted.

With --periodic: rough surfaces of 64² or 96² points, 3 to 16 of them in the shortest wave, Hurst exponents from 0.3 to
1, on materials of 1 to 24 modes over seven decades, E_inf/E0 from 2 to 1e4; speeds over six decades, pressures over
four, one in five on a layer.  Each is compared with the same surface, by its Fourier series, on four times the points.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from pathlib import Path
from typing import Any, NamedTuple

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import numpy as np
import problems  # noqa: F401  (where the tests' surfaces are found)
import random_rough

import viscofric as vf
from contact.made_surfaces import refined
from viscofric.contact.free.scale import Scale

POISSON_RATIO, E0, RADIUS = 0.5, 1e6, 10e-3
SHAPES = ("ball", "cylinder", "ellipsoid", "cone", "height map", "ball on a layer", "cylinder on a layer")
MOST_MODES, MOST_DECADES = 40, 6.0
#: The finer solution: a part of the accuracy; four times the cells, twice where that would be more than these.
FINER, FINEST = 0.1, {"point": 512, "line": 32768}
PERIODIC_FINER = 4
LEAST = 1e-12  # of rounding
COLUMNS = (
    ("contacts", "contacts", "d"),
    ("within", "within", ".4f"),
    ("strict", "strict", ".4f"),
    ("beyond 1.5 x", "far", "d"),
    ("stated, median", "stated", ".1e"),
    ("true, median", "true", ".1e"),
    ("worst ratio", "worst", ".2f"),
)


class Case(NamedTuple):
    """A contact to be solved."""

    name: str
    material: vf.Material
    body: Any  # an indenter, or heights and spacing of a periodic surface
    settings: dict[str, Any]


def _height_map(rng: np.random.Generator) -> vf.HeightMap:
    """Return a ball with waves of some micrometres on it."""
    x = np.linspace(-4e-3, 4e-3, 81)
    z = (x[:, None] ** 2 + x**2) / (2.0 * RADIUS)
    for angle in rng.uniform(0.0, math.pi, 4):
        along = x[:, None] * math.cos(angle) + x * math.sin(angle)
        z += 2e-6 * rng.normal() * np.cos(rng.uniform(1e3, 5e3) * along + rng.uniform(0.0, 6.0))
    return vf.HeightMap(z, spacing=1e-4)


def draw(number: int, accuracy: tuple[float, float] = (1e-3, 1e-2)) -> Case:
    """Return one of the random contacts."""
    rng, shape = np.random.default_rng([1, number]), SHAPES[number % len(SHAPES)]
    ratio, memory = 10.0 ** rng.uniform(math.log10(1.5), 4.0), 10.0 ** rng.uniform(-3.0, 3.0)
    count = round(MOST_MODES ** rng.uniform())
    ages = np.sort(rng.uniform(0.0, MOST_DECADES, count))
    tau = memory * 10.0 ** (ages[0] - ages)
    share = tau ** rng.uniform(-0.2, 0.4) * rng.exponential(size=count) + 1e-3
    line = shape.startswith("cylinder")
    load = 10.0 if line else 0.1
    if shape == "ellipsoid":
        indenter: Any = vf.Ellipsoid(RADIUS, RADIUS * 10.0 ** rng.uniform(-1.0, 1.0))
    elif shape == "cone":
        indenter = vf.Cone(f"{rng.uniform(1.0, 15.0)} deg")
    else:
        indenter = _height_map(rng) if shape == "height map" else vf.Cylinder(RADIUS) if line else vf.Ball(RADIUS)
    scale = Scale.for_load(indenter, E0 / (1.0 - POISSON_RATIO**2), load)
    given = {"load": load} if line or rng.uniform() < 0.5 else {"indentation": scale.depth}
    settings: dict[str, Any] = {"speed": 1.0, **given}
    if "layer" in shape:
        settings["layer"] = vf.Layer(thickness=scale.length * 10.0 ** rng.uniform(-0.5, 0.7))
    settings["accuracy"] = 10.0 ** rng.uniform(*np.log10(accuracy))
    C = (1.0 - 1.0 / ratio) / E0 * share / share.sum()
    material = vf.Material(vf.RetardationSpectrum(E0, E0 * ratio, C, tau * scale.length), poisson_ratio=POISSON_RATIO)
    name = f"{number}: {shape}, E∞/E0 = {ratio:.3g}, {count} modes, vτ/a0 = {memory:.2g}, {next(iter(given))} given"
    return Case(name, material, indenter, settings)


def draw_periodic(number: int) -> Case:
    """Return one of the random rough contacts."""
    drawn = random_rough.draw(np.random.default_rng([2, number]), number, (64, 96))
    spectrum, pressure = drawn.material.modes_at(None), drawn.motion["pressure"]
    name = (
        f"{number}: {len(drawn.heights)}² points, {drawn.shortest:.0f} in a wave, "
        f"E∞/E0 = {spectrum.E_inf / spectrum.E0:.3g}, p = {pressure:.2g} E0"
    )
    return Case(name, drawn.material, (drawn.heights, np.array(drawn.spacing)), drawn.motion)


def solve_both_periodic(case: Case) -> tuple[vf.contact.PeriodicSolution, vf.contact.PeriodicSolution]:
    """Solve a rough contact as it stands, and with more points."""
    z, spacing = case.body
    surfaces = (z, spacing), (refined(z, PERIODIC_FINER * len(z)), spacing / PERIODIC_FINER)
    coarse, fine = (
        vf.solve_periodic(case.material, vf.contact.PeriodicSurface(heights, tuple(cell)), **case.settings)
        for heights, cell in surfaces
    )
    return coarse, fine


def solve_both(case: Case) -> tuple[vf.contact.ContactSolution, vf.contact.ContactSolution]:
    """Solve a case as it stands, and much more finely.

    Raises
    ------
    ConvergenceError
        If the accuracy asked for, or a finer grid, cannot be had.
    """
    settings = dict(case.settings, derivatives=True)
    coarse = vf.solve_steady(case.material, case.body, **settings)
    settings["accuracy"] *= FINER
    cells, finest = max(coarse.diagnostics.shape), FINEST[coarse.geometry]
    wanted = max(2 * cells, min(4 * cells, finest))
    try:
        fine = vf.solve_steady(case.material, case.body, finest=finest, **settings)
    except vf.ConvergenceError:
        wanted = max(wanted, finest)
    else:
        if max(fine.diagnostics.shape) >= wanted:
            return coarse, fine
    return coarse, vf.solve_steady(case.material, case.body, grid=wanted, **settings)


def stated(solution: vf.contact.ContactSolution) -> dict[str, tuple[Any, float]]:
    """Return all numbers that come with an error, and the errors."""
    found, errors = solution, solution.diagnostics
    numbers: dict[str, tuple[Any, float]] = {
        "friction": (found.friction_coefficient, errors.friction_error),
        "indentation": (found.indentation, errors.indentation_error),
        "load": (found.load, errors.load_error),
        "area": (found.contact_area, errors.contact_area_error),
        "front": (found.front, errors.edge_error),
        "rear": (found.rear, errors.edge_error),
        "max pressure": (found.max_pressure, errors.max_pressure_error),
        "centre of pressure": (found.centre_of_pressure, errors.centre_of_pressure_error),
    }
    if found.geometry == "point":
        numbers["half-width"] = (found.half_width, errors.edge_error)
    assert found.derivatives is not None
    one = found.derivatives.logarithmic
    held = one.indentation if one.load is None else one.load
    numbers["derivatives"] = (np.concatenate([one.C, one.tau, [one.E_inf, one.speed, held]]), found.derivatives.error)
    return numbers


def compare(case: Case) -> list[dict[str, Any]]:
    """Return, for each number, its error as stated, as found, and as the finer solution states its own."""
    if isinstance(case.body, tuple):
        solved = solve_both_periodic(case)
        coarse, fine = (
            {
                "friction": (one.friction_coefficient, one.friction_error),
                "lateral friction": (one.lateral_friction_coefficient, one.diagnostics.lateral_friction_error),
            }
            for one in solved
        )
    else:
        coarse, fine = (stated(one) for one in solve_both(case))
    rows = []
    for name, (value, error) in coarse.items():
        true, left = fine[name]
        size = float(np.abs(true).max())
        apart = float(np.abs(np.asarray(value) - true).max())
        if error > 0.0:
            rows.append(
                {"case": case.name, "number": name, "stated": error, "apart": apart, "left": left, "size": size}
            )
    return rows


def summary(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the share of errors that hold, for each number."""
    result = []
    for name in dict.fromkeys(row["number"] for row in rows):
        error, apart, left, size = (
            np.array([row[key] for row in rows if row["number"] == name]) for key in ("stated", "apart", "left", "size")
        )
        apart = np.maximum(0.0, apart - LEAST * size)
        result.append(
            {
                "case": name,
                "contacts": len(error),
                "within": float(np.mean(apart <= error + left)),
                "strict": float(np.mean(apart <= error)),
                "far": int(np.sum(apart > 1.5 * error + left)),
                "stated": float(np.median(error[size > 0.0] / size[size > 0.0])),
                "true": float(np.median(apart[size > 0.0] / size[size > 0.0])),
                "worst": float(np.max(np.maximum(0.0, apart - left) / error)),
            }
        )
    return result


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--first", type=int, default=0, help="number of the first random contact")
    parser.add_argument("--accuracy", type=float, nargs=2, default=(1e-3, 1e-2), help="least and largest")
    parser.add_argument("--periodic", action="store_true", help="rough surfaces instead of indenters")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    rows: list[dict[str, Any]] = []
    unsolved: list[str] = []
    for number in range(options.first, options.first + options.count):
        case = draw_periodic(number) if options.periodic else draw(number, tuple(options.accuracy))
        try:
            found = compare(case)
        except vf.ConvergenceError as failure:
            unsolved.append(f"{case.name}: {failure}")
            continue
        for row in found:
            if row["apart"] > row["stated"] + row["left"] + LEAST * row["size"]:
                print(
                    f"{row['case']}: {row['number']} off by {row['apart']:.2e}, stated {row['stated']:.2e}", flush=True
                )
        rows += found
    table = summary(rows)
    measuring.print_table(f"stated errors of {options.count} random contacts", table, COLUMNS)
    print(f"\nno accuracy reached: {len(unsolved)}", *unsolved, sep="\n")
    measuring.write_json(options.json, {"summary": table, "rows": rows, "unsolved": unsolved})


if __name__ == "__main__":
    main()
