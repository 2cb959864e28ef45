"""Identification of planted rubbers from their friction: how near, how honest, how fast.

Usage: python benchmarks/friction/identify.py [--seeds N] [--first SEED] [--material NAME] [--json FILE]
       python benchmarks/friction/identify.py --few {replicates,errors} [--spectrum {smooth,ending,modes}]
                                              [--shared {none,undeclared,declared} …] [--first-order]
                                              [--samples N] [--rubbers N] [--seeds N] [--first SEED] [--json FILE]

Nine temperatures from 30 to 90 °C, ten speeds from 20 to 200 mm/s, a ball of 9.525 mm under 25 N; friction is solved
to 1e-4 with retardation times that the fit does not hold.  α(T) is found too; one modulus, |E| at 1 rad/s and 30 °C, is
given to 0.1 %.  First without noise, then with 5 % of scatter in each of eight replicates: which part of the planted
values lies within the 95 % intervals, and which measurements are refused.  CPU seconds are those of this process, which
does all the work.

With --few, 13 rubbers are drawn and measured at four temperatures and nine speeds only, as means of four replicates of
3 %, whose number is given (replicates) or not (errors: a table of friction and its standard errors; the scatter is the
same).  Their spectra are smooth; or what the prior does not expect: they end at 100 s, among the contact's
frequencies (ending), or have one mode per decade (modes).  The row ± has the standard error of the mean over the
measurements: what is found at the frequencies of one measurement errs together.  "lowest" is the share of E'' at the
lowest of the contact's frequencies, "in μ" that of friction at the speeds and temperatures measured, under a fifth,
once and four times the load, to first order in the loss, and "± E'' %" half the median width of the intervals of E''.

With --shared, friction also has errors that points share: of all points (5 %), per decade of speed (3 %) and of each
temperature (2 %), drawn anew for each measurement; they are given to the identification (declared) or not.  With
--first-order, planted friction and fit are those of the closed form to first order in the loss: no contact is solved,
which tests the statistics alone in a tenth of the time.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
import numpy as np

import viscofric as vf
from viscofric.errors import ViscofricError
from viscofric.friction.identification.forward import FirstOrder
from viscofric.friction.identification.solving import Contacts

BALL = vf.Ball(radius="9.525 mm")
KELVIN = np.array([30.0, 35.0, 40.0, 46.0, 52.0, 60.0, 68.0, 78.0, 90.0]) + 273.15
SPEEDS = np.geomspace(0.02, 0.2, 10)
SCATTER, REPLICATES = 0.05, 8
FREQUENCY = 1.0  # rad/s
HEADINGS = (
    "CPU s",
    "steps",
    "decades",
    "|E| %",
    "E'' %",
    "α dec",
    "χ²/ν",
    "in |E|",
    "in E'",
    "in E''",
    "in α",
    "in μ",
    "lowest",
    "± E'' %",
)


#: Temperatures, speeds, scatter and replicates of few measurements.
FEW_KELVIN, FEW_SPEEDS = np.array([30.0, 40.0, 52.0, 66.0]) + 273.15, np.geomspace(0.01, 0.5, 9)
FEW_SCATTER, FEW_REPLICATES = 0.03, 4
#: Loads of the measurement, and of friction predicted with the material found, N.
LOAD, LOADS = 25.0, (5.0, 25.0, 100.0)
#: Decades between the modes of drawn rubbers, and where they end, log10 s.
SPECTRA = {"smooth": (0.37, 5.0), "ending": (0.37, 2.0), "modes": (1.0, 5.0)}


VARIANTS = ("none", "undeclared", "declared")
#: Standard errors that points share, as arguments of `identify_material`.
SHARED = {"common_error": 0.05, "drift_error": 0.03, "level_error": 0.02}


def with_shared_errors(curves: vf.FrictionCurves, seed: int) -> vf.FrictionCurves:
    """Return friction with errors that points share."""
    random = np.random.default_rng([seed, 1])
    decades = np.log10(curves.speed)
    kelvins, number = np.unique(curves.temperature, return_inverse=True)
    logarithm = SHARED["common_error"] * random.standard_normal()
    logarithm += SHARED["drift_error"] * random.standard_normal() * (decades - decades.mean())
    logarithm += SHARED["level_error"] * random.standard_normal(len(kelvins))[number]
    names = ("viscoelastic", "viscoelastic_error", "viscoelastic_scatter")
    return replace(curves, **{name: getattr(curves, name) * np.exp(logarithm) for name in names})


def drawn_rubber(number: int, kind: str = "smooth") -> vf.Material:
    """Return a SYNTHETIC rubber, or polymer amidst its transition: a skew bell of compliances, anyhow wide and high."""
    step, end = SPECTRA[kind]
    random = np.random.default_rng(1000 + number)
    E0, ratio = 10.0 ** random.uniform(6.0, 6.8), 10.0 ** random.uniform(0.3, 2.5)
    tau = 10.0 ** np.arange(-9.0, end, step)
    away = np.log10(tau) - random.uniform(-6.0, -2.5)
    fast, slow = random.uniform(0.8, 2.5, 2)
    share = np.exp(-0.5 * (away / np.where(away > 0.0, slow, fast)) ** 2)
    C = share / share.sum() * (1.0 - 1.0 / ratio) / E0
    law = vf.WLF(C1=random.uniform(5.0, 12.0), C2=random.uniform(80.0, 180.0), reference="30 degC")
    return vf.Material(vf.RetardationSpectrum(E0, E0 * ratio, C, tau), law)


def lossy_polymer() -> vf.Material:
    """Return a SYNTHETIC polymer with its transition among the contacts' frequencies: friction has a maximum."""
    tau = 3e-7 * 2.2 ** np.arange(28)
    away = np.log10(tau) + 0.3
    share = np.exp(-0.5 * (away / np.where(away > 0.0, 0.55, 1.5)) ** 2)
    spectrum = vf.RetardationSpectrum(4e6, 6e8, share / share.sum() * (1 / 4e6 - 1 / 6e8), tau)
    return vf.Material(spectrum, vf.WLF(C1=7.5, C2=95.0, reference="30 degC"))


