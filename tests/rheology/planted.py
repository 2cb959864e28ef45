"""Planted truth: synthetic sweeps of a known spectrum, shift law and vertical shift, with known noise."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

import viscofric as vf
from viscofric.data import Isotherm, IsothermalSweeps
from viscofric.step_tests import StepTest, StepTests

#: Steps of 4 K below 0 °C, where α falls by more than a decade in them, of 10 K above: all 26 overlap.
PROGRAMME = (*np.arange(-20.0, 0.0, 4.0), *np.arange(0.0, 201.0, 10.0))  # °C
#: The programme of the built-in example; the isotherms at -30 and -20 °C and one or two more do not overlap.
EXAMPLE_PROGRAMME = tuple(np.arange(-30.0, 221.0, 10.0))  # °C
FREQUENCIES = np.logspace(-1.0, 1.0, 17)  # Hz


def synthetic_polymer() -> vf.Material:
    """Return an invented polymer: one broad transition from 1 MPa to 2 GPa (Cole–Cole-like), WLF about 25 °C."""
    tau = np.exp(np.arange(-28.0, 14.0))
    weight = 1.0 / np.cosh(0.45 * np.log(tau / 1e-4))
    C = (1.0 / 1e6 - 1.0 / 2e9) * weight / weight.sum()
    shift = vf.WLF(C1=9.0, C2=110.0, reference="25 degC")
    return vf.Material(vf.RetardationSpectrum(1e6, 2e9, C, tau), shift, name="invented polymer (synthetic)")


def synthetic_soft_rubber() -> vf.Material:
    """Return an invented soft rubber: two decades of modulus, a long tail to low frequencies, WLF about 20 °C."""
    tau = np.exp(np.arange(-26.0, 12.0))
    weight = (tau / 1e-3) ** 0.25 / (1.0 + (tau / 1e-3) ** 0.6)
    C = (1.0 / 2e6 - 1.0 / 3e8) * weight / weight.sum()
    shift = vf.WLF(C1=7.0, C2=130.0, reference="20 degC")
    return vf.Material(vf.RetardationSpectrum(2e6, 3e8, C, tau), shift, name="invented soft rubber (synthetic)")


#: Families of random spectra, see `random_rubber`.
FAMILIES = ("few modes", "power law", "fractional", "clusters")
#: Decades of frequency in a sweep of a random rubber, and the modulus at rest of all, Pa.
SWEPT, RELAXED = 2.0, 2e6


def random_rubber(family: str, random: np.random.Generator) -> vf.Material:
    """Return an invented rubber whose transition lies about 1 s at 20 °C, often in part beyond what sweeps reach.

    "few modes": 3 to 8 retardation times over eight decades.  "power law": C as a power of τ over three to nine
    decades.  "fractional": the Cole–Cole compliance, sin πβ / (cosh(β ln τ/τ0) + cos πβ).  "clusters": two to four
    groups of modes, normal in ln τ, with gaps between them.
    """
    tau = np.logspace(-14.0, 14.0, 225)
    if family == "few modes":
        tau = np.sort(10.0 ** random.uniform(-4.0, 4.0, random.integers(3, 9)))
        strength = 10.0 ** random.uniform(-1.0, 0.0, len(tau))
    elif family == "power law":
        ends = random.uniform(-5.0, -1.0), random.uniform(1.0, 4.0)
        strength = np.where((np.log10(tau) > ends[0]) & (np.log10(tau) < ends[1]), tau ** random.uniform(0.1, 0.6), 0.0)
    elif family == "fractional":
        beta, away = random.uniform(0.25, 0.75), np.log(tau) - np.log(10.0) * random.uniform(-2.0, 2.0)
        strength = 1.0 / (np.cosh(beta * away) + np.cos(np.pi * beta))
    else:
        places = np.sort(random.uniform(-4.0, 4.0, random.integers(2, 5)))
        widths, weights = random.uniform(0.15, 0.8, len(places)), 10.0 ** random.uniform(-1.0, 0.0, len(places))
        strength = np.exp(-0.5 * ((np.log10(tau)[:, None] - places) / widths) ** 2) @ weights
    stiffness = 10.0 ** random.uniform(0.7, 3.0)
    C = (1.0 - 1.0 / stiffness) / RELAXED * strength / strength.sum()
    seen = strength > 1e-9 * strength.max()
    spectrum = vf.RetardationSpectrum(1.0 / (C[seen].sum() + 1.0 / (stiffness * RELAXED)), stiffness * RELAXED,
                                      C[seen], tau[seen])  # fmt: skip
    return vf.Material(spectrum, vf.WLF(C1=8.0, C2=130.0, reference="20 degC"), name=f"random rubber, {family}")


def random_sweeps(seed: int, family: str, *, offset: float = 0.0) -> Planted:
    """Make sweeps of a random rubber: 3 to 8 isotherms, 5 to 20 points, 1 to 5 % of noise.

    Neighbouring isotherms overlap by 0.8 to 1.5 of their two decades; `offset` is that of `planted_sweeps`, shared.
    """
    random = np.random.default_rng([seed, FAMILIES.index(family)])
    material = random_rubber(family, random)
    count, points = int(random.integers(3, 9)), int(random.integers(5, 21))
    noise, step = 10.0 ** random.uniform(-2.0, np.log10(0.05)), random.uniform(0.5, 1.2)
    assert isinstance(material.shift, vf.WLF)
    places = step * (np.arange(count) - 0.5 * (count - 1))  # log10 α = −C1 θ/(C2 + θ)
    celsius = 20.0 - 130.0 * places / (places + 8.0)
    return planted_sweeps(
        seed,
        noise,
        material=material,
        celsius=np.sort(celsius),
        frequencies=np.logspace(-0.5 * SWEPT, 0.5 * SWEPT, points) / (2.0 * np.pi),
        offset=offset,
        shared=True,
    )


@dataclass(frozen=True)
class Planted:
    """Sweeps and the truth that they were made of.

    Parameters
    ----------
    sweeps : IsothermalSweeps
        With noise.
    material : viscofric.Material
        True spectrum and α(T); `material.spectrum` holds at `material.reference`.
    log10_b : callable
        True log10 b of a temperature in K, zero at the material's reference.
    """

    sweeps: IsothermalSweeps
    material: vf.Material
    log10_b: Callable[[float], float]

    def log10_alpha(self, temperatures, reference) -> np.ndarray:
        """Return the true log10 α at temperatures (K) about a reference."""
        return self.material.shift.at_reference(reference).log10(np.asarray(temperatures, dtype=float))

    def complex_modulus(self, angular_frequency, temperature) -> np.ndarray:
        """Return the true E(ω, T), Pa, vertical shift included; temperature in K."""
        return 10.0 ** self.log10_b(temperature) * self.material.complex_modulus(angular_frequency, temperature)


def no_vertical_shift(kelvin: float) -> float:
    """Return log10 1."""
    return 0.0 * kelvin


def planted_sweeps(
    seed: int,
    noise: float = 0.01,
    *,
    material: vf.Material | None = None,
    celsius=PROGRAMME,
    frequencies=FREQUENCIES,
    log10_b: Callable[[float], float] = no_vertical_shift,
    offset: float = 0.0,
    shared: bool = False,
) -> Planted:
    """Make sweeps with independent multiplicative noise on E' and on E'', and with offsets of whole isotherms.

    Parameters
    ----------
    seed : int
        Of the noise.
    noise : float
        Relative standard deviation.
    material : viscofric.Material, optional
        The synthetic fluoroelastomer by default.
    celsius : sequence of float
        Temperatures of the isotherms, °C.
    frequencies : sequence of float
        Hz.
    log10_b : callable
        Vertical shift of a temperature in K.
    offset : float
        Relative standard deviation of the factors that all points of an isotherm have in common.
    shared : bool
        Whether E' and E'' have the same factor, as after clamping anew.
    """
    material = material or vf.synthetic_fluoroelastomer()
    random = np.random.default_rng(seed)
    levels = np.random.default_rng([seed, 1])
    omega = 2.0 * np.pi * np.asarray(frequencies, dtype=float)
    isotherms = []
    for temperature in np.asarray(celsius, dtype=float) + 273.15:
        modulus = 10.0 ** log10_b(temperature) * material.complex_modulus(omega, temperature)
        scatter = 1.0 + noise * random.standard_normal((2, omega.size))
        level = np.exp(offset * levels.standard_normal(2))
        scatter[0] *= level[0]
        scatter[1] *= level[0 if shared else 1]
        isotherms.append(Isotherm(temperature, omega, scatter[0] * modulus.real, scatter[1] * modulus.imag))
    return Planted(IsothermalSweeps(tuple(isotherms)), material, log10_b)


#: Temperatures (°C) and times (s) at which step tests are planted, and the reference, by the name of the material.
_HOUR = np.logspace(0.0, 3.5, 36)
STEP_PROGRAMMES = {
    "fluoroelastomer": (vf.synthetic_fluoroelastomer, np.arange(-15.0, 41.0, 5.0), _HOUR, "10 degC"),
    "polymer": (synthetic_polymer, np.arange(-25.0, 11.0, 5.0), _HOUR, "-5 degC"),
    "soft rubber": (synthetic_soft_rubber, np.arange(-35.0, 31.0, 5.0), np.logspace(0.0, 4.0, 41), "0 degC"),
}


def planted_steps(
    seed: int, noise: float = 0.01, *, name="fluoroelastomer", kind="creep", offset: float = 0.0, time=None
):
    """Make creep or relaxation tests with independent multiplicative noise, and offsets of whole tests.

    At the times (s) of the programme `name` if none are given.

    Returns
    -------
    tests : StepTests
    material : viscofric.Material
        The truth.
    reference : str
    """
    make, celsius, usual, reference = STEP_PROGRAMMES[name]
    time = usual if time is None else time
    material, random, levels = make(), np.random.default_rng(seed), np.random.default_rng([seed, 1])
    tests = []
    for kelvin in celsius + 273.15:
        spectrum = material.at(kelvin)
        true = spectrum.creep_compliance(time) if kind == "creep" else spectrum.relaxation_modulus(time)
        scatter = (1.0 + noise * random.standard_normal(time.size)) * np.exp(offset * levels.standard_normal())
        tests.append(StepTest(kelvin, time, scatter * true))
    return StepTests(tuple(tests), kind), material, reference


def liquid_modulus(omega: float, kelvin: float) -> complex:
    """Return the modulus, Pa, of a SYNTHETIC liquid of three relaxation times with a WLF shift."""
    liquid = vf.RelaxationSpectrum(0.0, [1e9, 1e7, 1e6], [1e-4, 1e-2, 1.0])
    return complex(liquid.complex_modulus(omega * vf.WLF(8.0, 120.0, "30 degC")(kelvin)))


def write_moduli(path: Path, modulus: Callable[..., Any], celsius: Iterable[float], hertz: Iterable[float]) -> Path:
    """Write moduli in tension, Pa, a function of angular frequency and temperature in kelvin, as a table of sweeps."""
    rows = ["temperature (degC),frequency (Hz),E' (MPa),E'' (MPa)"]
    for one, frequency in product(celsius, hertz):
        E = 1e-6 * complex(modulus(2.0 * np.pi * frequency, one + 273.15))
        rows.append(f"{one},{frequency:.12g},{E.real:.12g},{E.imag:.12g}")
    path.write_text("\n".join(rows), encoding="utf-8")
    return path


def write_amplitudes(path: Path, law: vf.rheology.KrausLaw, strains: Iterable[float]) -> Path:
    """Write the moduli of a law at some strains as a table of an amplitude sweep."""
    letter = "G" if law.deformation == "shear" else "E"
    rows = [f"temperature (degC),frequency (Hz),strain amplitude (%),{letter}' (MPa),{letter}'' (MPa)"]
    for strain in strains:
        modulus = 1e-6 * complex(law.complex_modulus(strain))
        hertz = law.angular_frequency / (2.0 * np.pi)
        place = f"{law.temperature - 273.15:.12g},{hertz:.12g},{100.0 * strain:.12g}"
        rows.append(f"{place},{modulus.real:.12g},{modulus.imag:.12g}")
    path.write_text("\n".join(rows), encoding="utf-8")
    return path
