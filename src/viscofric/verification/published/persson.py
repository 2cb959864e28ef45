"""Persson's theory against its integrals as printed, on plain dense grids."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import erf, erfcx

from viscofric.arrays import Array
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import Arrhenius
from viscofric.roughness.persson import persson_theory
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.thermal import ThermalProperties
from viscofric.verification.check import Comparison, checks

check = checks("theory of rough contacts")

_HURST, _FIRST, _LAST, _SLOPE = 0.8, 500.0, 1e6, 1.3  # q in rad/m; rms slope
_PRESSURE, _NU, _GAMMA = 0.3e6, 0.5, 0.5
_POINTS, _DIRECTIONS = 4001, 181


def integrals(material: Material, speed: float) -> tuple[float, float]:
    """Contact area fraction and friction coefficient: trapezoids in ln q, Simpson's rule in the direction."""
    q = np.geomspace(_FIRST, _LAST, _POINTS)
    step = math.log(_LAST / _FIRST) / (_POINTS - 1)
    # ⟨|∇h|²⟩ = 2π ∫ q³ C dq with C = c q^(−2−2H)
    shape = q ** (-2.0 - 2.0 * _HURST)
    power = 2.0 - 2.0 * _HURST
    density = _SLOPE**2 * shape * power / (2.0 * math.pi * (_LAST**power - _FIRST**power))
    phi = np.linspace(0.0, 0.5 * math.pi, _DIRECTIONS)
    weights = np.full(_DIRECTIONS, 2.0)
    weights[1::2], weights[[0, -1]] = 4.0, 1.0
    weights *= 4.0 * (phi[1] - phi[0]) / 3.0  # four quarters
    modulus = material.complex_modulus(q[:, None] * speed * np.cos(phi)) / ((1.0 - _NU**2) * _PRESSURE)

    def summed(integrand: Array) -> Array:
        pieces = 0.5 * step * (integrand[1:] + integrand[:-1])
        return np.concatenate([[0.0], np.cumsum(pieces)])

    spread = summed(q**4 * density * (np.abs(modulus) ** 2 @ weights)) / 8.0
    with np.errstate(divide="ignore"):
        area = erf(0.5 / np.sqrt(spread))
    share = _GAMMA + (1.0 - _GAMMA) * area**2
    friction = 0.5 * summed(q**4 * density * share * area * ((modulus.imag * np.cos(phi)) @ weights))
    return float(area[-1]), float(friction[-1])


@check(
    "persson-theory",
    "Persson's theory on a self-affine surface, γ = ½",
    "B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840, doi:10.1063/1.1388626, with the factor S of "
    "B. Lorenz et al., J. Chem. Phys. 142 (2015) 194701",
    "The requested accuracy, 1e-5, and the error of the dense grids: 4001 wave numbers, 181 directions.",
    obtained="The printed integrals on dense grids, written without viscofric's quadrature. The program "
    "perssonmodelling (k100kan35-dotcom on GitHub) agreed within 4e-4 on the same surface; its numbers may not be "
    "copied (no licence), and are not shipped.",
    unstated="The rubber is chosen here.",
)
def _theory() -> Iterator[Comparison]:
    material = Material.standard_linear_solid(3e6, 300e6, 1e-5, _NU)
    surface = PowerSpectrum.self_affine(
        _HURST, longest=2.0 * math.pi / _FIRST, shortest=2.0 * math.pi / _LAST, rms_slope=_SLOPE
    )
    for speed in (1e-3, 0.1, 10.0):
        found = persson_theory(material, surface, speeds=[speed], pressure=_PRESSURE, gamma=_GAMMA, accuracy=1e-5)
        area, friction = integrals(material, speed)
        case = f"H = 0.8, rms slope 1.3, {speed:g} m/s"
        yield Comparison(case, "A/A0", float(found.contact_area_fraction[0, 0]), area, 2e-5)
        yield Comparison(case, "friction coefficient", float(found.friction_coefficient[0, 0]), friction, 2e-5)


_WAVE, _WIDTH = 2e5, 1e-4  # rad/m, and the part of it over which the waves of one length are spread
_FULL_CONTACT, _ONE_SLOPE, _KELVIN = 1e9, 0.5, 293.15  # Pa, rms slope, K
_RUBBER = ThermalProperties(0.25, 1200.0, 1600.0, "rubber")


