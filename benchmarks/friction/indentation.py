"""Whether materials planted into indentation tests come back, and whether their 95 % bands hold them 95 times in 100.

Usage: python benchmarks/friction/indentation.py [--seeds N] [--first SEED] [--case NAME] [--json FILE]

Noise-free records are computed once: steps from the creep compliance and the relaxation modulus in closed form, ramps
by `solve_transient`.  The response of every row is then scattered by 0.5 %.  Counted are the moduli at nine frequencies
of `frequency_range`, J(t) at nine times of it, and log10 α where it is found.
"""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np

import viscofric as vf

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

BALL = vf.Ball("10 mm")
KAPPA = 4.0 / 3.0 * np.sqrt(0.01)  # X = κ δ^{3/2}
PLANE_STRAIN = 0.75
NOISE = 0.005
TIME = np.geomspace(0.01, 100.0, 60)
KELVIN = 303.15


def gaussian() -> vf.Material:
    """Return a planted material with a wide, bell-shaped spectrum."""
    tau = np.geomspace(1e-6, 1e6, 49)
    shape = np.exp(-0.5 * (np.log10(tau) / 1.5) ** 2)
    C = 0.8 / 2e6 * shape / shape.sum()
    spectrum = vf.RetardationSpectrum(2e6, 1.0 / (0.5e-6 - float(C.sum())), C, tau)
    return vf.Material(spectrum, vf.WLF(C1=10.0, C2="120 K", reference=KELVIN))


def creep(rubber: vf.Material, kelvin: float) -> vf.IndentationRecord:
    """Return the depth after a step of load."""
    J = rubber.at(kelvin).creep_compliance(TIME)
    return vf.IndentationRecord(
        TIME, np.full(60, 2.0), (PLANE_STRAIN * 2.0 * J / KAPPA) ** (2.0 / 3.0), kelvin, control="load", start=0.0
    )


def relaxation(rubber: vf.Material, kelvin: float) -> vf.IndentationRecord:
    """Return the load after a step of depth."""
    E = rubber.at(kelvin).relaxation_modulus(TIME)
    depth = np.full(60, 1e-4)
    return vf.IndentationRecord(
        TIME, KAPPA / PLANE_STRAIN * E * depth**1.5, depth, kelvin, control="indentation", start=0.0
    )


def ramp(rubber: vf.Material, kelvin: float) -> vf.IndentationRecord:
    """Return the depth under a load that rises in a second, is held, and falls."""
    time = np.concatenate([np.linspace(0.02, 1.0, 25), 1.0 + np.geomspace(0.02, 100.0, 45), [101.5, 101.9]])
    load = np.interp(time, [0.0, 1.0, 101.0, 102.0], [0.0, 2.0, 2.0, 0.0])
    history = vf.History([0.0, 1.0, 101.0, 102.0], load=[0.0, 2.0, 2.0, 0.0], temperature=kelvin)
    run = vf.solve_transient(rubber, BALL, history, times=time, accuracy=1e-4)
    rows = [np.append(0.0, one) for one in (time, load, run.indentation)]
    return vf.IndentationRecord(*rows, kelvin, control="load")


def scattered(record: vf.IndentationRecord, random: np.random.Generator) -> vf.IndentationRecord:
    """Return a record whose response has noise."""
    factor = 1.0 + NOISE * random.standard_normal(len(record))
    load, depth = record.load, record.indentation
    load, depth = (load, depth * factor) if record.control == "load" else (load * factor, depth)
    return vf.IndentationRecord(
        record.time, load, depth, record.temperature, control=record.control, start=record.start
    )


def cases() -> dict[str, tuple[vf.Material, Callable[[], Sequence[vf.IndentationRecord]]]]:
    """Return the planted material and the noise-free records of every case."""
    rubber, bell = vf.synthetic_fluoroelastomer(), gaussian()
    kelvin = (293.15, 303.15, 313.15, 323.15)
    return {
        "creep": (rubber, lambda: [creep(rubber, KELVIN)]),
        "relaxation": (rubber, lambda: [relaxation(rubber, KELVIN)]),
        "ramp": (rubber, lambda: [ramp(rubber, KELVIN)]),
        "bell": (bell, lambda: [creep(bell, KELVIN), relaxation(bell, KELVIN)]),
        "temperatures": (bell, lambda: [creep(bell, one) for one in kelvin]),
    }


def held(rubber: vf.Material, exact: Sequence[vf.IndentationRecord], seed: int) -> dict[str, np.ndarray]:
    """Return which of the planted values lie within their 95 % limits, and by how much the moduli are off."""
    random = np.random.default_rng(seed)
    found = vf.identify_from_indentation(
        [scattered(one, random) for one in exact], BALL, samples=100, seed=seed, reference=KELVIN
    )
    low, high = found.frequency_range
    omega = np.geomspace(low, high, 9)
    E = rubber.complex_modulus(omega, KELVIN)
    band = found.samples.modulus_band(omega)
    time = np.geomspace(1.0 / low, 0.1 / high, 9)
    J = found.samples.band(lambda one: one.at().creep_compliance(time))
    planted = rubber.at(KELVIN).creep_compliance(time)
    result = {
        "E'": (band.lower.real < E.real) & (E.real < band.upper.real),
        "E''": (band.lower.imag < E.imag) & (E.imag < band.upper.imag),
        "J": (J.lower < planted) & (planted < J.upper),
        "off": np.abs(found.material.complex_modulus(omega) / E - 1.0),
        "off E''": np.abs(found.material.complex_modulus(omega).imag / E.imag - 1.0),
    }
    if found.shift_found:
        law = found.shift_factors
        known = law.standard_errors > 1e-6
        wrong = law.log10_values - rubber.shift.at_reference(KELVIN).log10(law.temperatures)
        result["α"] = (np.abs(wrong) < 1.96 * law.standard_errors)[known]
    return result


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20, help="scattered measurements of each case")
    parser.add_argument("--first", type=int, default=0, help="seed of the first of them")
    parser.add_argument("--case", choices=cases(), help="only this one")
    parser.add_argument("--json", type=Path, help="file for the numbers")
    chosen = parser.parse_args(arguments)
    table = {}
    print(f"{'case':14s} {'E′ held':>8s} {'E″ held':>8s} {'J held':>8s} {'α held':>8s} {'|E| off':>8s} {'E″ off':>8s}")
    for name, (rubber, records) in cases().items():
        if chosen.case not in (None, name):
            continue
        exact = records()
        rows = [held(rubber, exact, seed) for seed in range(chosen.first, chosen.first + chosen.seeds)]
        share = {key: float(np.mean([row[key] for row in rows])) for key in ("E'", "E''", "J")}
        share["α"] = float(np.mean([row["α"] for row in rows])) if "α" in rows[0] else float("nan")
        off = [float(np.sqrt(np.mean(np.square([row[key] for row in rows])))) for key in ("off", "off E''")]
        shown = " ".join(f"{one:8.1%}" if one == one else f"{'':8s}" for one in [*share.values(), *off])
        print(f"{name:14s} {shown}", flush=True)
        table[name] = {
            **{key: one for key, one in share.items() if one == one}, "rms |E|": off[0], "rms E''": off[1],
            "by frequency": {key: np.mean([row[key] for row in rows], axis=0).tolist() for key in ("E'", "E''", "J")},
        }  # fmt: skip
    if chosen.json:
        chosen.json.write_text(json.dumps(table, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
