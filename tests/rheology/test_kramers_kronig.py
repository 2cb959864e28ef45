"""Kramers–Kronig: causal pairs of moduli pass, wrong loss moduli do not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscofric as vf
from refusals import refused
from viscofric.data import MasterCurve
from viscofric.rheology.superposition.kramers_kronig import kramers_kronig
from viscofric.showing import with_error

RUBBER = vf.synthetic_fluoroelastomer().spectrum
TRANSITION = np.logspace(-2, 9, 200)


def curve(omega=TRANSITION, noise=0.0, seed=0, loss=1.0, swap=False, spectrum=RUBBER):
    random = np.random.default_rng(seed)
    modulus = spectrum.complex_modulus(omega)
    storage = modulus.real * (1 + noise * random.standard_normal(len(omega)))
    lost = loss * modulus.imag * (1 + noise * random.standard_normal(len(omega)))
    if swap:
        storage, lost = lost, storage
    return MasterCurve(omega, storage, lost, np.full(len(omega), 303.15), 303.15)


def test_a_causal_material_agrees_with_itself():
    found = kramers_kronig(curve())
    # Three modes per decade follow a smooth spectrum to a thousandth.
    assert found.rms_storage < 0.002
    assert found.rms_loss < 0.02
    assert found.loss_scale == pytest.approx(1.0, abs=0.005)
    assert found.holds


@pytest.mark.parametrize("noise", [0.003, 0.01, 0.03])
@pytest.mark.parametrize(
    "omega", [TRANSITION, np.logspace(-6, 0, 100), np.logspace(2, 6, 80)], ids=["all", "plateau", "rise"]
)
def test_noise_alone_is_never_called_a_contradiction(noise, omega):
    for seed in range(10):
        found = kramers_kronig(curve(omega, noise, seed))
        assert found.holds
        # What noise makes of it: about its own size, in decades.
        assert found.rms_storage < 0.5 * noise + 0.002


def test_the_scale_lies_within_its_standard_error():
    for omega in (TRANSITION, np.logspace(0, 6, 120), np.logspace(2, 6, 80)):
        found = [kramers_kronig(curve(omega, 0.02, seed)) for seed in range(40)]
        scores = np.array([(one.loss_scale - 1.0) / one.loss_scale_error for one in found])
        # The error counts neighbouring bins as alike, which noise alone is not: it may be too large, not too small.
        assert np.mean(np.abs(scores) < 1.96) > 0.85


def test_slow_modes_below_the_measured_frequencies_are_no_contradiction():
    """From the falling side of a peak of E'' nothing follows on the constant that slower modes add to E'."""
    omega = np.logspace(0.7, 3.1, 60)  # times the relaxation time of Havriliak and Negami's modulus
    modulus = 4.7e6 + 1.6e9 * (1.0 - (1.0 + (1j * omega) ** 0.62) ** -0.99)
    scatter = 1.0 + 0.02 * np.random.default_rng(3).standard_normal((2, len(omega)))
    measured = scatter[0] * modulus.real, scatter[1] * modulus.imag
    found = kramers_kronig(MasterCurve(omega, *measured, np.full(len(omega), 303.15), 303.15))
    assert found.holds
    assert found.rms_storage < 0.01  # of the noise; those modes counted as known made it 0.08


@pytest.mark.parametrize("factor", [1.3, 1 / 1.3])
@pytest.mark.parametrize(
    "omega", [TRANSITION, np.logspace(-6, 0, 100), np.logspace(2, 6, 80)], ids=["all", "plateau", "rise"]
)
def test_a_loss_modulus_wrong_by_a_factor_is_caught(factor, omega):
    found = kramers_kronig(curve(omega, 0.01, 1, loss=factor))
    assert not found.holds
    assert found.loss_scale == pytest.approx(factor, rel=0.05)
    assert f"E'' is {with_error(found.loss_scale, found.loss_scale_error)} times" in found.sentence


def test_swapped_columns_are_caught():
    found = kramers_kronig(curve(noise=0.01, swap=True))
    assert not found.holds
    assert found.rms_storage > 0.3
    assert "swapped" in found.sentence


@settings(max_examples=10, deadline=None)
@given(modulus=st.floats(-9, 9), time=st.floats(-9, 9), seed=st.integers(0, 100))
def test_units_of_modulus_and_frequency_do_not_matter(modulus, time, seed):
    """Kramers and Kronig know no unit of time: hertz taken for rad/s must be told from elsewhere."""
    plain = curve(TRANSITION, noise=0.01, seed=seed)
    moduli = 10.0**modulus * plain.storage_modulus, 10.0**modulus * plain.loss_modulus
    scaled = MasterCurve(10.0**time * plain.angular_frequency, *moduli, plain.temperature, plain.reference)
    here, there = kramers_kronig(plain), kramers_kronig(scaled)
    # The lattice of modes is laid from the ends, so that it moves along.
    assert (there.rms_storage, there.loss_scale) == pytest.approx((here.rms_storage, here.loss_scale), rel=1e-5)


def test_the_ends_are_not_judged():
    found = kramers_kronig(curve(np.logspace(0, 6, 120)))
    assert not found.judged[0]
    assert not found.judged[-1]


def test_a_short_curve_shows_nothing():
    with refused("too-short"):
        kramers_kronig(curve(np.logspace(0, 1, 20)))
