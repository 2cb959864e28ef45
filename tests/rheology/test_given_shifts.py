"""Given shift factors: wrong ones are told of even where all neighbours disagree alike."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from rheology.planted import planted_sweeps, synthetic_polymer
from viscofric.notes import codes
from viscofric.rheology.superposition.overlap import LogSweep, own_shifts

POLYMER = synthetic_polymer()
WLF = POLYMER.shift.at_reference("30 degC")


def with_too_large_a_constant(factor, noise=0.01):
    """Superpose sweeps of the invented polymer with its own WLF law, but C1 multiplied by a factor."""
    sweeps = planted_sweeps(4, noise, material=POLYMER).sweeps
    return vf.superpose(sweeps, "30 degC", shift=vf.WLF(C1=factor * WLF.C1, C2=WLF.C2, reference=WLF.reference))


def reported(notes):
    return [note for note in notes if codes([note]) == {"given-factors-wrong"}]


@pytest.mark.parametrize("factor", [0.6, 1.4])
def test_a_law_that_is_wrong_everywhere_alike_is_reported(factor):
    fit = with_too_large_a_constant(factor)
    [note] = reported(fit.notes)
    assert fit.check.holds  # which no shift along the frequency changes
    first = fit.check.sentences[0]
    assert first.code == "superposition-other-factors"
    found = own_shifts([LogSweep.of(one) for one in fit.isotherms], fit.shift_factors.log10_values)
    # What is left of 1 % at points a pair is at most 0.0043 √2 decades; interpolation takes some of it away.
    assert 0.0043 < found.attainable < 0.0062
    assert found.misfit > 10.0 * found.attainable
    for sentence in (note, first):
        assert f"{found.misfit:.2g} decades" in sentence
        assert f"{found.attainable:.2g}" in sentence


@pytest.mark.parametrize("noise", [0.0, 0.003, 0.03])
def test_the_right_law_is_not_suspected(noise):
    fit = with_too_large_a_constant(1.0, noise)
    assert reported(fit.notes) == []
    assert fit.check.sentences[0].code == "superposition-holds"
    found = own_shifts([LogSweep.of(one) for one in fit.isotherms], fit.shift_factors.log10_values)
    # Each pair by itself gains one of some 50 degrees of freedom, and more where it overlaps little.
    assert found.attainable <= found.misfit < 1.2 * found.attainable + 1e-6


def test_misfits_of_straight_lines_are_those_by_hand():
    """E' and E'' that grow as the frequency does: off by 0.1 decades in the shift is off by 0.1 in both."""
    frequency = np.linspace(0.0, 2.0, 21)
    line = np.stack([frequency, frequency - 1.0], axis=1)
    sweeps = [LogSweep(frequency, line), LogSweep(frequency, line - 1.0)]
    found = own_shifts(sweeps, np.array([1.0 + 0.1, 0.0]) - 2.0)
    assert found.misfit == pytest.approx(0.1, rel=1e-9)
    # Steps of 0.02 decades are tried.
    assert found.attainable < 0.0101


def test_fixed_factors_that_are_wrong_are_reported_and_right_ones_are_not():
    sweeps = planted_sweeps(4, 0.003, material=POLYMER).sweeps
    right = {kelvin: float(WLF.log10(kelvin)) for kelvin in sweeps.temperatures if kelvin != 303.15}
    wrong = {kelvin: 1.4 * value for kelvin, value in right.items()}
    assert reported(vf.superpose(sweeps, "30 degC", fixed=right).notes) == []
    assert len(reported(vf.superpose(sweeps, "30 degC", fixed=wrong).notes)) == 1


def test_a_failure_of_superposition_and_wrong_factors_are_both_reported():
    """E'' 40 % larger in every other sweep, and C1 too large."""
    made = planted_sweeps(4, 0.003, material=POLYMER).sweeps
    sweeps = [
        vf.data.Isotherm(
            one.temperature, one.angular_frequency, one.storage_modulus, 1.4 ** (place % 2) * one.loss_modulus
        )
        for place, one in enumerate(made.isotherms)
    ]
    values = 3.0 * np.asarray(WLF.log10(made.temperatures))
    given = vf.ShiftFactors(made.temperatures, values, "30 degC")
    check = vf.superpose(vf.data.IsothermalSweeps(tuple(sweeps)), "30 degC", shift=given).check
    assert check.verdict == "fails"
    assert len(check.sentences) >= 2  # superposition, and the factors
