"""viscofric's rows: shifting, spectra, honesty of its bands, exactness of its conversions."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import viscofric as vf

sys.path.insert(0, str(Path(__file__).resolve().parent / "peers"))
import measures
from exchange import timed

if TYPE_CHECKING:
    from cases import Case

    from viscofric.data import MasterCurve

LEVEL_95 = 1.959963984540054
#: Methods of `fit_retardation_spectrum` and what they are asked for.
SPECTRA: dict[str, dict[str, Any]] = {
    "non-negative, τ ratio e": {},
    "regularised, τ ratio e": {"method": "regularised"},
    "sparse, 16 modes": {"method": "sparse", "modes": 16},
}


def shifting(case: Case) -> dict[str, Any]:
    """Superpose with uncertainties; time them."""
    fit, seconds = timed(lambda: vf.superpose(case.sweeps, case.reference))
    factors = fit.shift_factors
    row: dict[str, Any] = {"tool": "viscofric", "seconds": seconds, "uncertainty": True}
    row |= measures.of_shifts(case, factors.log10_values)
    row["C1"], row["C2"] = measures.wlf_constants(case, factors.log10_values)
    law = factors.law("wlf")
    row["law"] = f"own WLF fit, weighted: C1 {law.C1:.3f} ± {law.standard_errors[0]:.3f}, "
    row["law"] += f"C2 {law.C2:.2f} ± {law.standard_errors[1]:.2f} K"
    row["wlf"] = [law.C1, law.C2, *law.standard_errors]
    return row


def spectrum(curve: MasterCurve, name: str) -> dict[str, Any]:
    """Fit a spectrum by one of the methods; time it."""
    found, seconds = timed(lambda: vf.fit_retardation_spectrum(curve, **SPECTRA[name]))
    row = {"tool": f"viscofric, {name}", "seconds": seconds, "modes": int(np.count_nonzero(found.C))}
    return row | measures.of_modulus(curve, found.complex_modulus(curve.angular_frequency))


def round_trip(modes: int = 60) -> dict[str, Any]:
    """Convert a spectrum of many modes to a Prony series and back."""
    random = np.random.default_rng(0)
    tau = np.exp(np.arange(float(modes)) - modes / 2.0)
    C = random.uniform(0.1, 1.0, modes)
    C *= (1.0 / 1e6 - 1.0 / 2e9) / C.sum()
    planted = vf.RetardationSpectrum(1e6, 2e9, C, tau)
    back, seconds = timed(lambda: planted.to_relaxation().to_retardation())
    error = max(float(np.max(np.abs(back.C / C - 1.0))), float(np.max(np.abs(back.tau / tau - 1.0))))
    omega = np.geomspace(0.1 / tau[-1], 10.0 / tau[0], 400)
    series = planted.to_relaxation().complex_modulus(omega)
    in_modulus = float(np.max(np.abs(series / planted.complex_modulus(omega) - 1.0)))
    return {"tool": "viscofric", "modes": modes, "error": max(error, in_modulus), "seconds": seconds}


def coverage(material: str, seeds: range, samples: int = 200) -> dict[str, Any]:
    """Count how often planted α(T) and E(ω) lie within the stated 95 % bands."""
    from cases import planted_case

    from viscofric.rheology.uncertainty.sampling import sample_materials

    start = time.process_time()
    alpha, storage, loss = [], [], []
    for seed in seeds:
        case = planted_case(seed, material)
        fit = vf.superpose(case.sweeps, case.reference)
        factors = fit.shift_factors
        true = case.truth.log10_alpha(factors.temperatures, case.reference)
        known = factors.standard_errors > 0.0
        away = np.abs(factors.log10_values - true)[known] / factors.standard_errors[known]
        alpha.append(np.mean(away <= LEVEL_95))
        omega = np.geomspace(fit.master_curve.angular_frequency[0], fit.master_curve.angular_frequency[-1], 60)
        band = sample_materials(fit, samples=samples, seed=seed).modulus_band(omega, level=0.95)
        modulus = case.truth.complex_modulus(omega, case.reference)
        storage.append(_inside(modulus.real, band.lower.real, band.upper.real))
        loss.append(_inside(modulus.imag, band.lower.imag, band.upper.imag))
    row = {
        "tool": f"viscofric, {material}",
        "seeds": len(seeds),
        "seconds": (time.process_time() - start) / max(len(seeds), 1),
    }
    return row | {"alpha": _mean(alpha), "storage": _mean(storage), "loss": _mean(loss)}


def with_offsets(problem: dict[str, Any], seeds: range, samples: int = 100) -> dict[str, Any]:
    """Count the same for a problem of `cases.OFFSET_PROBLEMS`; tan δ and friction at both ends of the temperatures.

    Friction is that of a ball at the second and the last but one temperature.
    """
    from cases import offset_case

    from viscofric.rheology.uncertainty.sampling import sample_materials

    start = time.process_time()
    kinds = ("alpha", "storage", "loss", "tangent", "friction")
    inside: dict[str, list[float]] = {kind: [] for kind in kinds}
    widths: dict[str, list[float]] = {"alpha_error": [], "loss_width": []}
    doubtful = 0
    for seed in seeds:
        planted, reference = offset_case(problem, seed)
        fit = vf.superpose(planted.sweeps, reference, vertical=problem.get("vertical"), by=problem.get("by", "both"))
        factors, curve = fit.shift_factors, fit.master_curve
        known = factors.standard_errors > 1e-9
        away = np.abs(factors.log10_values - planted.log10_alpha(factors.temperatures, reference))[known]
        inside["alpha"].append(np.mean(away <= LEVEL_95 * factors.standard_errors[known]))
        widths["alpha_error"].append(np.median(factors.standard_errors[known]))
        doubtful += fit.check.verdict != "holds"
        drawn = sample_materials(fit, samples=samples, seed=seed)
        omega = np.geomspace(curve.angular_frequency[0], curve.angular_frequency[-1], 60)
        band, modulus = drawn.modulus_band(omega), planted.material.complex_modulus(omega, reference)
        inside["storage"].append(_inside(modulus.real, band.lower.real, band.upper.real))
        inside["loss"].append(_inside(modulus.imag, band.lower.imag, band.upper.imag))
        widths["loss_width"].append(np.median(0.5 * np.log(band.upper.imag / band.lower.imag)))
        for place in (1, -2):
            kelvin = float(factors.temperatures[place])
            rates = fit.isotherms[place].angular_frequency[[0, -1]]
            limits = drawn.band(lambda one, at=(rates, kelvin): _tangent(one.complex_modulus(*at)))
            true = _tangent(planted.complex_modulus(rates, kelvin))
            inside["tangent"].append(_inside(true, limits.lower, limits.upper))
            inside["friction"].append(_friction_inside(fit, drawn, planted, kelvin))
    row = {"tool": problem["title"], "seeds": len(seeds), "seconds": (time.process_time() - start) / max(len(seeds), 1)}
    row |= {kind: _mean(shares) for kind, shares in (inside | widths).items()}
    return row | {"doubtful": doubtful}


def steps(problem: dict[str, Any], seeds: range, samples: int = 100) -> dict[str, Any]:
    """Count the same for creep and relaxation tests; the response over the master curve, E(ω) over its range."""
    from cases import step_case

    from viscofric.rheology.uncertainty.sampling import sample_materials

    start = time.process_time()
    inside: dict[str, list[float]] = {kind: [] for kind in ("alpha", "response", "storage", "loss")}
    errors, doubtful = [], 0
    for seed in seeds:
        tests, material, reference = step_case(problem, seed)
        fit = vf.superpose(tests, reference)
        factors, curve = fit.shift_factors, fit.master_curve
        known = factors.standard_errors > 1e-9
        true = material.shift.at_reference(reference).log10(factors.temperatures)
        away = np.abs(factors.log10_values - true)[known]
        inside["alpha"].append(np.mean(away <= LEVEL_95 * factors.standard_errors[known]))
        errors.append(np.median(factors.standard_errors[known]))
        doubtful += fit.check.verdict not in ("holds", "not identified")
        drawn = sample_materials(fit, samples=samples, seed=seed)
        at, spectrum = np.geomspace(curve.time[0], curve.time[-1], 60), material.at(reference)
        limits = drawn.band(lambda one, at=at: _response(one.spectrum, problem["kind"], at))
        inside["response"].append(_inside(_response(spectrum, problem["kind"], at), limits.lower, limits.upper))
        omega = np.geomspace(*drawn.frequency_range, 60)
        band, modulus = drawn.modulus_band(omega), spectrum.complex_modulus(omega)
        inside["storage"].append(_inside(modulus.real, band.lower.real, band.upper.real))
        inside["loss"].append(_inside(modulus.imag, band.lower.imag, band.upper.imag))
    row = {"tool": problem["title"], "seeds": len(seeds), "seconds": (time.process_time() - start) / max(len(seeds), 1)}
    return (
        row
        | {kind: _mean(shares) for kind, shares in inside.items()}
        | {"alpha_error": _mean(errors), "doubtful": doubtful}
    )


#: Where bands are counted: decades from the lowest and from the highest measured frequency, inward and outward.
OUTWARD = (0.5, 1.0, 2.0, 3.0, 5.0)
ZONES = (*(f"−{decades:g}" for decades in OUTWARD[::-1]), "bottom", "inside", "top", *(f"+{one:g}" for one in OUTWARD))


def zones(lowest: float, highest: float) -> dict[str, Any]:
    """Return angular frequencies at distances beyond both ends, in the half decade within, and between."""
    low, high = np.log10([lowest, highest])
    places = (
        *(np.array([low - decades]) for decades in OUTWARD[::-1]),
        np.linspace(low, low + 0.5, 4),
        np.linspace(low + 0.5, high - 0.5, 8)[1:-1],
        np.linspace(high - 0.5, high, 4),
        *(np.array([high + decades]) for decades in OUTWARD),
    )
    return {zone: 10.0**place for zone, place in zip(ZONES, places, strict=True)}


def edges(problem: dict[str, Any], seeds: range, friction: bool, samples: int = 100) -> list[dict[str, Any]]:
    """Count how often E', E'', tan δ and friction lie within their bands, by the distance from the measured ends.

    One row of each quantity: shares, median half-widths of the bands of its logarithm, and how often a zone has the
    estimate outside of its own band.  Friction is that of a ball whose contact has the middle frequency of the zone.
    """
    from cases import edge_case

    from viscofric.rheology.uncertainty.sampling import sample_materials

    start = time.process_time()
    names = {"E'": [], "E''": [], "tan δ": []} | ({"μ": []} if friction else {})
    counted: dict[str, list[Any]] = names
    for seed in seeds:
        planted, reference = edge_case(problem, seed)
        fit = vf.superpose(planted.sweeps, reference)
        spectrum = vf.fit_retardation_spectrum(fit.master_curve)
        drawn = sample_materials(fit, spectrum, samples=samples, seed=seed)
        shares: dict[str, list[Any]] = {name: [] for name in counted}
        places = zones(*drawn.frequency_range)
        for omega in places.values():
            band, true = drawn.modulus_band(omega), planted.complex_modulus(omega, reference)
            found = spectrum.complex_modulus(omega)
            tangent = drawn.band(lambda one, at=omega: _tangent(one.complex_modulus(at)))
            shares["E'"].append(_held(true.real, found.real, band.lower.real, band.upper.real))
            shares["E''"].append(_held(true.imag, found.imag, band.lower.imag, band.upper.imag))
            shares["tan δ"].append(_held(_tangent(true), _tangent(found), tangent.lower, tangent.upper))
        if friction:
            shares["μ"] = _friction_held(vf.Material(spectrum, fit.shift_factors), drawn, planted, reference, places)
        for name, rows in shares.items():
            counted[name].append(rows)
    seconds = (time.process_time() - start) / max(len(seeds), 1)
    rows = []
    for name, one in counted.items():
        held = np.array(one)  # (seeds, zones, 3)
        row = {"tool": f"{problem['title']}: {name}", "seeds": len(seeds), "seconds": seconds}
        for place, zone in enumerate(ZONES):
            row[zone] = float(np.mean(held[:, place, 0]))
            row[f"{zone}_width"] = float(np.median(held[:, place, 1]))
        row["strayed"] = float(np.mean(held[:, :, 2]))
        rows.append(row)
    return rows


def _held(true: Any, found: Any, lower: Any, upper: Any) -> tuple[float, float, float]:
    """Return the share of values in bands, their mean half-width in decades, and the share of estimates outside."""
    width = float(np.mean(0.5 * np.log10(upper / np.maximum(lower, 1e-300))))
    return _inside(true, lower, upper), width, 1.0 - _inside(found, lower, upper)


def _friction_held(
    material: vf.Material, drawn: Any, planted: Any, reference: float, places: dict[str, Any]
) -> list[tuple[float, float, float]]:
    """Return the same for friction of a ball at one speed for each zone, with a contact of the zone's frequency."""
    radius, load = 0.01, 1.0
    omega = np.array([np.sqrt(zone[0] * zone[-1]) for zone in places.values()])
    half = np.cbrt(0.75 * load * radius * 0.75 / material.complex_modulus(omega).real)  # of Hertz's contact, ν = 1/2
    speeds = omega * half
    order = np.argsort(speeds)
    problem: dict[str, Any] = {
        "speeds": list(speeds[order]),
        "temperatures": [reference],
        "load": load,
        "accuracy": 1e-2,
    }
    curves = vf.predict_friction(material, vf.Ball(radius), samples=drawn, **problem)
    true = vf.predict_friction(planted.material, vf.Ball(radius), **problem).viscoelastic
    limits = zip(true, curves.viscoelastic, curves.viscoelastic_lower, curves.viscoelastic_upper, strict=True)
    held = [_held(*one) for one in limits]
    return [held[place] for place in np.argsort(order)]


