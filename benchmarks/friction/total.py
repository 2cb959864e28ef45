"""Whether the 95 % bands of total friction, hysteresis and interface, hold that of other loads, shapes and tracks.

    python benchmarks/friction/total.py --scenes 8 --json total.json

Every problem is SYNTHETIC.  In each scene a ball of random radius and load is measured at random speeds and
temperatures, with slip; another ball, a cylinder, an ellipsoid, a cone, or all rough surfaces of a kind are to be
predicted, at slip speeds within those measured and half a decade beyond them.  In each draw a planted law of shear
stress makes Coulomb friction, with noise, on contacts solved to 2e-4; the law is fitted with contacts solved to 1e-2,
and total friction predicted to 1e-2.  The true total friction is that of the planted law on contacts solved to 2e-4.
Of rough surfaces a few are drawn; the truth is the mean of many others on the same grid.  With ``--material fitted``
the rubber is fitted to sweeps with 2 % of noise, so that both its contacts and its hysteresis are off.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from bands import sweeps
from interface import KINDS, planted

import viscofric as vf
from viscofric.friction.coulomb import with_interface
from viscofric.rheology.interface.friction import friction_on_area

SHAPES = ("ball", "cylinder", "ellipsoid", "cone", "rough")
PREDICTED = 4  # speeds
#: Rough surfaces of a kind: so many make the truth, a few of the others are drawn.
TRUE, OTHERS = 100, 40
PARTS = ("mostly hysteresis", "mixed", "mostly interface")

#: Of a law fitted, and the true stress: total friction, half-width of its band, truth, and interface over total.
Compared = Callable[[vf.friction.InterfaceLaw, Callable[..., Any], np.random.Generator], tuple[Any, Any, Any, Any]]


class Measured(NamedTuple):
    """Contacts of a measured ball, as the user solves them and as they are."""

    slip: float  # over speed
    solved: vf.FrictionCurves
    true: vf.FrictionCurves


def material(random: np.random.Generator, *, fitted: bool) -> tuple[vf.Material, vf.rheology.MaterialSamples | None]:
    """Return the rubber as the user knows it."""
    if not fitted:
        return vf.synthetic_fluoroelastomer(), None
    seed = int(random.integers(2**31))
    fit = vf.superpose(sweeps(0.02, seed), reference=303.15)
    spectrum = vf.fit_retardation_spectrum(fit.master_curve)
    return vf.Material(spectrum, fit.shift_factors), vf.sample_materials(fit, spectrum, samples=200, seed=seed)


def indenter(shape: str, random: np.random.Generator) -> tuple[vf.Indenter, float]:
    """Return an indenter and a load, N or N/m."""
    radius, load = random.uniform(3e-3, 15e-3), 10.0 ** random.uniform(0.0, 1.5)
    if shape == "cylinder":
        return vf.Cylinder(radius), 50.0 * load
    if shape == "ellipsoid":
        return vf.Ellipsoid(radius, radius * random.uniform(0.4, 2.5)), load
    return (vf.Cone(f"{random.uniform(3.0, 10.0)} deg"), load) if shape == "cone" else (vf.Ball(radius), load)


def scene(shape: str, random: np.random.Generator, *, fitted: bool) -> tuple[Measured, Compared]:
    """Return a measurement of a ball, and what is predicted of another contact."""
    rubber, samples = material(random, fitted=fitted)
    kelvins = 303.15 + np.linspace(0.0, random.uniform(30.0, 60.0), random.integers(3, 5))
    low = random.uniform(-3.0, -1.5)
    speeds = np.logspace(low, low + random.uniform(1.0, 2.0), random.integers(5, 7))
    ball, load = indenter("ball", random)
    asked = {"indenter": ball, "load": load, "speeds": speeds, "temperatures": kelvins}
    slip = float(random.choice([0.05, 1.0]))
    true = vf.synthetic_fluoroelastomer()
    ball_contacts = [vf.predict_friction(one, **asked, accuracy=goal) for one, goal in ((rubber, 1e-2), (true, 2e-4))]
    first, last = np.log10(slip * speeds[[0, -1]]) + np.array([-0.5, 0.5])
    other = {
        "speeds": 10.0 ** np.sort(random.uniform(first, last, PREDICTED)),
        "temperatures": float(random.choice(kelvins)),
    }
    compared = rough(rubber, other, random) if shape == "rough" else smooth(shape, rubber, samples, other, random)
    return Measured(slip, *ball_contacts), compared


def smooth(
    shape: str,
    rubber: vf.Material,
    samples: vf.rheology.MaterialSamples | None,
    other: dict[str, Any],
    random: np.random.Generator,
) -> Compared:
    """Return the comparison of an indenter's total friction."""
    body, load = indenter(shape, random)
    asked = {"indenter": body, "load": load, **other}
    found = vf.predict_friction(rubber, **asked, samples=samples, accuracy=1e-2)
    true = vf.predict_friction(vf.synthetic_fluoroelastomer(), **asked, accuracy=2e-4)

    def compared(
        law: vf.friction.InterfaceLaw, stress: Callable[..., Any], random: np.random.Generator
    ) -> tuple[Any, ...]:
        both = with_interface(found, law)
        truth = true.viscoelastic + stress(true.speed, true.temperature) / true.mean_pressure
        return both.total, 1.96 * both.total_error, truth, both.coulomb / both.total

    return compared


