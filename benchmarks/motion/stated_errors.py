"""Whether the errors that contacts over time state hold: random histories against solutions ten times as accurate.

Usage: python benchmarks/motion/stated_errors.py [--count 120] [--first 0] [--accuracy 3e-3 3e-2]
       [--kinds ball cone ... | cells] [--seconds 300] [--lines FILE]

Ball and cone pressed on (springs), a cylinder, a profile, a ball, a cylinder on a layer and an ellipsoid (cells),
ridges and a rough surface (waves) in turn.  1 to 20 modes over up to six decades, E_inf/E0 from 2 to 1e3, the longest
retardation time from a hundredth to ten times the history.  Histories: steps of load or depth, ramps, a start of
sliding after a dwell or from rest, a reversal, a stop of steady sliding; in one of four the temperature changes.  One
of four returns all steps, the others six times.

Each is compared, at all its times, with the same problem at a tenth of the accuracy, point contacts on cells at a
quarter (they are solved to 2e-2 or worse), those on springs at 2e-4 or better, which has twice the springs.  An error
counts as holding where the difference is no more than it and the error that the finer solution states for itself;
`strict` leaves the latter out.  `worst` is the largest ratio of the difference, less the finer solution's error, to the
stated error.

With `--lines` each problem is written to a file (JSON lines) as soon as it is solved; those in it are not solved again,
and the tables are of all problems of these kinds in it.  A problem is given up after `--seconds` of CPU time.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import time
from pathlib import Path
from typing import Any, NamedTuple

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "contact"))
import measuring
import numpy as np
import problems  # noqa: F401  (where the tests' surfaces are found)

import viscofric as vf
from contact.made_surfaces import self_affine
from viscofric.contact.free.scale import Scale

E0, RADIUS, POISSON_RATIO, DURATION = 1e6, 10e-3, 0.5, 1.0
PLANE_STRAIN = E0 / (1.0 - POISSON_RATIO**2)
LAW = vf.Arrhenius("40 kJ/mol", reference=300.0)
KINDS = (
    "ball",
    "cylinder",
    "ridges",
    "cone",
    "ball that slides",
    "profile",
    "rough",
    "cylinder on a layer",
    "ellipsoid",
)
POINT_CONTACTS = ("ball", "cone", "ball that slides", "ellipsoid")
PRESSED = ("ball", "cone", "ellipsoid")
PERIODIC = ("ridges", "rough")
ON_SPRINGS = ("ball", "cone")
ON_CELLS = ("cylinder", "ball that slides", "profile", "cylinder on a layer", "ellipsoid")
COSTLY, LEAST_COSTLY, FINER_COSTLY = ("ball that slides", "ellipsoid"), 2e-2, 0.25
FINER = 0.1
MOST_ON_SPRINGS = 2e-4
LEAST = 1e-9  # of rounding and of the contact conditions, relative to the largest value
COLUMNS = (
    ("values", "values", "d"),
    ("within", "within", ".4f"),
    ("strict", "strict", ".4f"),
    ("all of a run", "runs", ".3f"),
    ("true/stated, median", "median", ".3f"),
    ("90 %", "most", ".2f"),
    ("worst", "worst", ".2f"),
)
#: Name → value and stated error of a solution.
QUANTITIES = {
    "friction": ("friction_force", "friction_force"),
    "indentation": ("indentation", "indentation"),
    "load": ("load", "load"),
    "energy": ("dissipated", "energy"),
}


class Case(NamedTuple):
    """A history to be solved."""

    name: str
    kind: str
    material: vf.Material
    body: Any
    history: vf.motion.History
    settings: dict[str, Any]


def _material(rng: np.random.Generator) -> tuple[vf.Material, str]:
    ratio, count = 10.0 ** rng.uniform(0.3, 3.0), round(20.0 ** rng.uniform())
    ages = np.sort(rng.uniform(0.0, 6.0, count))
    tau = DURATION * 10.0 ** (rng.uniform(-2.0, 1.0) + ages[0] - ages)
    share = tau ** rng.uniform(-0.2, 0.4) * rng.exponential(size=count) + 1e-3
    C = (1.0 - 1.0 / ratio) / E0 * share / share.sum()
    spectrum = vf.RetardationSpectrum(E0, E0 * ratio, C, tau)
    material = vf.Material(spectrum, poisson_ratio=POISSON_RATIO, shift=LAW)
    return material, f"E∞/E0 = {ratio:.3g}, {count} modes, τ = {tau.min():.2g} … {tau.max():.2g} s"


def _body(kind: str, rng: np.random.Generator) -> tuple[Any, float, float, dict[str, Any]]:
    """Return an indenter or surface, its largest load and depth or pressure, its unit of paths, and settings."""
    if kind in PERIODIC:
        if kind == "ridges":
            x = 2.0 * np.pi * np.arange(64) / 64.0
            z = sum(np.cos(n * x + rng.uniform(0.0, 6.0)) / n**1.5 for n in range(1, 4))[:, None]
        else:
            z = self_affine(24, hurst=rng.uniform(0.5, 1.0), points_per_shortest_wave=4.0, seed=int(rng.integers(1e6)))
        spacing = 1e-5
        z = z * (0.05 * spacing / float(np.std(np.diff(z, axis=0))))
        surface = vf.contact.PeriodicSurface(z, (spacing, spacing))
        return surface, 0.05 * PLANE_STRAIN * 10.0 ** rng.uniform(-1.5, -0.3), 20.0 * spacing, {}
    line = kind not in POINT_CONTACTS
    load = 10.0 if line else 0.1
    if kind == "cone":
        indenter: Any = vf.Cone(f"{rng.uniform(3.0, 15.0)} deg")
    elif kind == "ellipsoid":
        indenter = vf.Ellipsoid(RADIUS, 1.5 * RADIUS)
    elif kind == "profile":
        x = np.linspace(-2e-3, 2e-3, 161)
        indenter = vf.Profile(x**2 / (2.0 * RADIUS) + 1e-6 * np.cos(4e3 * x + rng.uniform(0.0, 6.0)), spacing=2.5e-5)
    else:
        indenter = vf.Cylinder(RADIUS) if line else vf.Ball(RADIUS)
    length = Scale.for_load(indenter, PLANE_STRAIN, load).length
    settings = {"layer": vf.Layer(thickness=length * 10.0 ** rng.uniform(0.0, 0.7))} if "layer" in kind else {}
    return indenter, load, length, settings


def _history(kind: str, load: float, length: float, rng: np.random.Generator) -> tuple[vf.motion.History, str]:
    still = kind in PRESSED
    shapes = ("steps", "ramps") if still else ("steps", "ramps", "start", "start from rest", "reversal", "stop")
    shape = str(rng.choice(shapes))
    before = {"start from rest": "at rest", "reversal": "at rest", "stop": "sliding"}.get(shape, "untouched")
    speed = length * rng.uniform(0.3, 1.0 if kind == "ball that slides" else 2.0) / DURATION
    first, second = np.sort(rng.uniform(0.1, 0.9, 2)) * DURATION
    time = np.array([0.0, first, first, second, second, DURATION])
    level = rng.uniform(0.2, 1.0, 3)
    values, speeds = np.ones(6), np.zeros(6)
    if shape == "steps":
        values = level[[0, 0, 1, 1, 2, 2]]
    elif shape == "ramps":
        values = np.array([0.0, *level[[0, 0, 1, 1, 2]]])
    if shape in ("start", "start from rest"):
        speeds = np.array([0, 0, 1, 1, 1, 1]) if shape == "start" else np.ones(6)
    elif shape in ("reversal", "stop"):
        speeds = np.array([1, 1, 1, 1, -1, -1]) if shape == "reversal" else np.array([1, 1, 1, 1, 0, 0])
    elif not still and rng.uniform() < 0.5:
        speeds, shape = np.ones(6), f"{shape} while sliding"
    control = "pressure" if kind in PERIODIC else "load"
    if kind in ("ball", "cone", "ellipsoid", "ball that slides") and rng.uniform() < 0.4:
        control, load = "indentation", length**2 / RADIUS
    temperature: Any = 300.0
    if rng.uniform() < 0.25:
        temperature, shape = np.interp(time, [0.0, DURATION], 300.0 + rng.uniform(-20.0, 30.0, 2)), f"{shape}, warming"
    moves = {} if still or not np.any(speeds) else {"speed": speed * speeds}
    given: dict[str, Any] = {control: load * values}
    return vf.motion.History(
        time, **given, **moves, temperature=temperature, before=before
    ), f"{shape}, {control} given"


def draw(number: int, accuracy: tuple[float, float] = (3e-3, 3e-2), kinds: tuple[str, ...] = KINDS) -> Case:
    """Return one of the random histories."""
    rng, kind = np.random.default_rng([3, number]), kinds[number % len(kinds)]
    material, rubber = _material(rng)
    body, load, length, settings = _body(kind, rng)
    history, motion = _history(kind, load, length, rng)
    low, high = accuracy
    if kind in COSTLY:
        low = min(max(low, LEAST_COSTLY), high)
    settings["accuracy"] = float(np.exp(rng.uniform(math.log(low), math.log(high))))
    jumps = history.time[1:-1:2]
    if rng.uniform() < 0.75:
        some = np.sort(rng.uniform(0.0, DURATION, 4))
        settings["times"] = np.sort([*some, float(rng.choice(jumps)), DURATION])
    name = f"{number}: {kind}, {motion}, {rubber}, {settings['accuracy']:.1e}"
    return Case(name, kind, material, body, history, settings)


class _TooLongError(Exception):
    """A problem has taken more CPU time than allowed."""


def solve_both(
    case: Case, seconds: float = math.inf
) -> tuple[vf.motion.TransientSolution, vf.motion.TransientSolution]:
    """Solve a case as it stands, and much more finely at the same times."""
    begun = time.process_time()

    def check(reached: float, end: float) -> None:
        if time.process_time() - begun > seconds:
            raise _TooLongError

    coarse = vf.motion.solve_transient(case.material, case.body, case.history, **case.settings, progress=check)
    part = FINER_COSTLY if case.kind in COSTLY else FINER
    accuracy = part * case.settings["accuracy"]
    if case.kind in ON_SPRINGS:
        accuracy = min(accuracy, MOST_ON_SPRINGS)
    finer = dict(case.settings, accuracy=accuracy, times=coarse.time)
    return coarse, vf.motion.solve_transient(case.material, case.body, case.history, **finer, progress=check)


def compare(case: Case, coarse: vf.motion.TransientSolution, fine: vf.motion.TransientSolution) -> list[dict[str, Any]]:
    """Return, for each quantity, its errors as stated, as found, and as the finer solution states its own; (n,)."""
    rows = []
    for name, (value, error) in QUANTITIES.items():
        found, true = getattr(coarse, value), getattr(fine, value)
        stated, left = getattr(coarse.errors, error), getattr(fine.errors, error)
        prescribed = {"load": "load", "pressure": "load", "indentation": "indentation"}.get(case.history.control)
        if name == prescribed or (name == "friction" and not case.history.moves):
            continue
        size = max(float(np.abs(true).max()), float(fine.work.max()) if name == "energy" else 0.0)
        apart = np.maximum(0.0, np.abs(found - true) - LEAST * size)
        rows.append({"case": case.name, "number": name, "time": coarse.time.tolist(), "stated": stated.tolist(),
                     "apart": apart.tolist(), "left": left.tolist(), "size": size})  # fmt: skip
    return rows


def summary(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the share of errors that hold, for each quantity."""
    result = []
    for name in dict.fromkeys(row["number"] for row in rows):
        those = [row for row in rows if row["number"] == name]
        stated, apart, left = (np.concatenate([row[key] for row in those]) for key in ("stated", "apart", "left"))
        ratio = np.where(apart > 0.0, np.maximum(0.0, apart - left) / np.maximum(stated, 1e-300), 0.0)
        runs = [np.all(np.array(row["apart"]) <= np.add(row["stated"], row["left"])) for row in those]
        true = np.where(apart > 0.0, apart / np.maximum(stated, 1e-300), 0.0)
        result.append(
            {
                "case": name,
                "values": len(stated),
                "within": float(np.mean(apart <= stated + left)),
                "strict": float(np.mean(apart <= stated)),
                "runs": float(np.mean(runs)),
                "median": float(np.median(true)),
                "most": float(np.quantile(true, 0.9)),
                "worst": float(ratio.max()),
            }
        )
    return result