def _response(spectrum: Any, kind: str, at: Any) -> Any:
    return spectrum.creep_compliance(at) if kind == "creep" else spectrum.relaxation_modulus(at)


def _tangent(modulus: Any) -> Any:
    return modulus.imag / modulus.real


def _friction_inside(fit: Any, drawn: Any, planted: Any, kelvin: float) -> float:
    """Say whether planted friction of a ball, 1 mm/s and 0.1 m/s, lies in its band."""
    ball, problem = vf.Ball("10 mm"), {"load": 5.0, "accuracy": 1e-2}
    found = vf.Material(vf.fit_retardation_spectrum(fit), fit.shift_factors, vertical_shift=fit.vertical_shift)
    curves = vf.predict_friction(found, ball, speeds=[1e-3, 0.1], temperatures=[kelvin], samples=drawn, **problem)
    b = 10.0 ** planted.log10_b(kelvin)  # E/b at the same load is E at the load over b
    true = vf.predict_friction(
        planted.material, ball, speeds=[1e-3, 0.1], temperatures=[kelvin], **problem | {"load": problem["load"] / b}
    )
    return _inside(true.viscoelastic, curves.viscoelastic_lower, curves.viscoelastic_upper)


def _inside(true: Any, lower: Any, upper: Any) -> float:
    return float(np.mean((true >= lower) & (true <= upper)))


def _mean(shares: list[float]) -> float:
    return float(np.mean(shares)) if shares else float("nan")