def conduction(wave_number: float, diffusivity: float, time: float) -> float:
    """g(q, q) of the theory, s: the weight of a wave's own heat of a time t0.

    With x = 2q√(D t), 1/π ∫dk exp(−D k² t) (4q)²q/(k² + 4q²)² = ½ [erfcx x − x erfcx' x], to be integrated to t0.
    """

    def kept(root: float) -> float:
        x = 2.0 * wave_number * math.sqrt(diffusivity) * root
        slope = 2.0 * x * erfcx(x) - 2.0 / math.sqrt(math.pi)
        return float(root * (erfcx(x) - x * slope))

    return float(quad(kept, 0.0, math.sqrt(time), epsrel=1e-10)[0])


def heated_wave(material: Material, speed: float) -> tuple[float, float]:
    """Rise of temperature, K, and friction coefficient of waves of one length in full contact."""
    plane_strain = 1.0 - material.poisson_ratio**2
    phi = 2.0 * math.pi * (np.arange(720) + 0.5) / 720
    omega = _WAVE * speed * np.abs(np.cos(phi))

    def lost(rise: float) -> float:
        """Dissipated stress, Pa: ½ q³C dq ∫dφ |cos φ| Im E, of the rms slope s, 2π q³C dq = s²."""
        loss = material.complex_modulus(omega, _KELVIN + rise).imag
        return 0.5 * _ONE_SLOPE**2 * float(np.mean(loss * np.abs(np.cos(phi)))) / plane_strain

    kept = 2.0 * _WAVE * conduction(_WAVE, _RUBBER.diffusivity, math.pi / (_WAVE * speed)) * speed / _RUBBER.volume_heat
    rise = float(brentq(lambda one: kept * lost(one) - one, 0.0, 300.0, xtol=1e-12))
    return rise, lost(rise) / _FULL_CONTACT


@check(
    "persson-flash",
    "Flash temperature in Persson's theory, waves of one length in full contact",
    "B. N. J. Persson, J. Phys.: Condens. Matter 18 (2006) 7789, doi:10.1088/0953-8984/18/32/025",
    "The width of the band: waves are spread over 1e-4 of their wave number. A rubber that does not warm rubs as "
    "without heating, to rounding.",
    obtained="With waves of one length the temperature is the root of one equation; the integral over the depth of "
    "the heat is a scaled complementary error function. Written without viscofric's quadrature.",
    unstated="Rubber and surface are chosen here.",
)
def _flash() -> Iterator[Comparison]:
    solid = Material.standard_linear_solid(3e6, 300e6, 1e-5, _NU)
    material = Material(solid.spectrum, Arrhenius(80e3, _KELVIN), _NU)
    ends = {"longest": 2.0 * math.pi / _WAVE, "shortest": 2.0 * math.pi / (_WAVE * (1.0 + _WIDTH))}
    surface = PowerSpectrum.self_affine(_HURST, **ends, rms_slope=_ONE_SLOPE)
    asked: dict[str, Any] = {"pressure": _FULL_CONTACT, "temperatures": _KELVIN, "accuracy": 1e-6}
    for speed in (0.1, 1.0, 10.0):
        found = persson_theory(material, surface, speeds=speed, **asked, thermal=_RUBBER)
        rise, friction = heated_wave(material, speed)
        case = f"waves of one length, full contact, {speed:g} m/s"
        yield Comparison(case, "flash temperature (K)", float(found.flash_temperature[0, 0]), rise, 1e-4)
        yield Comparison(case, "friction coefficient", float(found.friction_coefficient[0, 0]), friction, 1e-4)
    cold = persson_theory(material, surface, speeds=1.0, **asked)
    sink = ThermalProperties(0.25, 1e9, 1e9, "a body that does not warm")
    same = persson_theory(material, surface, speeds=1.0, **asked, thermal=sink)
    values = float(same.friction_coefficient[0, 0]), float(cold.friction_coefficient[0, 0])
    yield Comparison("a rubber that does not warm, 1 m/s", "friction coefficient", *values, 1e-9)