def measured(case: Case, seconds: float = math.inf) -> dict[str, Any]:
    """Return the errors of a case, or why it has none."""
    begun = time.process_time()
    found: dict[str, Any] = {"case": case.name, "kind": case.kind, "accuracy": case.settings["accuracy"], "rows": []}
    try:
        coarse, fine = solve_both(case, seconds)
    except vf.ConvergenceError as failure:
        return {**found, "unsolved": f"{case.name}: {failure}", "seconds": time.process_time() - begun}
    except _TooLongError:
        return {**found, "unsolved": f"{case.name}: given up after {seconds:g} CPU s", "seconds": seconds}
    found |= {"rows": compare(case, coarse, fine), "imbalance": coarse.energy_imbalance}
    return {**found, "seconds": time.process_time() - begun}


def too_small(rows: list[dict[str, Any]]) -> list[str]:
    """Return a line for each quantity of a problem that has a stated error too small."""
    lines = []
    for row in rows:
        ratio = np.divide(np.subtract(row["apart"], row["left"]), np.maximum(row["stated"], 1e-300))
        at = int(np.argmax(ratio))
        if ratio[at] > 1.0:
            lines.append(
                f"{row['case']}: {row['number']} off by {ratio[at]:.2f} times the stated "
                f"{row['stated'][at]:.2e} at {row['time'][at]:.3g} s, size {row['size']:.2e}"
            )
    return lines


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--first", type=int, default=0, help="number of the first random history")
    parser.add_argument("--accuracy", type=float, nargs=2, default=(3e-3, 3e-2), help="least and largest")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=(*KINDS, "cells"), help="cells: all on cells")
    parser.add_argument("--seconds", type=float, default=math.inf, help="CPU time after which a problem is given up")
    parser.add_argument("--lines", type=Path, help="file of the problems solved, to be continued")
    options = parser.parse_args(arguments)
    kinds = ON_CELLS if "cells" in options.kinds else tuple(options.kinds)
    found = []
    if options.lines is not None and options.lines.exists():
        found = [json.loads(line) for line in options.lines.read_text(encoding="utf-8").splitlines()]
    done = {one["case"] for one in found}
    for number in range(options.first, options.first + options.count):
        case = draw(number, tuple(options.accuracy), kinds)
        if case.name in done:
            continue
        found.append(measured(case, options.seconds))
        for line in too_small(found[-1]["rows"]):
            print(line, flush=True)
        if options.lines is not None:
            with options.lines.open("a", encoding="utf-8") as file:
                file.write(json.dumps(found[-1], ensure_ascii=False) + "\n")
    print_tables([one for one in found if one["kind"] in kinds], kinds)


def print_tables(found: list[dict[str, Any]], kinds: tuple[str, ...]) -> None:
    """Print the shares of errors that hold, imbalances of energy, and what was not solved."""
    for title, some in [*((kind, (kind,)) for kind in kinds), ("all", kinds)]:
        rows = [row for one in found if one["kind"] in some for row in one["rows"]]
        if rows:
            measuring.print_table(title, summary(rows), COLUMNS)
    imbalances = [one["imbalance"] / one["accuracy"] for one in found if "imbalance" in one]
    if imbalances:
        print(f"\nimbalance of energy over the accuracy: {np.median(imbalances):.2g}, at most {max(imbalances):.2g}")
    unsolved = [one["unsolved"] for one in found if "unsolved" in one]
    print(f"solved: {len(found) - len(unsolved)}, not solved: {len(unsolved)}", *unsolved, sep="\n")
    print(f"CPU s: {sum(one['seconds'] for one in found):.0f}")


if __name__ == "__main__":
    main()
