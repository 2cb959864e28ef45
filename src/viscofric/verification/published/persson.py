"""Persson's theory against its integrals as printed, on plain dense grids."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erf

from viscofric.rheology.material import Material
from viscofric.roughness.persson import persson_theory
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.verification.check import Check, Comparison

if TYPE_CHECKING:
    from collections.abc import Iterator

    from viscofric.arrays import Array

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


CHECKS = (
    Check(
        "persson-theory",
        "Persson's theory on a self-affine surface, γ = ½",
        "theory of rough contacts",
        "B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840, doi:10.1063/1.1388626, with the factor S of "
        "B. Lorenz et al., J. Chem. Phys. 142 (2015) 194701",
        "The requested accuracy, 1e-5, and the error of the dense grids: 4001 wave numbers, 181 directions.",
        _theory,
        obtained="The printed integrals on dense grids, written without viscofric's quadrature. The program "
        "perssonmodelling (k100kan35-dotcom on GitHub) agreed within 4e-4 on the same surface; its numbers may not be "
        "copied (no licence), and are not shipped.",
        unstated="The rubber is chosen here.",
    ),
)