MATERIALS = {"fluoroelastomer": vf.synthetic_fluoroelastomer, "lossy polymer": lossy_polymer}


def measured(
    exact: vf.FrictionCurves,
    seed: int | None,
    scattering: float = SCATTER,
    replicates: int = REPLICATES,
    *,
    told: bool = True,
) -> vf.FrictionCurves:
    """Return the exact friction, or means of replicates that scatter about it, whose number is told or not."""
    if seed is None:
        return exact
    random = np.random.default_rng(seed)
    values = exact.viscoelastic * (1.0 + scattering * random.standard_normal((replicates, len(exact))))
    scatter = values.std(axis=0, ddof=1)
    error = scatter / np.sqrt(replicates)
    return vf.FrictionCurves(
        exact.speed,
        exact.temperature,
        exact.load,
        values.mean(axis=0),
        error,
        scatter if told else error,
        np.full(len(exact), replicates if told else 1),
    )


def identified(material: vf.Material, curves: vf.FrictionCurves, **settings: Any) -> dict[str, Any]:
    """Identify, and compare with what was planted."""
    modulus = float(abs(material.complex_modulus(FREQUENCY, KELVIN[0])))
    anchor = vf.friction.ModulusAnchor(modulus, FREQUENCY, KELVIN[0], error=1e-3)
    begin = time.process_time()
    found = vf.identify_material(curves, indenter=BALL, anchor=anchor, reference=KELVIN[0], **settings)
    seconds = time.process_time() - begin
    low, high = found.frequency_range
    omega = np.geomspace(low, high, 25)
    planted, E = material.complex_modulus(omega, KELVIN[0]), found.material.complex_modulus(omega)
    band = found.samples.modulus_band(omega)
    magnitude = found.samples.band(lambda one: np.abs(one.complex_modulus(omega)))
    factors = found.shift_factors
    away = factors.log10_values - material.shift.log10(factors.temperatures)
    measured_ones = factors.standard_errors > 1e-6
    return {
        "seconds": seconds,
        "steps": found.iterations,
        "decades": float(np.log10(high / low)),
        "modulus": float(np.abs(np.log(np.abs(E / planted))).max()),
        "loss": float(np.abs(np.log(E.imag / planted.imag)).max()),
        "alpha": float(np.abs(away).max()),
        "chi2": found.chi2 / found.freedom,
        "in |E|": float(np.mean((magnitude.lower <= np.abs(planted)) & (np.abs(planted) <= magnitude.upper))),
        "in E'": float(np.mean((band.lower.real <= planted.real) & (planted.real <= band.upper.real))),
        "in E''": float(np.mean((band.lower.imag <= planted.imag) & (planted.imag <= band.upper.imag))),
        "in α": float(np.mean(np.abs(away) <= 1.96 * factors.standard_errors, where=measured_ones)),
        "in μ": friction_held(material, found.samples),
        "lowest": float(band.lower.imag[0] <= planted.imag[0] <= band.upper.imag[0]),
        "width": float(np.median(0.5 * np.log(band.upper.imag / band.lower.imag))),
    }


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=10, help="scattered measurements of each material")
    parser.add_argument("--first", type=int, default=0, help="seed of the first of them")
    parser.add_argument("--material", choices=MATERIALS, help="only this one")
    parser.add_argument("--few", choices=("replicates", "errors"), help="drawn rubbers, few replicates")
    parser.add_argument("--spectrum", choices=SPECTRA, default="smooth", help="of the drawn rubbers")
    parser.add_argument("--shared", choices=VARIANTS, nargs="+", default=["none"], help="errors that points share")
    parser.add_argument("--first-order", action="store_true", help="solve no contacts")
    parser.add_argument("--samples", type=int, default=200, help="materials drawn for the intervals")
    parser.add_argument("--rubbers", type=int, default=13, help="how many are drawn")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    results = few(options) if options.few else many(options)
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(results, indent=1, ensure_ascii=False), encoding="utf-8")


