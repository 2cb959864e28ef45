"""Results of contacts as labelled data sets."""

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.fields import HighestStress

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")


@pytest.fixture(scope="module")
def contact():
    return vf.solve_steady(RUBBER, vf.Cylinder("10 mm"), speed="1 m/s", load="100 N/m", accuracy=0.1, derivatives=True)


def test_a_contact_has_its_fields_over_x_and_y(contact):
    found = contact.to_dataset()
    assert dict(found.sizes) == {"x": len(contact.x), "y": 1}
    units = {name: found[name].attrs["units"] for name in found.variables if found[name].ndim}
    assert units == {"pressure": "Pa", "displacement": "m", "x": "m", "y": "m"}
    assert found.attrs["friction_coefficient"] == contact.friction_coefficient
    assert found.attrs["direction"] == [1.0, 0.0]


def test_derivatives_lie_along_the_modes(contact):
    found = contact.derivatives.to_dataset()
    assert dict(found.sizes) == {"mode": 1}
    assert found["C"].dims == found["log_tau"].dims == ("mode",)
    assert float(found["log_load"]) == contact.derivatives.logarithmic.load
    assert "load" not in found
    assert found["speed"].attrs["units"] == "s/m"
    assert found.attrs["error"] == contact.derivatives.error
    deep = vf.solve_steady(RUBBER, vf.Ball("10 mm"), speed=1.0, indentation=5e-5, accuracy=0.1, derivatives=True)
    assert float(deep.derivatives.to_dataset()["indentation"]) == deep.derivatives.indentation


def test_a_displacement_has_its_window(contact):
    modes = RUBBER.spectrum
    solid = {"E_inf": modes.E_inf, "C": modes.C, "tau": modes.tau, "poisson_ratio": 0.5}
    surface = vf.contact.surface_displacement(contact.x, contact.y, contact.pressure, speed=1.0, **solid)
    np.testing.assert_array_equal(surface.to_dataset()["displacement"], surface.displacement)


def test_stresses_are_labelled_with_given_coordinates(contact):
    depths = [1e-4, 3e-4]
    stress = vf.contact.line_stress(contact.x, contact.pressure, depths, 0.5)
    found = stress.to_dataset(x=contact.x, depth=depths)
    assert found["von_mises"].dims == ("x", "depth")
    assert found["xx"].attrs == {"units": "Pa", "long_name": "stress xx"}
    for wrong in ({"x": contact.x}, {"depth": depths, "x": contact.x}, {}):
        with pytest.raises(vf.InputError) as refused:
            stress.to_dataset(**wrong)
        assert refused.value.code == "not-on-points"


def test_the_highest_stress_is_four_numbers():
    found = HighestStress(2e5, 1e-4, 0.0, 3e-4).to_dataset()
    assert {name: float(found[name]) for name in found} == {"von_mises": 2e5, "x": 1e-4, "y": 0.0, "depth": 3e-4}


def test_a_contact_has_its_numbers_with_units_and_errors(contact):
    found = contact.to_dataset()
    assert {name: found[name].attrs["units"] for name in ("load", "contact_area", "friction_force", "power")} == {
        "load": "N/m",
        "contact_area": "m",
        "friction_force": "N/m",
        "power": "W/m",
    }
    assert float(found["mean_pressure"]) == pytest.approx(contact.load / contact.contact_area)
    assert found["rear"].attrs["ancillary_variables"] == "edge_error"
    assert float(found["edge_error"]) == contact.diagnostics.edge_error
    assert "temperature" not in found
    fast = vf.solve_steady(RUBBER, vf.Ball("10 mm"), speed=np.inf, load=1.0, accuracy=0.1).numbers
    assert "power" not in fast
    assert fast["load"].attrs["units"] == "N"


def test_a_rough_contact_has_its_numbers_with_units():
    surface = vf.contact.PeriodicSurface(1e-6 * np.cos(2.0 * np.pi * np.arange(16) / 16)[:, None], spacing="10 um")
    solution = vf.solve_periodic(RUBBER, surface, speed=1.0, pressure="0.2 kPa")
    found = solution.to_dataset()
    assert float(found["mean_contact_pressure"]) == pytest.approx(200.0 / solution.contact_area_fraction)
    assert float(found["power"]) == pytest.approx(solution.friction_coefficient * 200.0)
    assert found["power"].attrs["units"] == "W/m**2"
    assert found["friction_coefficient"].attrs["ancillary_variables"] == "friction_error"
