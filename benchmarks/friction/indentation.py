"""Whether materials planted into indentation tests come back, and whether their 95 % bands hold them 95 times in 100.

Usage: python benchmarks/friction/indentation.py [--seeds N] [--first SEED] [--case NAME] [--json FILE]

Every seed is another problem: a material with a bell-shaped spectrum of random place, width and strength, its record
computed by the solvers over time (creep, relaxation and stiffness in closed form), and other noise.  The response of
every row is scattered by 0.5 %, rebounds as they say, stiffness by 1 and 3 %.  Cases named "…, shared" have a wrong
radius, load cell and zero of the depth besides, of the standard deviations that are given to the identification.
Counted are the moduli at nine frequencies of `frequency_range`, J(t) at nine times of it, and log10 α where it is
found.
"""

from __future__ import annotations

import argparse
import json
import os
import time as clock
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

import viscofric as vf

RADIUS, LOAD, DEPTH = 0.01, 2.0, 2e-4
PLANE_STRAIN = 0.75
NOISE = 0.005
KELVIN = 303.15
TIME = np.geomspace(0.01, 100.0, 60)
BALL = vf.Ball(RADIUS)
#: Standard deviations of errors in common.
SHARED = {"radius_error": 0.01, "load_error": 0.01, "zero_error": 1e-6}