def solved(rubber: vf.Material) -> vf.FrictionCurves:
    """Return the friction of a drawn rubber."""
    return vf.predict_friction(rubber, BALL, speeds=FEW_SPEEDS, temperatures=FEW_KELVIN, load="25 N", accuracy=1e-3)


def of_first_order(rubber: vf.Material) -> vf.FrictionCurves:
    """Return the friction of a drawn rubber to first order in the loss."""
    kelvin, speed = (column.ravel() for column in np.meshgrid(FEW_KELVIN, FEW_SPEEDS, indexing="ij"))
    first = FirstOrder(BALL, LOAD, 0.75, rubber.modes_at().tau)
    none, ones = np.zeros(speed.size), np.ones(speed.size, int)
    return vf.FrictionCurves(speed, kelvin, LOAD * ones, first_order(rubber, first, kelvin, speed), none, none, ones)


def first_order(rubber: vf.Material, first: FirstOrder, kelvin: Any, speed: Any) -> Any:
    """Return the friction of a rubber to first order in the loss."""
    spectrum = rubber.modes_at()
    reduced = np.log(speed * rubber.shift(kelvin))
    return np.exp(first.at_times(spectrum.tau)(np.log([1.0 / spectrum.E_inf, *spectrum.C]), reduced).log_friction)


def friction_held(material: vf.Material, samples: Any) -> float:
    """Return the share of friction at several loads that the 95 % limits of the samples hold."""
    kelvin, speed = (column.ravel() for column in np.meshgrid(FEW_KELVIN, FEW_SPEEDS, indexing="ij"))
    held = []
    for load in LOADS:
        first = FirstOrder(BALL, load, 0.75, material.modes_at().tau)
        drawn = [first_order(one, first, kelvin, speed) for one in samples.materials]
        low, high = np.quantile(drawn, [0.025, 0.975], axis=0, method="weibull")
        planted = first_order(material, first, kelvin, speed)
        held.append(np.mean((low <= planted) & (planted <= high)))
    return float(np.mean(held))