def rough(rubber: vf.Material, other: dict[str, Any], random: np.random.Generator) -> Compared:
    """Return the comparison of the mean total friction of all rough surfaces of a kind."""
    kind = {"rolloff": "250 um", "shortest": "128 um", "rms_slope": random.uniform(0.1, 0.3), "exact": False}
    first = int(random.integers(2**20))
    seeds = range(first, first + TRUE + OTHERS)
    tracks = [vf.self_affine(0.8, shape=(64, 64), spacing="16 um", seed=seed, **kind) for seed in seeds]
    found = vf.predict_rough_friction(rubber, tracks, **other, pressure=10.0 ** random.uniform(4.3, 5.7))
    speed, kelvin = found.speed, found.temperature

    def some(law: Any, which: slice | Any) -> vf.roughness.RoughFriction:
        arrays = {
            name: getattr(found, name)[..., which]
            for name in ("friction_coefficient", "friction_error", "contact_area_fraction", "corrected_area_fraction")
        }
        names = tuple(np.array(found.surfaces)[which])
        area = arrays["corrected_area_fraction"]
        return replace(found, surfaces=names, **arrays, **friction_on_area(law, speed, kelvin, found.pressure, area))

    def compared(
        law: vf.friction.InterfaceLaw, stress: Callable[..., Any], random: np.random.Generator
    ) -> tuple[Any, ...]:
        few = some(law, TRUE + random.choice(OTHERS, int(random.integers(3, 9)), replace=False))
        lower, upper = few.interval(of="total")
        area = found.corrected_area_fraction[0, :, :TRUE].mean(axis=-1)
        truth = found.friction_coefficient[0, :, :TRUE].mean(axis=-1) + stress(speed, kelvin) * area / found.pressure
        middle, total = 0.5 * (lower + upper)[0], few.total[0].mean(axis=-1)
        return middle, 0.5 * (upper - lower)[0], truth, few.interface_friction[0].mean(axis=-1) / total

    return compared


