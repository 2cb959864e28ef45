"""Densities H and L of a power law, where their estimates from the modulus are exact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from viscofric.rheology.spectra.response import FrequencyResponse


class PowerLaw(FrequencyResponse):
    """A spring-pot, E = (iω)ⁿ in Pa and rad/s."""

    def __init__(self, n):
        self.n = n

    def complex_modulus(self, angular_frequency):
        return (1j * np.asarray(angular_frequency)) ** self.n

    def compliance(self, angular_frequency):
        return 1.0 / self.complex_modulus(angular_frequency)


@pytest.mark.parametrize("n", [0.1, 0.5, 0.8])
def test_densities_of_a_power_law_are_power_laws_of_time(n):
    """∫ xⁿ⁻¹/(1 + x) dx from 0 to ∞ is π/sin nπ: L = (sin nπ/π) τⁿ makes S = (iω)⁻ⁿ, H = (sin nπ/π) τ⁻ⁿ its inverse."""
    tau = np.logspace(-6, 6, 13)
    size = math.sin(n * math.pi) / math.pi
    rubber = PowerLaw(n)
    # Exact but for rounding: δ = nπ/2 at all frequencies, and (2/π) sin δ cos δ = sin(2δ)/π.
    assert rubber.retardation_density(tau) == pytest.approx(size * tau**n, rel=1e-12, abs=0.0)
    assert rubber.relaxation_density(tau) == pytest.approx(size * tau**-n, rel=1e-12, abs=0.0)
