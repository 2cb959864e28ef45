"""Curves of many speeds, interpolated between few contacts: their cost, and whether their stated errors hold.

Usage: python benchmarks/friction/many_speeds.py [--curves 300] [--first 0] [--checks 3] [--cost]

1 to 20 modes at random over six decades, E_inf/E0 from 2 to 1e3; a ball, a cylinder, a cone, an ellipsoid, a profile or
a cylinder on a layer; 30 to 100 speeds over a third of a decade to three decades; accuracies from 1e-3 to 1e-2.  Some
speeds of each curve are solved again by themselves, to a fifth of the accuracy.  An error holds where the difference is
no more than it and the error that the finer contact states.  `--cost` times a thousand speeds beside sixty, over twelve
decades of 40 modes.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import time
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "contact"))
import measuring
import numpy as np
from problems import CURVE_BALL, CURVE_LOAD, CURVE_RUBBER, curve_speeds

import viscofric as vf

COLUMNS = (
    ("values", "values", "d"),
    ("within", "within", ".4f"),
    ("true/stated, median", "median", ".3f"),
    ("99 % below", "most", ".2f"),
    ("largest", "largest", ".2f"),
)
KINDS = ("ball", "cylinder", "cone", "ellipsoid", "profile", "cylinder on a layer")
RADIUS, REFERENCE = 10e-3, 300.0


def draw(number: int) -> tuple[str, vf.Material, dict[str, Any]]:
    """Return a random material and curve."""
    rng, kind = np.random.default_rng([24, number]), KINDS[number % len(KINDS)]
    ratio, count = 10.0 ** rng.uniform(0.3, 3.0), round(20.0 ** rng.uniform())
    tau = 10.0 ** -np.sort(rng.uniform(0.0, 6.0, count))
    share = tau ** rng.uniform(-0.2, 0.4) * rng.exponential(size=count) + 1e-3
    spectrum = vf.RetardationSpectrum(1e6, 1e6 * ratio, (1.0 - 1.0 / ratio) / 1e6 * share / share.sum(), tau)
    material = vf.Material(spectrum, shift=vf.Arrhenius("40 kJ/mol", reference=REFERENCE))
    x = np.linspace(-3e-3, 3e-3, 241)
    indenter: Any = {
        "ball": vf.Ball(RADIUS),
        "cone": vf.Cone("8 deg"),
        "ellipsoid": vf.Ellipsoid(RADIUS, RADIUS * rng.uniform(0.5, 2.0)),
        "profile": vf.Profile(x**2 / (2.0 * RADIUS) + 2e-6 * np.cos(3e3 * x), spacing=float(x[1] - x[0])),
    }.get(kind, vf.Cylinder(RADIUS))
    slowest, decades = 10.0 ** rng.uniform(-5.0, 1.0), rng.uniform(0.33, 3.0)
    asked = {
        "indenter": indenter,
        "load": 20.0 if "cylinder" in kind or kind == "profile" else 0.1,
        "speeds": slowest * np.geomspace(1.0, 10.0**decades, round(rng.uniform(30.0, 100.0))),
        "temperatures": REFERENCE + rng.uniform(-20.0, 20.0),
        "accuracy": float(np.exp(rng.uniform(math.log(1e-3), math.log(1e-2)))),
    }
    if "layer" in kind:
        asked["layer"] = vf.Layer(thickness=5e-4 * 10.0 ** rng.uniform(0.0, 0.7))
    return kind, material, asked


def compare(number: int, checks: int) -> dict[str, Any]:
    """Return true and stated errors of some speeds of a curve."""
    kind, material, asked = draw(number)
    tried = {"kind": kind, "apart": [], "stated": [], "left": []}
    begun = time.process_time()
    try:
        curve = vf.predict_friction(material, **asked)
        rows = np.sort(np.random.default_rng(number).choice(len(curve), checks, replace=False))
        finer = asked | {"speeds": asked["speeds"][rows], "accuracy": 0.2 * asked["accuracy"]}
        true = vf.predict_friction(material, **finer, exact=True)
    except vf.ViscofricError as error:
        return {**tried, "unsolved": f"{number}, {kind}: {error}"}
    return {
        **tried,
        "seconds": time.process_time() - begun,
        "apart": np.abs(curve.viscoelastic[rows] - true.viscoelastic).tolist(),
        "stated": curve.viscoelastic_error[rows].tolist(),
        "left": true.viscoelastic_error.tolist(),
    }


def summary(name: str, found: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the share of errors that hold."""
    apart, stated, left = (np.concatenate([one[key] for one in found]) for key in ("apart", "stated", "left"))
    ratio = np.maximum(0.0, apart - left) / np.maximum(stated, 1e-300)
    return {
        "case": name,
        "values": len(apart),
        "within": float(np.mean(apart <= stated + left)),
        "median": float(np.median(apart / np.maximum(stated, 1e-300))),
        "most": float(np.quantile(ratio, 0.99)),
        "largest": float(ratio.max()),
    }


def cost() -> None:
    """Print the CPU time of a thousand speeds beside sixty, each solved by itself."""
    asked: dict[str, Any] = {"load": CURVE_LOAD, "temperatures": CURVE_RUBBER.shift.reference, "accuracy": 1e-3}
    seconds = {}
    for count, exact in ((60, True), (1000, False), (60, True), (1000, False)):
        begun = time.process_time()
        vf.predict_friction(CURVE_RUBBER, CURVE_BALL, speeds=curve_speeds(1e-2, 12.0, count), exact=exact, **asked)
        seconds.setdefault(count, []).append(time.process_time() - begun)
    ratios = ", ".join(f"{many / few:.2f}" for few, many in zip(seconds[60], seconds[1000], strict=True))
    print(f"1,000 speeds took {ratios} times the CPU time of 60, each solved by itself")


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--curves", type=int, default=300)
    parser.add_argument("--first", type=int, default=0, help="number of the first random curve")
    parser.add_argument("--checks", type=int, default=3, help="speeds of each curve that are solved again")
    parser.add_argument("--cost", action="store_true", help="time a thousand speeds beside sixty, nothing else")
    options = parser.parse_args(arguments)
    if options.cost:
        cost()
        return
    found = []
    for number in range(options.first, options.first + options.curves):
        found.append(compare(number, options.checks))
        one = found[-1]
        for apart, stated, left in zip(one["apart"], one["stated"], one["left"], strict=True):
            if apart > stated + left:
                print(
                    f"{number}, {one['kind']}: off by {(apart - left) / stated:.2f} times the stated error", flush=True
                )
    solved = [one for one in found if "unsolved" not in one]
    rows = [summary(kind, those) for kind in KINDS if (those := [one for one in solved if one["kind"] == kind])]
    measuring.print_table("interpolated friction", [*rows, summary("all", solved)], COLUMNS)
    for one in found:
        if "unsolved" in one:
            print(one["unsolved"])


if __name__ == "__main__":
    main()