def draw(measured: Measured, compared: Compared, random: np.random.Generator) -> dict[str, Any] | None:
    """Return how far total friction of a fitted law is off, over its half-widths; None where no law is fitted."""
    true, kind = measured.true, KINDS[random.integers(len(KINDS))]
    kelvins, slip = true.temperatures, measured.slip * true.speed
    law = planted(kind, random, float(np.log10(slip).mean()), float(kelvins[len(kelvins) // 2]))
    # friction of the interface from 1/30 of that of the rubber to 30 times as much
    wanted = 10.0 ** random.uniform(-1.5, 1.5) * np.median(true.viscoelastic)
    scale = float(wanted / np.median(law(slip, true.temperature) / true.mean_pressure))

    def stress(speed: Any, kelvin: Any) -> Any:
        return scale * law(speed, kelvin)

    replicates, noise, level = int(random.integers(3, 10)), random.uniform(0.01, 0.05), random.choice([0.0, 0.02])
    shared = 1.0 + level * random.standard_normal(len(kelvins))[np.searchsorted(kelvins, true.temperature)]
    scatter = 1.0 + noise * random.standard_normal((replicates, len(true)))
    readings = stress(slip, true.temperature) / true.mean_pressure * shared * scatter
    deviation = readings.std(axis=0, ddof=1)
    curves = replace(
        true,
        coulomb=readings.mean(axis=0),
        coulomb_error=deviation / np.sqrt(replicates),
        coulomb_scatter=deviation,
        coulomb_freedom=np.full(len(true), replicates - 1.0),
        replicates=np.full(len(true), replicates),
        slip=slip,
    )
    try:
        fitted = vf.friction.shear_stress(curves, measured.solved, level_error=level).law(kind)
    except vf.InputError:
        return None
    total, half, truth, share = compared(fitted, stress, random)
    return {"share": share, "width": half / total, "ratio": (total - truth) / half}


def measure(shape: str, scenes: int, draws: int, seed: int, *, fitted: bool) -> dict[str, Any]:
    """Return the shares held over random scenes of one shape."""
    rows: list[dict[str, Any]] = []
    held = []
    for number in range(scenes):
        random = np.random.default_rng([seed, SHAPES.index(shape), number])
        place = scene(shape, random, fitted=fitted)
        found = [row for row in (draw(*place, random) for _ in range(draws)) if row is not None]
        rows += found
        held.append(np.mean([np.abs(row["ratio"]) < 1.0 for row in found]))
        if sys.stderr.isatty():
            print(f"\r{shape}: {number + 1} of {scenes}", end="", file=sys.stderr, flush=True)
    share, ratio, width = (np.concatenate([row[name] for row in rows]) for name in ("share", "ratio", "width"))
    inside = np.abs(ratio) < 1.0
    by_share = [share < 0.3, (share >= 0.3) & (share <= 0.7), share > 0.7]
    return {
        "shape": shape,
        "problems": len(rows),
        "refused": scenes * draws - len(rows),
        "held": float(np.mean(inside)),
        "error": float(np.std(held, ddof=1) / np.sqrt(scenes)) if scenes > 1 else None,
        "width": float(np.median(width)),
        **{
            part: float(np.mean(inside[where])) if where.any() else None
            for part, where in zip(PARTS, by_share, strict=True)
        },
    }


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=10, help="of each shape (default 10)")
    parser.add_argument("--draws", type=int, default=12, help="measurements in each scene (default 12)")
    parser.add_argument("--shapes", nargs="+", choices=SHAPES, default=SHAPES, help="of what is predicted")
    parser.add_argument("--material", choices=("known", "fitted"), default="known", help="(default known)")
    parser.add_argument("--seed", type=int, default=0, help="of the random problems (default 0)")
    parser.add_argument("--json", type=Path, help="file for the numbers")
    asked = parser.parse_args(arguments)
    began, rows = time.process_time(), []
    print(f"share of true total friction within its 95 % band, material {asked.material}")
    for shape in asked.shapes:
        fitted = asked.material == "fitted"
        rows.append(row := measure(shape, asked.scenes, asked.draws, asked.seed, fitted=fitted))
        parts = ", ".join(f"{part} {100 * row[part]:.1f} %" for part in PARTS if row[part] is not None)
        error = "" if row["error"] is None else f" ± {100 * row['error']:.1f}"
        print(
            f"{shape:>10}: {100 * row['held']:.1f}{error} % in {row['problems']} problems ({row['refused']} refused); "
            f"{parts}; half-width {100 * row['width']:.1f} %",
            flush=True,
        )
    print(f"{(time.process_time() - began) / (asked.scenes * len(asked.shapes)):.1f} s of CPU a scene")
    if asked.json:
        asked.json.write_text(json.dumps({"rows": rows}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
