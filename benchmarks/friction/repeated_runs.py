"""Whether the standard errors of separated friction are honest where steps, not readings, are the repetitions.

Usage: python benchmarks/friction/repeated_runs.py [--orders] [--seeds N] [--first SEED] [--case WORD]
       [--check PERCENT] [--json FILE]

Sweeps over five speeds are made in the four sign configurations, eight readings a step, and read from a table with
step and time and no replicate.  Friction varies from run to run by a factor that all speeds of a run share, or anew
from step to step; readings scatter by 1 % of Coulomb friction, independently or with an autocorrelation.  For each
case the share of the planted coefficients that 95 % intervals hold is printed, and the width of the intervals over
that of a normal one made with the true standard deviation of the estimate.

With --orders, zero or Coulomb friction change in the course of random tests of two to eight speeds, one to three
temperatures and two to four replicates, of single readings that scatter by 0.01 N.  The cases are the orders in time,
what changes slowest first: of temperature (t), speed (s), configuration (c) and replicate (r), with the configurations
in random order.  The zero drifts by 0.05 to 0.5 N in the test, with either sign; Coulomb friction falls by half (wear),
or is 10 % higher in the first replicate (running in); ± is the standard error of a share over the tests.
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
import numpy as np

import viscofric as vf
from viscofric.traction import TractionRuns

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

#: (sgn u_disc, sgn(u_disc − u_ball))
CONFIGURATIONS = ((-1, 1), (-1, -1), (1, -1), (1, 1))
SPEEDS = 1e-3 * np.array([20.0, 40.0, 80.0, 130.0, 200.0])  # m/s
COULOMB, VISCOELASTIC = 0.045, 0.012 * (SPEEDS / 0.1) ** -0.3
LOAD, ZERO, SLIP = 25.0, 0.12, 0.05  # N, N, ratio
HEADINGS = "temperature (degC),step,time (s),disc speed (m/s),ball speed (m/s),load (N),traction force (N)"


@dataclass(frozen=True)
class Case:
    """How sweeps are made: standard deviations over the friction, and how readings follow each other."""

    coulomb: float = 0.0
    viscoelastic: float = 0.0
    runs: int = 3
    noise: float = 0.01
    autocorrelation: float = 0.0
    anew: bool = False
    configurations: tuple[tuple[int, int], ...] = CONFIGURATIONS
    readings: int = 8


CASES = {
    "white noise": Case(),
    "1 % from run to run": Case(0.01, 0.01),
    "3 and 5 % from run to run": Case(0.03, 0.05),
    "1 % from step to step": Case(0.01, 0.01, anew=True),
    "3 and 5 % from step to step": Case(0.03, 0.05, anew=True),
    "autocorrelation .7": Case(noise=0.03, autocorrelation=0.7, readings=60),
    "autocorrelation .7, 1 % from run to run": Case(0.01, 0.01, noise=0.03, autocorrelation=0.7, readings=60),
    "one run, white noise": Case(runs=1),
    "one run, 1 % from run to run": Case(0.01, 0.01, runs=1),
    "one run, 3 and 5 % from run to run": Case(0.03, 0.05, runs=1),
    "one run, 3 and 5 % from step to step": Case(0.03, 0.05, runs=1, anew=True),
    "one run of three configurations, autocorrelation .7": Case(
        noise=0.03, autocorrelation=0.7, runs=1, configurations=CONFIGURATIONS[:3], readings=60
    ),
}


def table(case: Case, seed: int) -> str:
    """Return the sweeps as a table: run after run, the configurations by turns."""
    random = np.random.default_rng([seed, 20261122])
    lines, step, time = [HEADINGS], 0, 0.0
    for _ in range(case.runs):
        for disc_sign, slip_sign in case.configurations:
            factors = 1.0 + np.array([case.coulomb, case.viscoelastic]) * random.standard_normal(2)
            for speed, friction in zip(SPEEDS, VISCOELASTIC, strict=True):
                if case.anew:
                    factors = 1.0 + np.array([case.coulomb, case.viscoelastic]) * random.standard_normal(2)
                step, time = step + 1, time + 30.0
                disc = disc_sign * speed
                ball = disc - slip_sign * SLIP * speed
                coefficient = factors[0] * COULOMB * slip_sign + factors[1] * friction * disc_sign
                for scatter in noise(random, case):
                    time += 1.0
                    load = LOAD * (1.0 + 0.003 * random.standard_normal())
                    force = ZERO + load * coefficient + scatter
                    lines.append(f"30,{step},{time:.0f},{disc:.6f},{ball:.6f},{load:.4f},{force:.6f}")
    return "\n".join(lines) + "\n"


def noise(random: np.random.Generator, case: Case) -> Array:
    """Return an autoregressive series of first order, N."""
    white = random.standard_normal(case.readings)
    series = np.empty(case.readings)
    series[0] = white[0]
    for place in range(1, case.readings):
        fresh = np.sqrt(1.0 - case.autocorrelation**2) * white[place]
        series[place] = case.autocorrelation * series[place - 1] + fresh
    return case.noise * COULOMB * LOAD * series


def true_errors(case: Case) -> dict[str, Array]:
    """Return the standard deviations of the estimates at each speed, as planted (equal weights)."""
    count, rho = case.readings, case.autocorrelation
    lags = np.arange(1, count)
    of_mean = (1.0 + 2.0 * np.sum((1.0 - lags / count) * rho**lags)) / count
    variance = (case.coulomb * COULOMB) ** 2 + (case.viscoelastic * VISCOELASTIC) ** 2
    variance = (variance + (case.noise * COULOMB) ** 2 * of_mean) / case.runs
    design = np.array([(1.0, disc, slip) for disc, slip in case.configurations])
    inverse = np.linalg.inv(design.T @ design)
    return {name: np.sqrt(variance * inverse[k, k]) for name, k in (("viscoelastic", 1), ("coulomb", 2))}


#: What changes in tests made in different orders.
CHANGES = ("nothing", "drift", "wear", "running in")
ORDERS = ("trsc", "tsrc", "rtsc", "trcs", "tscr", "tcrs", "ctsr")
CONSTANT = 0.03


def changing(order: str, change: str, seed: int) -> TractionRuns:
    """Return a test with something that changes, and a viscoelastic coefficient of `CONSTANT`."""
    random = np.random.default_rng([seed, 20261130])
    counts = {"t": random.integers(1, 4), "s": random.integers(2, 9), "c": 4, "r": random.integers(2, 5)}
    signs = random.permutation(CONFIGURATIONS)
    grids = np.meshgrid(*(np.arange(counts[one]) for one in order), indexing="ij")
    place = {one: grid.ravel() for one, grid in zip(order, grids, strict=True)}
    disc_sign, slip_sign = signs[place["c"]].T
    speed = np.geomspace(0.02, 0.2, counts["s"])[place["s"]]
    time = 10.0 * np.arange(speed.size)
    course = time / time[-1]
    level = COULOMB * np.ones(speed.size)
    zero = ZERO + 0.01 * random.standard_normal(speed.size)
    drift = random.choice([-1.0, 1.0]) * 0.05 * 10.0 ** random.uniform()
    if change == "drift":
        zero += drift * course
    elif change == "wear":
        level *= 1.0 - 0.5 * course
    elif change == "running in":
        level *= 1.0 + 0.1 * (place["r"] == 0)
    load = LOAD * (1.0 + 0.01 * random.standard_normal(speed.size))
    force = zero + load * (CONSTANT * disc_sign + level * slip_sign)
    disc = disc_sign * speed
    kelvin = 303.15 + 10.0 * place["t"]
    runs = TractionRuns(disc, disc - slip_sign * SLIP * speed, force, load, kelvin, replicate=place["r"] + 1)
    return replace(runs, time=time)


def held_in(order: str, seeds: range) -> dict[str, dict[str, float]]:
    """Return for each change the share of viscoelastic coefficients that is held, its error, and the median width."""
    found = {}
    for change in CHANGES:
        shares, widths = [], []
        for seed in seeds:
            low, high = vf.separate(changing(order, change, seed)).interval(0.95)
            shares.append(np.mean((low <= CONSTANT) & (high >= CONSTANT)))
            widths.append(np.median(high - low))
        error = float(np.std(shares, ddof=1) / np.sqrt(len(shares)))
        found[change] = {"held": float(np.mean(shares)), "error": error, "width": float(np.median(widths))}
    return found


def measured(case: Case, seeds: range) -> dict[str, dict[str, float]]:
    """Return for each coefficient the share that is held, and the median and mean width over the necessary one."""
    planted = {"viscoelastic": VISCOELASTIC, "coulomb": np.full(SPEEDS.size, COULOMB)}
    necessary = {name: 2.0 * 1.959964 * error for name, error in true_errors(case).items()}
    held: dict[str, list[bool]] = {name: [] for name in planted}
    width: dict[str, list[float]] = {name: [] for name in planted}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sweeps.csv"
        for seed in seeds:
            path.write_text(table(case, seed), encoding="utf-8")
            curves = vf.separate(vf.read_mtm(path))
            for name, truth in planted.items():
                low, high = curves.interval(0.95, of=name)  # type: ignore[arg-type]
                held[name] += ((low <= truth) & (truth <= high)).tolist()
                width[name] += ((high - low) / necessary[name]).tolist()
    return {
        name: {
            "held": float(np.mean(held[name])),
            "median width": float(np.median(width[name])),
            "mean width": float(np.mean(width[name])),
        }
        for name in planted
    }


def of_cases(seeds: range, word: str) -> dict[str, Any]:
    """Print and return the results of the cases whose names hold a word."""
    results: dict[str, Any] = {}
    print("held by 95 % intervals, and their width (median, mean) over the necessary one")
    print(f"{'':52} {'viscoelastic':>24} {'Coulomb':>24}")
    for name, case in CASES.items():
        if word not in name:
            continue
        found = measured(case, seeds)
        shown = [
            f"{100 * one['held']:6.1f} % {one['median width']:7.2f} {one['mean width']:7.2f}" for one in found.values()
        ]
        print(f"{name:52} {shown[0]:>24} {shown[1]:>24}", flush=True)
        results[name] = found
    return results


def in_orders(seeds: range, word: str) -> dict[str, Any]:
    """Print and return the results of the orders whose names hold a word."""
    results: dict[str, Any] = {}
    print("viscoelastic friction held by 95 % intervals, and half their median width (1e-4)")
    print(f"{'':6}" + "".join(f"{change:>24}" for change in CHANGES))
    for order in ORDERS:
        if word not in order:
            continue
        found = results[order] = held_in(order, seeds)
        shown = [
            f"{100 * one['held']:6.1f} ± {100 * one['error']:.1f} %{0.5e4 * one['width']:7.1f}"
            for one in found.values()
        ]
        print(f"{order:6}" + "".join(f"{one:>24}" for one in shown), flush=True)
    return results


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--orders", action="store_true", help="tests in different orders, in which something changes")
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--first", type=int, default=0, help="seed of the first")
    parser.add_argument("--case", default="", help="only cases whose names hold this")
    parser.add_argument("--check", type=float, default=0.0, help="least share that must be held, %%")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    seeds = range(options.first, options.first + options.seeds)
    results: dict[str, Any] = in_orders(seeds, options.case) if options.orders else of_cases(seeds, options.case)
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(results, indent=1, ensure_ascii=False), encoding="utf-8")
    worst = min((one["held"] for found in results.values() for one in found.values()), default=0.0)
    if 100.0 * worst < options.check:
        raise SystemExit(f"only {100.0 * worst:.1f} % are held")


if __name__ == "__main__":
    main()