def few(options: argparse.Namespace) -> dict[str, Any]:
    """Identify drawn rubbers from few replicates."""
    results: dict[str, Any] = {name: {"scattered": [], "refused": {}} for name in options.shared}
    if options.first_order:
        Contacts.solved = lambda contacts, problem, *given: problem  # type: ignore[method-assign]
    print(f"{'':12}" + "".join(f"{heading:>9}" for heading in HEADINGS))
    for number in range(options.rubbers):
        rubber = drawn_rubber(number, options.spectrum)
        exact = of_first_order(rubber) if options.first_order else solved(rubber)
        for seed in range(options.first, options.first + options.seeds):
            told = options.few == "replicates"
            alone = measured(exact, 1000 * number + seed, FEW_SCATTER, FEW_REPLICATES, told=told)
            together = with_shared_errors(alone, 1000 * number + seed)
            for variant, result in results.items():
                name = f"{number}, {seed} {variant[:1]}"
                curves, given = alone if variant == "none" else together, dict(SHARED) if variant == "declared" else {}
                try:
                    result["scattered"].append(identified(rubber, curves, samples=options.samples, **given))
                except ViscofricError as error:
                    result["refused"][name] = str(error)
                    print(f"{name}: {error}", flush=True)
                else:
                    show(name, result["scattered"][-1])
    for variant, result in results.items():
        rows = result["scattered"]
        mean = result["mean"] = {key: float(np.mean([row[key] for row in rows])) for key in rows[0]} if rows else {}
        if len(rows) > 1:
            show(f"mean {variant[:1]}", mean)
            show("±", {key: float(np.std([row[key] for row in rows], ddof=1) / np.sqrt(len(rows))) for key in mean})
    return {"few": options.few, "spectrum": options.spectrum, "first_order": options.first_order, "results": results}


def many(options: argparse.Namespace) -> dict[str, Any]:
    """Identify two rubbers from many replicates, over and over."""
    results: dict[str, Any] = {}
    for name in [options.material] if options.material else MATERIALS:
        material = MATERIALS[name]()
        exact = vf.predict_friction(material, BALL, speeds=SPEEDS, temperatures=KELVIN, load="25 N", accuracy=1e-4)
        print(f"\n{name}\n{'':12}" + "".join(f"{heading:>9}" for heading in HEADINGS))
        exactly = identified(material, measured(exact, None))
        show("no noise", exactly)
        rows, refused = [], {}
        for seed in range(options.first, options.first + options.seeds):
            try:
                rows.append(identified(material, measured(exact, seed)))
            except ViscofricError as error:
                refused[seed] = str(error)
                print(f"seed {seed}: {error}", flush=True)
            else:
                show(f"seed {seed}", rows[-1])
        mean = {key: float(np.mean([row[key] for row in rows])) for key in exactly} if rows else {}
        if mean:
            show("mean", mean)
        results[name] = {"no noise": exactly, "scattered": rows, "refused": refused, "mean": mean}
    return results


def show(title: str, row: dict[str, Any]) -> None:
    """Print a row."""
    percent = {key: 100.0 * row[key] for key in ("modulus", "loss", "width")}
    print(
        f"{title:12}{row['seconds']:9.1f}{row['steps']:9.1f}{row['decades']:9.1f}{percent['modulus']:9.3f}"
        f"{percent['loss']:9.3f}{row['alpha']:9.4f}{row['chi2']:9.2f}"
        + "".join(f"{row[key]:9.2f}" for key in ("in |E|", "in E'", "in E''", "in α", "in μ", "lowest"))
        + f"{percent['width']:9.2f}",
        flush=True,
    )


if __name__ == "__main__":
    main()
