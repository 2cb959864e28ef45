"""Relaxation and retardation series of one material: equal at every frequency, back to themselves, and physical."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from refusals import refused
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.spectra.response import FrequencyResponse
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum

OMEGA = np.logspace(-15, 15, 1000)


def series(seed, modes=60, decades=24, strengths=6.0, E0=1e6):
    """Random Prony series of solids."""
    random = np.random.default_rng(seed)
    tau = 10.0 ** np.sort(random.uniform(-decades / 2, decades / 2, modes))
    return RelaxationSpectrum(E0, 1e6 * 10.0 ** random.uniform(-strengths, strengths, modes), tau)


def gap(spectrum):
    """Smallest relative distance of neighbouring times."""
    tau = np.sort(spectrum.tau)
    return float(np.min(np.diff(tau) / tau[1:], initial=1.0))


def assert_same_modulus(one, other, rel=1e-12):
    first, second = one.complex_modulus(OMEGA), other.complex_modulus(OMEGA)
    assert first.real == pytest.approx(second.real, rel=rel)
    assert first.imag == pytest.approx(second.imag, rel=rel)  # the loss by itself: it is small at both ends


@pytest.mark.parametrize("seed", range(5))
def test_sixty_modes_over_24_decades_return_to_themselves(seed):
    prony = series(seed)
    back = prony.to_retardation().to_relaxation()
    assert len(back) == 60
    # The required 1e-10; measured 1e-13 and below (rounding of times over their gaps).
    assert pytest.approx(prony.E, rel=1e-10, abs=0.0) == back.E
    assert back.tau == pytest.approx(prony.tau, rel=1e-12, abs=0.0)
    assert pytest.approx(prony.E0, rel=1e-13) == back.E0


@pytest.mark.parametrize("seed", range(5))
def test_both_series_are_one_material_at_every_frequency(seed):
    prony = series(seed + 100)
    assert_same_modulus(prony.to_retardation(), prony)


def test_synthetic_fluoroelastomer_is_the_same_as_a_prony_series():
    spectrum = synthetic_fluoroelastomer().spectrum
    prony = spectrum.to_relaxation()
    assert_same_modulus(spectrum, prony)
    back = prony.to_retardation()
    assert pytest.approx(spectrum.C, rel=1e-10, abs=0.0) == back.C
    assert back.tau == pytest.approx(spectrum.tau, rel=1e-12, abs=0.0)


def test_relaxation_and_retardation_times_interlace():
    prony = series(7, modes=30)
    retardation = prony.to_retardation()
    times = np.stack([prony.tau, retardation.tau], axis=1).ravel()
    assert np.all(np.diff(times) >= 0.0)  # τ1 ≤ λ1 ≤ τ2 ≤ …: equal where they differ by less than rounding
    assert retardation.tau[-1] > prony.tau[-1]


@pytest.mark.parametrize("seed", range(20))
def test_frequencies_of_modes_reach_from_the_slowest_retardation_to_the_fastest_relaxation(seed):
    prony = series(seed, modes=2 + seed)
    slowest, fastest = prony.to_retardation().known_frequencies.frequency_range
    assert fastest == pytest.approx(1.0 / prony.tau.min(), rel=1e-9)  # Newton's steps end at 1e-12
    assert slowest == pytest.approx(1.0 / prony.to_retardation().tau.max(), rel=1e-15)


def test_standard_linear_solid_has_the_textbook_times():
    E0, E1, tau = 2e6, 6e6, 0.3
    retardation = RelaxationSpectrum(E0, [E1], [tau]).to_retardation()
    # A Zener solid: λ = τ E_inf/E0, C = 1/E0 − 1/E_inf.
    assert retardation.tau == pytest.approx([tau * (E0 + E1) / E0], rel=1e-15)
    assert pytest.approx([1 / E0 - 1 / (E0 + E1)], rel=1e-15) == retardation.C


def test_weak_modes_next_to_strong_ones_keep_their_digits():
    # Strengths over 30 decades: zero and pole agree to all digits there, and only their distance tells.
    prony = RelaxationSpectrum(1e6, [1e8, 1e-16, 3e7, 1e-22, 2e2], [1e-6, 1e-4, 1e-2, 1.0, 1e9])
    back = prony.to_retardation().to_relaxation()
    assert pytest.approx(prony.E, rel=1e-12, abs=0.0) == back.E
    assert_same_modulus(prony.to_retardation(), prony)


@pytest.mark.slow
@settings(deadline=None, max_examples=30)
@example(pairs=[(0.0, 0.0), (0.0, 2.8203125), (0.0, -3.135647705389331e-17)], log_E0=0.0)  # one after scaling
@given(
    st.lists(st.tuples(st.floats(-6.0, 6.0), st.floats(-9.0, 9.0)), min_size=1, max_size=25),
    st.floats(-3.0, 9.0),
)
def test_any_solid_returns_to_itself_within_its_conditioning(pairs, log_E0):
    E = 1e6 * 10.0 ** np.array([strength for strength, _ in pairs])
    prony = RelaxationSpectrum(10.0**log_E0, E, 10.0 ** np.array([exponent for _, exponent in pairs]))
    retardation = prony.to_retardation()
    assert_same_modulus(retardation, prony)
    back = retardation.to_relaxation()
    closest = min(gap(prony), gap(retardation))
    if closest < 1e-9:  # modes that a double cannot tell apart come back as one, or with other shares
        return
    merged = {}
    for modulus, tau in zip(prony.E, prony.tau, strict=True):
        merged[tau] = merged.get(tau, 0.0) + modulus
    tau = np.array(sorted(merged))
    # Rounding of times over their smallest gap is the condition of the problem; 1e3 for the number of modes.
    assert back.tau == pytest.approx(tau, rel=1e-12, abs=0.0)
    assert pytest.approx([merged[one] for one in tau], rel=1e3 * 2.3e-16 / closest, abs=0.0) == back.E


@pytest.mark.parametrize("spread", [1e-2, 1e-4, 1e-6])
def test_clustered_times_lose_digits_in_proportion_and_the_modulus_none(spread):
    tau = 1.0 + spread * np.arange(8)
    prony = RelaxationSpectrum(1e6, np.linspace(1e6, 3e6, 8), tau)
    retardation = prony.to_retardation()
    assert_same_modulus(retardation, prony)
    assert_same_modulus(retardation.to_relaxation(), prony)
    # Rounding of the times, 1e-16 of them, over the gaps; 100 for the eight modes.
    assert pytest.approx(prony.E, rel=100 * 1e-16 / spread + 1e-13) == retardation.to_relaxation().E


def test_equal_times_are_joined_and_zero_modes_dropped():
    prony = RelaxationSpectrum(1e6, [1e6, 0.0, 2e6, 5e5], [1.0, 3.0, 1.0, 10.0])
    back = prony.to_retardation().to_relaxation()
    assert back.tau == pytest.approx([1.0, 10.0], rel=1e-14)
    assert pytest.approx([3e6, 5e5], rel=1e-13) == back.E


def test_order_of_the_modes_does_not_matter():
    prony = series(3, modes=12)
    turned = RelaxationSpectrum(prony.E0, prony.E[::-1], prony.tau[::-1])
    assert np.array_equal(prony.to_retardation().C, turned.to_retardation().C)


@pytest.mark.parametrize(("modulus", "seconds"), [(1e-6, 1e9), (1e12, 1e-15), (1e-80, 1e80)])
def test_units_of_modulus_and_time_do_not_matter(modulus, seconds):
    prony = series(5, modes=20)
    scaled = RelaxationSpectrum(modulus * prony.E0, modulus * prony.E, seconds * prony.tau).to_retardation()
    expected = prony.to_retardation()
    assert scaled.C * modulus == pytest.approx(expected.C, rel=1e-12, abs=0.0)
    assert scaled.tau / seconds == pytest.approx(expected.tau, rel=1e-13, abs=0.0)


def test_an_elastic_solid_has_no_modes_either_way():
    solid = RelaxationSpectrum(2e6, [], [])
    assert len(solid.to_retardation()) == 0
    assert solid.to_retardation().E0 == solid.to_retardation().E_inf == 2e6
    assert len(solid.to_retardation().to_relaxation()) == 0


def test_creep_and_relaxation_obey_their_convolution():
    prony = series(11, modes=10, decades=6, strengths=0.5)
    # ∫ E(t − s) J(s) ds = t; Laplace at real s does it without quadrature: s² Ê Ĵ = 1.
    retardation = prony.to_retardation()
    for s in (1e-4, 1.0, 1e4):
        relaxation = prony.E0 + np.sum(prony.E * s * prony.tau / (1 + s * prony.tau))
        creep = 1 / retardation.E_inf + np.sum(retardation.C / (1 + s * retardation.tau))
        assert relaxation * creep == pytest.approx(1.0, rel=1e-13)
    # And in time by the trapezoidal rule: error (step/τ)² with 40,000 steps, shortest τ about 1e-3 of the end.
    quick = RelaxationSpectrum(1e6, [2e6, 5e6], [0.1, 1.0])
    t = np.linspace(0.0, 3.0, 40001)
    product = quick.relaxation_modulus(t[::-1]) * quick.creep_compliance(t)
    assert np.trapezoid(product, t) == pytest.approx(3.0, rel=1e-7)


def test_relaxation_falls_from_glass_to_rubber():
    spectrum = synthetic_fluoroelastomer().spectrum
    modulus = spectrum.relaxation_modulus(np.concatenate([[0.0], np.logspace(-12, 12, 200), [1e30]]))
    assert modulus[0] == pytest.approx(spectrum.E_inf, rel=1e-11)
    assert modulus[-1] == pytest.approx(spectrum.E0, rel=1e-12)
    assert np.all(np.diff(modulus) <= 0.0)


def test_a_liquid_relaxes_and_dissipates():
    liquid = RelaxationSpectrum(0.0, [1e6], [2.0])
    assert liquid.complex_modulus(0.5) == pytest.approx(0.5e6 + 0.5e6j)  # at ωτ = 1 halves of E1
    assert liquid.relaxation_modulus(2.0) == pytest.approx(1e6 / math.e)


@given(st.floats(-5, 5), st.floats(0.5, 2.0))
@settings(deadline=None, max_examples=20)
def test_a_shift_moves_frequency_and_scales_modulus(log_alpha, b):
    prony, omega = series(2, modes=8), np.logspace(-4, 4, 9)
    shifted = prony.shifted(10.0**log_alpha, b)
    assert shifted.complex_modulus(omega) == pytest.approx(b * prony.complex_modulus(10.0**log_alpha * omega))
    # Conversion and shift may be done in either order.
    other = prony.to_retardation().shifted(10.0**log_alpha, b).to_relaxation()
    assert pytest.approx(shifted.E, rel=1e-11) == other.E


def test_sixty_modes_are_converted_in_milliseconds():
    prony = series(1)
    prony.to_retardation()
    start = time.process_time()
    for _ in range(5):
        prony.to_retardation()
    assert (time.process_time() - start) / 5 < 0.1  # measured 3 ms; a busy machine may take ten times as long


def test_an_unbalanced_spectrum_keeps_its_modulus():
    # E0 may differ from 1/(1/E_inf + ΣC) by a millionth; E(ω) comes from the latter.
    spectrum = RetardationSpectrum(1e6 * (1 + 5e-7), 1e8, [1e-6 - 1e-8], [1.0])
    assert_same_modulus(spectrum, spectrum.to_relaxation())
    assert pytest.approx(1e6, rel=1e-14) == spectrum.to_relaxation().E0


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ({"E0": -1.0}, "not-positive"),
        ({"E": [-1.0]}, "not-positive"),
        ({"tau": [0.0]}, "not-positive"),
        ({"tau": [1.0, 2.0]}, "wrong-length"),
        ({"E": [math.inf]}, "not-a-number"),
        ({"E0": 0.0, "E": [0.0]}, "no-modulus"),
    ],
)
def test_impossible_series_are_refused(arguments, code):
    with refused(code):
        RelaxationSpectrum(**{"E0": 1e6, "E": [1e6], "tau": [1.0], **arguments})


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
    # Exact but for rounding: δ = nπ/2 at all frequencies, and (2/π) sin δ cos δ = sin(2δ)/π.
    assert PowerLaw(n).retardation_density(tau) == pytest.approx(size * tau**n, rel=1e-12, abs=0.0)
    assert PowerLaw(n).relaxation_density(tau) == pytest.approx(size * tau**-n, rel=1e-12, abs=0.0)


def test_densities_of_discrete_modes_hold_their_strength():
    spectrum = synthetic_fluoroelastomer().spectrum
    log_tau = np.linspace(math.log(1e-18), math.log(1e14), 8001)
    L = spectrum.retardation_density(np.exp(log_tau))
    # The area under the estimate is 1/E0 − 1/E_inf but for the factor cos δ, which lies between 0.6 and 1 here.
    total = np.trapezoid(L, log_tau) / (1 / spectrum.E0 - 1 / spectrum.E_inf)
    assert 0.9 < total < 1.0
    # Where the modes are dense and smooth, mode / ln ratio is what the estimate approaches.
    middle = np.argmax(spectrum.C)
    assert spectrum.retardation_density(spectrum.tau[middle]) == pytest.approx(spectrum.C[middle], rel=0.4)
    with refused("not-positive"):
        spectrum.relaxation_density(0.0)
