"""Materials without a spectrum: what a table says between its frequencies, at them and beyond them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from refusals import refused
from viscofric.data import MasterCurve
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.spectra.modulus_table import ModulusTable

RUBBER = synthetic_fluoroelastomer().spectrum


def table(per_decade=10, low=-4, high=8, **options):
    omega = np.logspace(low, high, (high - low) * per_decade + 1)
    return ModulusTable(omega, RUBBER.storage_modulus(omega), RUBBER.loss_modulus(omega), **options)


def test_a_table_returns_its_own_values():
    one = table()
    assert one.complex_modulus(one.angular_frequency) == pytest.approx(
        RUBBER.complex_modulus(one.angular_frequency), rel=1e-12
    )


def test_between_its_frequencies_it_follows_the_rubber_and_converges():
    omega = np.logspace(-3.9, 7.9, 997)
    exact = RUBBER.complex_modulus(omega)

    def error(per_decade):
        modulus = table(per_decade).complex_modulus(omega)
        return max(np.max(np.abs(modulus.real / exact.real - 1)), np.max(np.abs(modulus.imag / exact.imag - 1)))

    coarse, fine = error(5), error(10)
    assert fine < 0.01  # 10 points to a decade of a curve that turns over decades
    assert coarse / fine > 3.0  # second order at least: monotone interpolation is no better at extrema


@settings(deadline=None, max_examples=30)
@given(st.lists(st.floats(0.0, 1.0), min_size=2, max_size=12))
def test_a_rising_storage_modulus_never_falls_in_between(steps):
    omega = np.logspace(0, len(steps) - 1, len(steps))
    storage = 1e6 * 10.0 ** np.cumsum(steps)
    modulus = ModulusTable(omega, storage, np.ones_like(storage)).storage_modulus(np.logspace(0, len(steps) - 1, 301))
    assert np.all(np.diff(modulus) >= -1e-12 * modulus[1:])


def test_negative_frequencies_give_the_conjugate():
    one = table()
    assert np.array_equal(one.complex_modulus([-3.0, -0.5]), np.conj(one.complex_modulus([3.0, 0.5])))


@pytest.mark.parametrize("omega", [0.0, 1e-5, 1e9, -1e9, np.inf])
def test_beyond_its_ends_a_table_refuses(omega):
    with refused("outside-table"):
        table().complex_modulus([1.0, omega])


def test_rounding_of_the_ends_is_not_beyond_them():
    one = table()
    assert one.storage_modulus(1e-4 * (1 - 1e-15)) == pytest.approx(one.storage_modulus(1e-4))


def test_ends_taken_for_plateaus_keep_storage_and_lose_loss():
    one = table(extrapolate="plateau")
    low, high = one.complex_modulus(1e-4), one.complex_modulus(1e8)
    assert one.complex_modulus(0.0) == low.real
    assert one.complex_modulus(np.inf) == high.real
    assert one.complex_modulus(1e-6) == pytest.approx(low.real + 0.01j * low.imag, rel=1e-12)
    assert one.complex_modulus(1e10) == pytest.approx(high.real + 0.01j * high.imag, rel=1e-12)
    assert (one.E0, one.E_inf) == (low.real, high.real)
    with refused("outside-table"):
        _ = table().E0
    with refused("not-a-number", naming="angular_frequency"):
        one.complex_modulus(np.nan)


def test_compliance_is_the_reciprocal():
    one = table()
    assert one.compliance([0.1, -2.0]) * one.complex_modulus([0.1, -2.0]) == pytest.approx([1.0, 1.0])


@settings(deadline=None, max_examples=20)
@given(st.floats(-4.0, 4.0), st.floats(0.5, 2.0))
def test_a_shift_moves_frequency_and_scales_modulus(log_alpha, b):
    one, alpha = table(), 10.0**log_alpha
    omega = np.logspace(-3.5, 7.5, 12) / alpha
    assert one.shifted(alpha, b).complex_modulus(omega) == pytest.approx(
        b * one.complex_modulus(alpha * omega), rel=1e-11
    )


def test_units_of_frequency_and_modulus_do_not_matter():
    one = table()
    scaled = ModulusTable(
        1e9 * one.angular_frequency, 1e-6 * one.storage_modulus_values, 1e-6 * one.loss_modulus_values
    )
    omega = np.logspace(-3.9, 7.9, 50)
    assert 1e6 * scaled.complex_modulus(1e9 * omega) == pytest.approx(one.complex_modulus(omega), rel=1e-11)


def master(omega, storage, loss):
    return MasterCurve(omega, storage, loss, np.full(len(omega), 303.15), 303.15)


def test_points_of_a_master_curve_that_lie_together_are_averaged():
    omega = np.array([1.0, 1.0, 1.02, 10.0, 100.0])
    one = ModulusTable.from_master_curve(
        master(omega, np.array([1e6, 4e6, 2e6, 5e6, 6e6]), np.array([1e5, 1e5, 1e5, 2e5, 3e5]))
    )
    assert one.storage_modulus_values == pytest.approx([2e6, 5e6, 6e6])  # (1 · 4 · 2)^(1/3): the geometric mean
    assert one.angular_frequency == pytest.approx([1.02 ** (1 / 3), 10.0, 100.0])
    (note,) = one.notes
    assert (note.code, note.values) == ("points-averaged", {"points": 5, "averaged": 3, "decades": 0.05})


def test_a_dense_master_curve_is_not_averaged_into_one_point():
    omega = np.logspace(-2, 4, 601)  # neighbours 0.01 decade apart: a chain must not run to the end
    one = ModulusTable.from_master_curve(master(omega, RUBBER.storage_modulus(omega), RUBBER.loss_modulus(omega)))
    assert 90 < len(one) < 130
    inside = np.logspace(-1.9, 3.9, 77)
    assert one.storage_modulus(inside) == pytest.approx(RUBBER.storage_modulus(inside), rel=0.01)


def test_without_resolution_only_equal_frequencies_are_averaged():
    omega = np.array([1.0, 1.0, 1.0001, 10.0])
    one = ModulusTable.from_master_curve(master(omega, np.full(4, 1e6), np.full(4, 1e5)), resolution=0.0)
    assert len(one) == 3
    with refused("not-positive", naming="resolution"):
        ModulusTable.from_master_curve(master(omega, np.full(4, 1e6), np.full(4, 1e5)), resolution=-1.0)


@pytest.mark.parametrize(
    ("columns", "code"),
    [
        (([1.0, 2.0], [1e6, 1e6], [1e5]), "wrong-length"),
        (([2.0, 1.0], [1e6, 1e6], [1e5, 1e5]), "not-ascending"),
        (([1.0], [1e6], [1e5]), "not-ascending"),
        (([1.0, 2.0], [1e6, 0.0], [1e5, 1e5]), "not-a-number"),
        (([1.0, 2.0], [1e6, 1e6], [1e5, -1.0]), "not-a-number"),
        (([0.0, 2.0], [1e6, 1e6], [1e5, 1e5]), "not-a-number"),
    ],
)
def test_impossible_tables_are_refused(columns, code):
    with refused(code):
        ModulusTable(*columns)


def test_unknown_extrapolation_is_refused():
    with refused("wrong-choice", naming=("extrapolate", "'refuse'", "'plateau'")):
        table(extrapolate="flat")


def test_densities_of_a_table_are_those_of_its_rubber():
    tau = np.logspace(-6, 2, 9)
    assert table(20).relaxation_density(tau) == pytest.approx(RUBBER.relaxation_density(tau), rel=0.01)
