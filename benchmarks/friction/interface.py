"""Whether the 95 % bands of fitted laws of shear stress hold planted ones, over random measurements of an interface.

    python benchmarks/friction/interface.py --problems 1000 --json interface.json

Every problem is SYNTHETIC: a law, its constants, slip speeds, temperatures, replicates, noise, an error that all points
of a temperature share, and contact pressures are drawn anew; Coulomb friction is measured with that noise, in half of
the problems a part of it, else of its median at all points, as that of a force cell.  The law is fitted by its kind,
and chosen by comparison.  Bands are looked up at the measured points, and half a decade beyond
them.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from typing import Any

import numpy as np

import viscofric as vf

KINDS = ("constant", "power", "eyring", "gaussian")


def planted(kind: str, random: np.random.Generator, middle: float, reference: float) -> vf.friction.InterfaceLaw:
    """Return a law whose features lie about a reduced speed (log10 of m/s)."""
    shift = vf.Arrhenius(random.uniform(40e3, 120e3), reference)
    stress = 10.0 ** random.uniform(4.5, 6.5)
    if kind == "constant":
        return vf.friction.ConstantShearStress(stress)
    if kind == "power":
        return vf.friction.PowerShearStress(stress, random.uniform(0.05, 0.4), 10.0**middle, shift=shift)
    if kind == "eyring":
        speed = 10.0 ** (middle - random.uniform(0.0, 2.0))
        return vf.friction.EyringShearStress(4e-21 / stress, speed, shift=shift)
    speed = 10.0 ** (middle + random.uniform(-1.0, 1.0))
    return vf.friction.GaussianShearStress(stress, speed, random.uniform(0.8, 2.5), shift=shift)


def problem(kind: str, random: np.random.Generator) -> tuple[vf.friction.InterfaceLaw, vf.friction.ShearStress]:
    """Return a planted law, and the shear stress of one measurement of it."""
    kelvin = 293.15 + np.linspace(0.0, random.uniform(30.0, 80.0), random.integers(3, 7))
    low = random.uniform(-4.0, -2.0)
    speed = np.logspace(low, low + random.uniform(1.0, 2.5), random.integers(6, 12))
    law = planted(kind, random, float(np.log10(speed).mean()), float(kelvin[len(kelvin) // 2]))
    v, T = np.tile(speed, kelvin.size), np.repeat(kelvin, speed.size)
    n, replicates = v.size, int(random.integers(3, 10))
    noise, level = random.uniform(0.01, 0.05), random.choice([0.0, 0.02])
    pressure = 10.0 ** random.uniform(5.0, 6.0) * (v / v[0]) ** 0.05
    shared = 1.0 + level * np.repeat(random.standard_normal(kelvin.size), speed.size)
    friction = law(v, T) / pressure
    # Of friction itself, or of a force cell: the same at all points.
    unit = friction if random.random() < 0.5 else np.full(n, np.median(friction))
    readings = friction * shared + noise * unit * random.standard_normal((replicates, n))
    columns = {"speed": v, "temperature": T, "load": np.full(n, 5.0), "replicates": np.full(n, replicates)}
    columns |= {f"viscoelastic{name}": np.full(n, 0.01) for name in ("", "_error", "_scatter")}
    scatter = readings.std(axis=0, ddof=1)
    measured = vf.FrictionCurves(
        **columns,
        coulomb=readings.mean(axis=0),
        coulomb_error=scatter / np.sqrt(replicates),
        coulomb_scatter=scatter,
        coulomb_freedom=np.full(n, replicates - 1.0),
        slip=v,
    )
    contacts = vf.FrictionCurves(**columns, mean_pressure=pressure, mean_pressure_error=np.zeros(n))
    return law, vf.friction.shear_stress(measured, contacts, level_error=level)


def held(law: vf.friction.InterfaceLaw, found: vf.friction.InterfaceLaw, speed: Any, kelvin: Any) -> float:
    """Return the share of places whose band holds the planted stress."""
    lower, upper = found.interval(speed, kelvin)
    true = law(speed, kelvin)
    return float(np.mean((lower <= true) & (true <= upper)))


def measure(kind: str, count: int, seed: int) -> dict[str, Any]:
    """Return the shares held over a number of problems of one kind of law."""
    at_points, beyond, chosen, right, refused, energies = [], [], [], 0, 0, []
    for number in range(count):
        law, stress = problem(kind, np.random.default_rng([seed, KINDS.index(kind), number]))
        try:
            found = stress.law(kind)
        except vf.InputError:
            refused += 1
            continue
        away = np.concatenate([stress.speed * 10.0**-0.5, stress.speed * 10.0**0.5])
        at_points.append(held(law, found, stress.speed, stress.temperature))
        beyond.append(held(law, found, away, np.tile(stress.temperature, 2)))
        best = stress.compare_laws()
        right += best.chosen.kind == kind
        chosen.append(held(law, best.best, stress.speed, stress.temperature))
        if found.shift is not None:
            error = float(found.shift.standard_errors[0])
            away_by = found.shift.activation_energy - law.shift.activation_energy
            energies.append(abs(away_by) < 1.96 * error)
    return {
        "kind": kind,
        "problems": count,
        "refused": refused,
        "points": float(np.mean(at_points)),
        "beyond": float(np.mean(beyond)),
        "energy": float(np.mean(energies)) if energies else None,
        "chosen": float(np.mean(chosen)),
        "right": right / len(chosen),
    }


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problems", type=int, default=200, help="of each kind of law (default 200)")
    parser.add_argument("--seed", type=int, default=0, help="of the random problems (default 0)")
    parser.add_argument("--json", type=Path, help="file for the numbers")
    asked = parser.parse_args(arguments)
    began = time.process_time()
    rows = [measure(kind, asked.problems, asked.seed) for kind in KINDS]
    print("share of planted stress within 95 % bands; at the points, half a decade beyond, of the chosen law; Ea")
    for row in rows:
        energy = "" if row["energy"] is None else f"{100 * row['energy']:.1f} %"
        print(
            f"{row['kind']:>10}: {100 * row['points']:.1f} %, {100 * row['beyond']:.1f} %, "
            f"{100 * row['chosen']:.1f} %; Ea {energy or '-'}; "
            f"right law chosen in {100 * row['right']:.0f} %, {row['refused']} refused"
        )
    cost = (time.process_time() - began) / (asked.problems * len(KINDS))
    print(f"{1e3 * cost:.0f} ms of CPU a problem")
    if asked.json:
        asked.json.write_text(json.dumps({"rows": rows}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
