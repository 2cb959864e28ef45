"""Retardation modes that stand for a table of moduli, in the modulus and in the friction of a free contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.notes import codes
from viscofric.rheology.spectra.modulus_table import CLOSE, ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum

SHARP = RetardationSpectrum(1e6, 2e7, [0.95e-6], [1.37e-3])
THREE = RetardationSpectrum(1.0 / (9.0e-7 + 1e-9), 1e9, [3e-7, 2e-7, 4e-7], [1.2e-5, 0.9e-3, 0.05])


def table(spectrum: RetardationSpectrum, low: float, high: float, per_decade: int = 8, **options: str) -> ModulusTable:
    omega = np.logspace(low, high, round((high - low) * per_decade) + 1)
    return ModulusTable(omega, spectrum.storage_modulus(omega), spectrum.loss_modulus(omega), **options)  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spectrum", "low", "high"),
    [(SHARP, -1, 7), (THREE, -2, 9), (vf.synthetic_fluoroelastomer().spectrum, -11, 12)],
    ids=["one mode", "three modes", "synthetic"],
)
def test_a_table_rubs_like_the_spectrum_that_it_was_made_from(
    spectrum: RetardationSpectrum, low: float, high: float
) -> None:
    material = vf.Material(table(spectrum, low, high))
    # Times between two of the finest lattice are met to 2e-4 (`modulus_table.RATIOS`).
    omega = np.logspace(low, high, 97)
    assert material.modes_at().complex_modulus(omega) == pytest.approx(spectrum.complex_modulus(omega), rel=1e-3)
    for speed in (0.01, 1.0):
        exact, found = (
            vf.solve_steady(one, vf.Cylinder(radius=10e-3), speed=speed, load=100.0, accuracy=1e-2)
            for one in (vf.Material(spectrum), material)
        )
        assert found.friction_coefficient == pytest.approx(exact.friction_coefficient, rel=1e-3)
        assert "modes-fitted" in codes(found.warnings)
        assert "modes-fitted" not in codes(exact.warnings)


def test_modes_are_fitted_once_and_move_with_the_temperature() -> None:
    law = vf.WLF(10.0, 100.0, 300.0)
    material = vf.Material(table(SHARP, -1, 7), shift=law)
    here, there = material.modes_at(), material.modes_at(330.0)
    assert material.modes_at(300.0) is here
    assert there.tau == pytest.approx(float(law(330.0)) * here.tau)
    assert material.at(330.0).complex_modulus(1e5) == pytest.approx(there.complex_modulus(1e5), rel=1e-2)


def test_what_stands_for_the_table_is_reported_with_its_error() -> None:
    material = vf.Material(table(SHARP, -1, 7))
    fit = material.modes_at().fit
    assert fit is not None
    first = material.notes_on_modes[0]
    assert f"{fit.modes} retardation modes" in first
    assert f"{fit.rms_loss:.2g} of E''" in first
    assert vf.Material(SHARP).notes_on_modes == ()
    cut = vf.Material(table(SHARP, 1, 7)).notes_on_modes
    assert vf.Material(table(SHARP, 3, 4)).notes_on_modes[1:] != ()  # neither plateau was measured
    assert len(cut) >= 1


def test_plateaus_that_a_table_claims_are_those_of_its_modes() -> None:
    omega = np.logspace(0, 5, 41)
    claimed = ModulusTable(omega, SHARP.storage_modulus(omega), SHARP.loss_modulus(omega), extrapolate="plateau")
    modes = vf.Material(claimed).modes_at()
    # What lies beyond the table holds another modulus there than the one mode has: E' is off by 1 % at its ends.
    assert (modes.E0, modes.E_inf) == pytest.approx((claimed.E0, claimed.E_inf), rel=0.02)


def test_noise_is_allowed_up_to_a_bound() -> None:
    clean = table(THREE, -2, 9)
    rng = np.random.default_rng(5)

    def noisy(decades: float) -> vf.Material:
        storage, loss = (
            values * 10.0 ** (decades * rng.standard_normal(len(clean)))
            for values in (clean.storage_modulus_values, clean.loss_modulus_values)
        )
        return vf.Material(ModulusTable(clean.angular_frequency, storage, loss))

    fit = noisy(0.01).modes_at().fit
    assert fit is not None
    assert CLOSE < math.hypot(fit.rms_storage, fit.rms_loss) / math.sqrt(2.0) < 0.012
    with refused("no-modes"):
        noisy(0.1).modes_at()


def test_tables_that_no_solid_has_are_refused() -> None:
    omega = np.logspace(-2, 4, 73)
    ones, flow = np.ones_like(omega), 1j * omega / (1.0 + 1j * omega)
    flat = vf.Material(ModulusTable(omega, 1e6 * ones, 1e6 * ones))  # lossy, but no stiffer when faster
    with refused("no-modes"):
        flat.modes_at()
    liquid = vf.Material(ModulusTable(omega, 1e6 * flow.real, 1e6 * flow.imag))
    with refused("liquid"):
        liquid.modes_at()


def beyond(solution: vf.contact.ContactSolution) -> list[dict[str, float]]:
    """Return the frequencies of the notes that a contact lies beyond its table."""
    return [note.values for note in solution.warnings if note.code == "beyond-measured"]


def test_a_contact_faster_than_its_table_is_reported() -> None:
    material = vf.Material(table(SHARP, -1, 2))

    def frequencies(speed: float, material: vf.Material = material) -> list[dict[str, float]]:
        solution = vf.solve_steady(material, vf.Cylinder(radius=10e-3), speed=speed, load=100.0, accuracy=0.1)
        return beyond(solution)

    # The contact is about 0.4 mm long to either side: v/a of 25, 2500 and 0.025 rad/s.
    assert frequencies(0.01) == []
    (fast,) = frequencies(1.0)
    assert (fast["low"], fast["high"]) == pytest.approx((0.1, 100.0))
    assert fast["lowest"] > fast["high"]
    (slow,) = frequencies(1e-5)
    assert slow["highest"] < slow["low"]
    assert frequencies(0.0) == []  # the elastic limits have no frequency
    # Where the user knows that nothing relaxes out there, nothing is extrapolated.
    assert frequencies(1e-6, vf.Material(table(SHARP, 0, 5))) != []
    assert frequencies(1e-6, vf.Material(table(SHARP, 0, 5, extrapolate="plateau"))) == []
    # Ten times warmer in frequency, the table reaches ten times farther.
    law = vf.WLF(10.0, 100.0, 300.0)
    hot = next(T for T in np.arange(300.0, 340.0) if float(law(T)) < 0.01)
    warm = vf.solve_steady(
        vf.Material(table(SHARP, -1, 2), shift=law),
        vf.Cylinder(radius=10e-3),
        speed=1.0,
        load=100.0,
        temperature=float(hot),
        accuracy=0.1,
    )
    assert beyond(warm) == []
