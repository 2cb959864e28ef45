"""Surfaces, spectra and results of rough contacts as labelled data sets."""

import numpy as np
import pytest

import viscofric as vf

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
ROAD = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="50 um", rms_slope=0.1)


@pytest.fixture(scope="module")
def solution():
    road = vf.self_affine(0.8, shape=(32, 32), spacing="20 um", shortest="160 um", rms_slope=0.1, seed=1)
    return vf.solve_periodic(RUBBER, road.to_surface(), speed="0.1 m/s", pressure="5 kPa", tolerance=1e-4)


def test_a_periodic_contact_has_its_fields_over_x_and_y(solution):
    found = solution.to_dataset()
    assert {name for name in found if found[name].ndim} == {"pressure", "displacement", "gap"}
    assert float(found["mean_gap"]) == solution.mean_gap
    assert found["gap"].dims == ("x", "y")
    assert found.attrs["contact_area_fraction"] == solution.contact_area_fraction


def test_friction_by_wavelength_has_both_ends_of_each_band(solution):
    parts = vf.roughness.friction_by_wavelength(solution, [1e-3, 2e-4, 5e-5])
    found = parts.to_dataset()
    assert list(found["longest"]) == [1e-3, 2e-4]
    assert list(found["shortest"]) == [2e-4, 5e-5]
    np.testing.assert_array_equal(found["contribution"], parts.contribution)


def test_statistics_of_a_contact_are_single_numbers(solution):
    statistics = vf.roughness.contact_statistics(solution)
    found = statistics.to_dataset()
    assert not found.sizes
    assert int(found["patches"]) == statistics.patches
    assert found["chord_along"].attrs["units"] == "m"


def test_spectra_have_the_unit_of_their_density():
    found = ROAD.to_dataset()
    np.testing.assert_array_equal(found["density"], ROAD.density)
    assert found["density"].attrs["units"] == "m**4"
    assert found["wave_number"].attrs["units"] == "rad/m"
    line = vf.roughness.LineSpectrum([1e3, 1e4], [1e-14, 1e-16]).to_dataset()
    assert line["density"].attrs["units"] == "m**3"


def test_theory_has_numbers_of_all_scales_and_of_each():
    found = vf.persson_theory(RUBBER, ROAD, speeds=[0.1, 1.0], pressure="1 MPa", accuracy=0.05).to_dataset()
    assert found["friction_coefficient"].dims == ("temperature", "speed")
    assert found["area_by_scale"].dims == ("temperature", "speed", "wave_number")
    assert found["flash_temperature"].attrs["units"] == "K"
    assert set(found.attrs) == {"pressure", "error", "notes", "note_records"}


def test_a_topography_keeps_its_history():
    road = vf.Topography(np.eye(4), "1 um", periodic=True, name="road", history=("made",)).inverted()
    found = road.to_dataset()
    assert found.attrs == {"name": "road", "periodic": 1, "history": "; ".join(road.history)}
    assert found["height"].attrs["units"] == "m"
