"""Sweeps and step tests of one material together: one table of shift factors, one spectrum, levels of kinds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from marks import apart
from refusals import refused
from rheology.planted import planted_steps, planted_sweeps

CELSIUS = np.arange(-10.0, 45.0, 10.0)


def several(seed=1, level=1.0):
    """Sweeps at 10 K, creep tests at 5 K, of the same material."""
    creep, material, reference = planted_steps(seed, 0.01)
    lifted = replace(creep, tests=tuple(replace(one, response=one.response / level) for one in creep.tests))
    return planted_sweeps(seed, 0.01, celsius=CELSIUS).sweeps, lifted, material, reference


def test_kinds_have_one_table_of_factors():
    sweeps, creep, material, reference = several()
    joint = vf.superpose([sweeps, creep], reference)
    factors = joint.shift_factors
    assert len(joint.parts) == 2
    assert len(factors.temperatures) == 12  # all of the creep tests; those of the sweeps are among them
    true = material.shift.at_reference(reference).log10(factors.temperatures)
    errors = factors.standard_errors
    assert np.all(np.abs(factors.log10_values - true)[errors > 1e-9] < 4.0 * errors[errors > 1e-9])
    for alone in joint.alone:  # better than each by itself
        at = factors.standard_error(alone.shift_factors.temperatures)
        assert np.all(at <= 1.02 * alone.shift_factors.standard_errors + 1e-9)
    for part in joint.parts:
        np.testing.assert_allclose(
            part.shift_factors.log10_values, factors.log10(part.shift_factors.temperatures), atol=1e-9
        )
    assert joint.to_dataset().sizes["temperature"] == 12


def test_kinds_leave_out_one_vertical_shift():
    """A rubber has one b(T): it moves α of all kinds together, so that their mean has no less of that error."""
    sweeps, creep, material, reference = several()
    log10_b = vf.rheology.DensityShift(reference).log10
    raised = [
        replace(one, storage_modulus=one.storage_modulus * b, loss_modulus=one.loss_modulus * b)
        for one in sweeps.isotherms
        for b in [10.0 ** log10_b(one.temperature)]
    ]
    softer = [replace(one, response=one.response / 10.0 ** log10_b(one.temperature)) for one in creep.tests]
    both = [replace(sweeps, isotherms=tuple(raised)), replace(creep, tests=tuple(softer))]
    joint = vf.superpose(both, reference)
    first, second = (one.offsets.left_out for one in joint.alone)
    np.testing.assert_array_equal(first.probability, second.probability)
    shared = sum(gain @ one.errors[0] for gain, one in zip(joint.gains, (first, second), strict=True))
    factors = joint.shift_factors
    others = np.linalg.eigvalsh(factors.covariance - np.outer(shared, shared))
    assert others.min() > -1e-9  # rounding; independent errors of both would leave less than their common part
    away = factors.log10_values - material.shift.at_reference(reference).log10(factors.temperatures)
    assert np.all(np.abs(away) <= 3.0 * factors.standard_errors + 1e-9)  # of eleven factors the largest


@pytest.mark.slow
def test_a_level_between_kinds_is_found_and_noted():
    sweeps, creep, material, reference = several(level=1.05)
    joint = vf.superpose([sweeps, creep], reference)
    spectrum = vf.fit_retardation_spectrum(joint)
    notes = {note.code: note for note in spectrum.fit.notes if hasattr(note, "code")}
    assert "kinds-offset" in notes
    assert "5." in notes["kinds-offset"] or "4." in notes["kinds-offset"]  # per cent
    omega = np.geomspace(*spectrum.fit.frequency_range, 30)[2:-2]
    true = material.at(reference).complex_modulus(omega)
    np.testing.assert_allclose(spectrum.complex_modulus(omega).real, true.real, rtol=0.03)
    assert spectrum.fit.rms_step < 0.006
    assert spectrum.fit.rms_storage < 0.006
    sparse = vf.fit_retardation_spectrum(joint, method="sparse", modes=20)
    assert 0 < len(sparse) <= 20
    smooth = vf.fit_retardation_spectrum(joint, method="regularised", regularisation=0.01)
    assert smooth.fit.regularisation == 0.01


@pytest.mark.slow
def test_three_kinds_reach_farther_than_one():
    sweeps, creep, material, reference = several()
    relaxation = planted_steps(7, 0.01, kind="relaxation")[0]
    joint = vf.superpose([sweeps, creep, relaxation], reference)
    spectrum = vf.fit_retardation_spectrum(joint)
    alone = vf.fit_retardation_spectrum(joint.parts[0])
    assert spectrum.fit.frequency_range[0] < 0.1 * alone.fit.frequency_range[0]
    slow = np.array([3.0 * spectrum.fit.frequency_range[0]])
    true = abs(material.at(reference).complex_modulus(slow))
    assert abs(spectrum.complex_modulus(slow)) == pytest.approx(true, rel=0.05)


@pytest.mark.slow
def test_kinds_that_disagree_are_noted_and_have_larger_errors():
    sweeps, creep, _, reference = several()
    kelvin = vf.superpose(creep, reference).shift_factors.reference
    other = tuple(
        replace(one, time=one.time * 10.0 ** (0.02 * (one.temperature - kelvin))) for one in creep.tests
    )  # α of another material
    joint = vf.superpose([sweeps, replace(creep, tests=other)], reference)
    assert "kinds-disagree" in [getattr(note, "code", "") for note in joint.notes]
    assert np.median(joint.shift_factors.standard_errors) > np.median(
        vf.superpose(sweeps, reference).shift_factors.standard_errors
    )


@pytest.mark.slow
@pytest.mark.parametrize("seeds", [4, *apart(8)])
def test_bands_of_several_kinds_contain_what_was_planted(seeds):
    inside: dict[str, list[float]] = {"alpha": [], "storage": []}
    for seed in range(seeds):
        sweeps, creep, material, reference = several(seed, level=1.03)
        joint = vf.superpose([sweeps, creep], reference)
        factors = joint.shift_factors
        known = factors.standard_errors > 1e-9
        away = factors.log10_values - material.shift.at_reference(reference).log10(factors.temperatures)
        inside["alpha"].append(np.mean(np.abs(away[known]) < 1.96 * factors.standard_errors[known]))
        drawn = vf.sample_materials(joint, samples=40, seed=seed)
        omega = np.geomspace(*drawn.frequency_range, 30)
        band, true = drawn.modulus_band(omega), material.at(reference).complex_modulus(omega)
        inside["storage"].append(np.mean((true.real >= band.lower.real) & (true.real <= band.upper.real)))
    for shares in inside.values():  # over 8 seeds the mean differs by 0.04
        assert np.mean(shares) > 0.95 - 0.1 * np.sqrt(8 / seeds)


def test_lists_that_make_no_sense_are_refused():
    sweeps, creep, material, reference = several()
    with refused("no-tests"):
        vf.superpose([], reference)
    with refused("no-free-vertical"):
        vf.superpose([sweeps, creep], reference, vertical="free")
    with refused("not-for-several"):
        vf.superpose([sweeps, creep], reference, shift=material.shift)
    with refused("wrong-type"):
        vf.superpose([sweeps, 3], reference)