class Test:
    """A random material, a random ball, load cell and zero, and the records that they give."""

    def __init__(self, seed: int, shared: bool) -> None:
        self.random = np.random.default_rng(seed)
        self.rubber = self._rubber()
        radius, gain, zero = self.random.standard_normal(3) * (list(SHARED.values()) if shared else [0.0] * 3)
        self.ball, self.gain, self.zero = vf.Ball(RADIUS * (1.0 + radius)), 1.0 + gain, zero
        self.kappa = 4.0 / 3.0 * np.sqrt(self.ball.radius)

    def _rubber(self) -> vf.Material:
        centre, width, ratio = self.random.uniform([-1.5, 1.2, 4.0], [1.0, 2.2, 20.0])
        tau = np.geomspace(1e-8, 1e8, 65)
        shape = np.exp(-0.5 * ((np.log10(tau) - centre) / width) ** 2)
        E0 = 2e6
        C = (1.0 - 1.0 / ratio) / E0 * shape / shape.sum()
        spectrum = vf.RetardationSpectrum(E0, E0 * ratio, C, tau)
        return vf.Material(spectrum, vf.WLF(C1=10.0, C2="120 K", reference=KELVIN))

    def record(self, time: Any, load: Any, depth: Any, control: str, kelvin: float = KELVIN, **more: Any) -> Any:
        """Return a record as it is measured: scattered, by a wrong load cell and from a wrong zero."""
        scatter = 1.0 + NOISE * self.random.standard_normal(len(time))
        load, depth = (load, depth * scatter) if control == "load" else (load * scatter, depth)
        touching = depth > 0.0
        depth = np.where(touching, depth - self.zero, depth)
        return vf.friction.IndentationRecord(time, load / self.gain, depth, kelvin, control=control, **more)

    def creep(self, kelvin: float = KELVIN) -> Any:
        """Return creep after a step of load."""
        J = self.rubber.at(kelvin).creep_compliance(TIME)
        depth = (PLANE_STRAIN * LOAD * J / self.kappa) ** (2.0 / 3.0)
        return self.record(TIME, np.full(len(TIME), LOAD), depth, "load", kelvin, start=0.0)

    def relaxation(self, kelvin: float = KELVIN) -> Any:
        """Return relaxation after a step of depth."""
        E = self.rubber.at(kelvin).relaxation_modulus(TIME)
        load = self.kappa / PLANE_STRAIN * E * DEPTH**1.5
        return self.record(TIME, load, np.full(len(TIME), DEPTH), "indentation", kelvin, start=0.0)

    def over_time(self, knots: Any, values: Any, rows: Any, control: str) -> Any:
        """Return a record solved over time."""
        history = vf.motion.History(knots, **{control: values}, temperature=KELVIN)
        run = vf.motion.solve_transient(self.rubber, self.ball, history, times=rows, accuracy=3e-4)
        given = np.interp(rows, knots, values)
        load, depth = (given, run.indentation) if control == "load" else (run.load, given)
        keep = (load > 0.0) | (control == "indentation")  # a given depth is part of the history where contact is lost
        return self.record(*(np.append(0.0, one[keep]) for one in (rows, load, depth)), control)

    def unloading(self) -> Any:
        """Return a ramp, a hold and an unloading under a given load."""
        rows = np.concatenate([np.linspace(0.02, 1.0, 25), 1.0 + np.geomspace(0.02, 10.0, 35)])
        rows = np.concatenate([rows, 11.0 + np.linspace(0.05, 0.95, 19)])
        return self.over_time([0.0, 1.0, 11.0, 12.0], [0.0, LOAD, LOAD, 0.0], rows, "load")

    def withdrawal(self) -> Any:
        """Return the same of a given depth."""
        rows = np.concatenate([np.linspace(0.02, 1.0, 25), 1.0 + np.geomspace(0.02, 10.0, 35)])
        rows = np.concatenate([rows, 11.0 + np.linspace(0.02, 0.6, 30)])
        return self.over_time([0.0, 1.0, 11.0, 12.0], [0.0, DEPTH, DEPTH, 0.0], rows, "indentation")

    def oscillation(self) -> Any:
        """Return oscillations of the depth, one after the other."""
        time, depth = [np.array([0.0, 0.1])], [np.array([0.0, DEPTH])]
        for hertz in (0.3, 3.0, 30.0):
            phase = 2.0 * np.pi * np.arange(1, 41) / 20
            time.append(time[-1][-1] + phase / (2.0 * np.pi * hertz))
            depth.append(DEPTH * (1.0 + 0.2 * np.sin(phase)))
        knots, values = np.concatenate(time), np.concatenate(depth)
        return self.over_time(knots, values, knots[1:], "indentation")

    def stiffness(self) -> Any:
        """Return the stiffness of small oscillations."""
        omega = 2.0 * np.pi * np.geomspace(0.1, 100.0, 13)
        depth = DEPTH + self.zero
        K = 2.0 * np.sqrt(self.ball.radius * depth) * self.rubber.complex_modulus(omega, KELVIN) / PLANE_STRAIN
        error = {"storage_stiffness": 0.01, "loss_stiffness": 0.03}
        storage, loss = (
            part / self.gain * (1.0 + size * self.random.standard_normal(13))
            for part, size in zip((K.real, K.imag), error.values(), strict=True)
        )
        return vf.friction.OscillationRecord(
            omega, storage, loss, KELVIN, indentation=DEPTH, amplitude=DEPTH / 50, error=error
        )

    def rebound(self, kelvin: float, *names: str) -> Any:
        """Return rebounds at one temperature."""
        speeds = np.array([0.3, 0.7, 1.6])
        hits = [vf.motion.solve_impact(self.rubber, self.ball, mass=0.033, speed=v, temperature=kelvin) for v in speeds]
        found = {
            "restitution": [one.restitution for one in hits], "contact_time": [one.contact_time for one in hits],
            "peak_force": [one.peak_force / self.gain for one in hits],
        }  # fmt: skip
        error = {"restitution": 0.005, "contact_time": 0.01, "peak_force": 0.02}
        scattered = {
            name: np.array(found[name]) * (1.0 + error[name] * self.random.standard_normal(3)) for name in names
        }
        return vf.friction.ReboundRecord(speeds, kelvin, mass=0.033, error={n: error[n] for n in names}, **scattered)

    def rebounds(self, *names: str) -> list[Any]:
        """Return rebounds at five temperatures."""
        return [self.rebound(kelvin, *names) for kelvin in KELVIN + np.array([-20.0, -10.0, 0.0, 10.0, 20.0])]


