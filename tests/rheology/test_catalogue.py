"""The catalogue: every number traced to what its source prints, every synthetic thing called so."""

from __future__ import annotations

import numpy as np
import pytest

from refusals import refused
from viscofric.rheology.catalogue import catalogue, catalogue_material, synthetic_fluoroelastomer


def test_every_entry_says_what_it_is_and_makes_a_material():
    names = [entry.name for entry in catalogue()]
    assert len(set(names)) == len(names)
    for entry in catalogue():
        assert entry.kind in ("published", "SYNTHETIC")
        assert entry.holds
        assert entry.remarks
        assert entry.kind == "SYNTHETIC" or any(f"({year})" in entry.citation for year in range(1940, 2027))
        assert catalogue_material(entry.name).citation == (entry.citation if entry.kind == "published" else "")
        modulus = catalogue_material(entry.name).complex_modulus(np.logspace(-6, 6, 25))
        assert np.all(np.diff(modulus.real) > 0)


def test_what_is_synthetic_is_called_so():
    kinds = {entry.name: entry.kind for entry in catalogue()}
    assert kinds["synthetic fluoroelastomer"] == "SYNTHETIC"
    assert all("synthetic" in name for name, kind in kinds.items() if kind == "SYNTHETIC")
    same = catalogue_material("synthetic fluoroelastomer").spectrum
    assert np.array_equal(same.C, synthetic_fluoroelastomer().spectrum.C)


def test_vhb_4910_has_the_moduli_of_its_source():
    rubber = catalogue_material("VHB 4910")
    # Wang et al. print in kPa: equilibrium 15.36, branches 26.06, 26.53, 10.83 at 0.6074, 6.56, 61.25 s (shear).
    # Arruda-Boyce, locking stretch 5.99: z² = 1/35.8801 = 0.0278706, and the small-strain factor of Cohen's
    # approximation is (3 - z²)/(3 (1 - z²)) = 2.9721294/2.9163882 = 1.019113; 15.36 · 1.019113 = 15.65358 by hand.
    prony = rubber.spectrum.to_relaxation()
    assert pytest.approx(15.65358e3, rel=1e-6) == prony.E0 / 3  # six digits by hand
    assert pytest.approx([26.06e3, 26.53e3, 10.83e3], rel=1e-12) == prony.E / 3
    assert prony.tau == pytest.approx([0.6074, 6.56, 61.25], rel=1e-12)
    assert rubber.spectrum.E_inf / 3 == pytest.approx(79.07358e3, rel=1e-6)  # their sum, by hand
    # E' at 1 rad/s by hand: 3 (15.6536 + 26.06·0.2695 + 26.53·0.97729 + 10.83·0.99973) = 3 · 59.431 kPa
    assert rubber.complex_modulus(1.0).real == pytest.approx(3 * 59.431e3, rel=1e-4)


def test_the_chain_law_of_vhb_4910_is_close_to_the_exact_langevin_function():
    # Inverse Langevin series β = 3z + 9/5 z³ + 297/175 z⁵ + 1539/875 z⁷: at 1/5.99 the next term is below 1e-7.
    z2 = 1 / 5.99**2
    exact = 15.36e3 * (1 + 3 / 5 * z2 + 99 / 175 * z2**2 + 513 / 875 * z2**3)
    equilibrium = catalogue_material("VHB 4910").spectrum.E0 / 3
    # Cohen's approximation has 2/3 where the series has 3/5: 0.0667 z² = 0.0019 too stiff, and no more.
    assert equilibrium / exact - 1 == pytest.approx(0.0019, abs=1e-4)


def test_pvb_has_the_series_of_its_source():
    rubber = catalogue_material("PVB interlayer")
    prony = rubber.spectrum.to_relaxation()
    # Eleven relative moduli that sum to 0.9998652, by hand; G0 = 471 MPa, E = 3G.
    assert len(prony) == 11
    assert pytest.approx(3 * 471e6 * (1 - 0.9998652), rel=1e-3) == prony.E0
    assert prony.E_inf == pytest.approx(3 * 471e6, rel=1e-12)
    assert prony.E[2] == pytest.approx(3 * 471e6 * 0.2912, rel=1e-12)
    assert prony.tau[[0, -1]] == pytest.approx([3.2557e-11, 41347000.0], rel=1e-12)
    # WLF by hand at 50 °C: −20.7 · 30 / (91.1 + 30)
    assert rubber.shift.log10("50 degC") == pytest.approx(-5.1280, abs=1e-4)


@pytest.mark.parametrize("name", ["vhb 4910", "VHB-4910", "Vhb_4910"])
def test_capitals_and_hyphens_do_not_matter(name):
    assert catalogue_material(name).name == "VHB 4910 acrylic elastomer"


def test_a_name_unlike_any_is_refused():
    with refused("unknown-material"):
        catalogue_material("xyz")