#: Case -> records of a test, whether α(T) is given, and whether there are errors in common.
CASES: dict[str, tuple[Callable[[Test], Sequence[Any]], bool, bool]] = {
    "creep": (lambda test: [test.creep()], False, False),
    "relaxation": (lambda test: [test.relaxation()], False, False),
    "both": (lambda test: [test.creep(), test.relaxation()], False, False),
    "temperatures": (lambda test: [test.creep(KELVIN + 10.0 * one) for one in range(-1, 3)], False, False),
    "unloading": (lambda test: [test.unloading()], False, False),
    "withdrawal": (lambda test: [test.withdrawal()], False, False),
    "oscillation": (lambda test: [test.oscillation()], False, False),
    "stiffness": (lambda test: [test.stiffness()], False, False),
    "rebound": (lambda test: test.rebounds("restitution", "contact_time"), True, False),
    "creep, shared": (lambda test: [test.creep()], False, True),
    "both, shared": (lambda test: [test.creep(), test.relaxation()], False, True),
    "unloading, shared": (lambda test: [test.unloading()], False, True),
    "withdrawal, shared": (lambda test: [test.withdrawal()], False, True),
    "stiffness, shared": (lambda test: [test.stiffness()], False, True),
    "rebound, shared": (lambda test: test.rebounds("restitution", "contact_time", "peak_force"), True, True),
}


def held(case: str, seed: int) -> dict[str, NDArray[Any]]:
    """Return which of the planted values lie within their 95 % limits, and by how much the moduli are off."""
    make, given, shared = CASES[case]
    test = Test(seed, shared)
    records, rubber = make(test), test.rubber
    begun = clock.process_time()
    found = vf.identify_from_indentation(
        records, BALL, samples=100, seed=seed, reference=KELVIN, shift=rubber.shift if given else None,
        **(SHARED if shared else {}),
    )  # fmt: skip
    spent = clock.process_time() - begun
    low, high = found.frequency_range
    omega = np.geomspace(low, high, 9)
    E = rubber.complex_modulus(omega, KELVIN)
    band = found.samples.modulus_band(omega)
    time = np.geomspace(1.0 / low, max(0.1 / high, 1e-3 / low), 9)
    J = found.samples.band(lambda one: one.at().creep_compliance(time))
    planted = rubber.at(KELVIN).creep_compliance(time)
    result = {
        "E'": (band.lower.real < E.real) & (E.real < band.upper.real),
        "E''": (band.lower.imag < E.imag) & (E.imag < band.upper.imag),
        "J": (J.lower < planted) & (planted < J.upper),
        "off": np.abs(found.material.complex_modulus(omega) / E - 1.0),
        "off E''": np.abs(found.material.complex_modulus(omega).imag / E.imag - 1.0),
        "seconds": np.array([spent]),
    }
    if found.shift_found:
        law = found.shift_factors
        known = law.standard_errors > 1e-6
        wrong = law.log10_values - rubber.shift.at_reference(KELVIN).log10(law.temperatures)
        result["α"] = (np.abs(wrong) < 1.96 * law.standard_errors)[known]
    return result


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=40, help="problems of each case")
    parser.add_argument("--first", type=int, default=0, help="seed of the first of them")
    parser.add_argument("--case", choices=CASES, help="only this one")
    parser.add_argument("--json", type=Path, help="file for the numbers")
    chosen = parser.parse_args(arguments)
    table = {}
    heads = ("E′ held", "E″ held", "J held", "α held", "|E| off", "E″ off", "CPU s")
    print(f"{'case':20s} {' '.join(f'{one:>8s}' for one in heads)}")
    for name in CASES:
        if chosen.case not in (None, name):
            continue
        rows = [held(name, seed) for seed in range(chosen.first, chosen.first + chosen.seeds)]
        share = {key: float(np.mean([row[key] for row in rows])) for key in ("E'", "E''", "J")}
        found = [np.mean(row["α"]) for row in rows if "α" in row]
        share["α"] = float(np.mean(found)) if found else float("nan")
        off = [float(np.sqrt(np.mean(np.square([row[key] for row in rows])))) for key in ("off", "off E''")]
        seconds = float(np.mean([row["seconds"] for row in rows]))
        shown = " ".join(f"{one:8.1%}" if one == one else f"{'':8s}" for one in [*share.values(), *off])
        print(f"{name:20s} {shown} {seconds:8.2f}", flush=True)
        table[name] = {
            **{key: one for key, one in share.items() if one == one}, "rms |E|": off[0], "rms E''": off[1],
            "by frequency": {key: np.mean([row[key] for row in rows], axis=0).tolist() for key in ("E'", "E''", "J")},
        }  # fmt: skip
    if chosen.json:
        chosen.json.write_text(json.dumps(table, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
