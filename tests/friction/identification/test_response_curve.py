"""Friction at many speeds read from contacts at few."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.reference import hunter_line
from viscofric.errors import InputError
from viscofric.friction.identification import response_curve
from viscofric.friction.identification.response import FrictionResponse, friction_response
from viscofric.friction.identification.response_curve import friction_curve_response

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

BALL, CYLINDER = vf.Ball(radius=10e-3), vf.Cylinder(radius=10e-3)
LOOSE = 5e-3
DERIVATIVES = ("log_C", "log_E_inf", "log_speed", "log_load")


def rubber() -> vf.RetardationSpectrum:
    """Four modes, one of which stands apart."""
    C = np.array([1.0, 2.0, 4.0, 3.0]) * (1e-6 - 1e-8) / 10.0
    return vf.RetardationSpectrum(1e6, 1e8, C, [1e-7, 1e-4, 1e-3, 3e-3])


@pytest.mark.parametrize("interpolation", [1e-2, 1e-3])
def test_sharpest_curve_is_read_as_exactly_as_asked_for(interpolation: float, monkeypatch: pytest.MonkeyPatch) -> None:
    E_inf = 1e7
    spectrum = vf.RetardationSpectrum(1e6, E_inf, [1e-6 - 1.0 / E_inf], [1e-3])

    def exact(*_: object, **__: object) -> FrictionResponse:
        speeds = np.asarray(_[3], dtype=float)
        found = [hunter_line(100.0, 10e-3, 1e6, E_inf, 1e-3, v, 0.5).friction_coefficient for v in speeds]
        none = np.zeros(len(speeds))
        rows = np.zeros((len(speeds), 1))
        return FrictionResponse(speeds, none + 100.0, np.array(found), none, rows, rows, none, none, none)

    monkeypatch.setattr(response_curve, "friction_response", exact)
    # About the peak, where the curve bends most.
    speeds = np.geomspace(0.3, 6.1, 9)
    found = friction_curve_response(spectrum, 0.5, CYLINDER, speeds, 100.0, interpolation=interpolation)
    wanted = exact(None, None, None, speeds).friction
    error = np.abs(found.response.friction - wanted).max()
    assert error <= interpolation * wanted.max()
    # Where another kernel reads something else, more is claimed than is aimed at.
    assert error <= found.interpolation_error.max() <= 2.0 * interpolation * wanted.max()


@pytest.fixture(scope="module")
def curve() -> response_curve.CurveResponse:
    return friction_curve_response(rubber(), 0.5, BALL, [0.05, 0.2, 0.5], [1.0, 1.0, 3.0], accuracy=LOOSE)


def test_curve_is_that_of_the_contacts(curve: response_curve.CurveResponse) -> None:
    found = curve.response
    wanted = friction_response(rubber(), 0.5, BALL, [0.05, 0.2, 0.5], [1.0, 1.0, 3.0])
    assert np.array_equal(found.speed, wanted.speed)
    assert np.array_equal(found.load, wanted.load)
    assert np.all(np.abs(found.friction - wanted.friction) <= found.error + wanted.error)
    size = np.abs(wanted.log_C).max()
    for name in DERIVATIVES:
        # Derivatives on the coarser grids are right to 1e-2 of the largest, and so is their interpolation.
        assert np.abs(getattr(found, name) - getattr(wanted, name)).max() <= 0.02 * size


def test_derivatives_are_those_of_what_is_read(curve: response_curve.CurveResponse) -> None:
    assert curve.response.friction == pytest.approx(curve.matrix @ curve.nodes.friction, rel=1e-12)
    for name in DERIVATIVES:
        values = curve.matrix @ getattr(curve.nodes, name)
        assert getattr(curve.response, name) == pytest.approx(values, rel=1e-9, abs=1e-15)
    # With the load, friction and its derivatives grow by the contact's size, F^(1/3).
    assert len(curve.nodes.speed) < 3 * 6


@pytest.mark.slow
def test_loads_on_a_layer_have_a_curve_each() -> None:
    layer = vf.Layer(thickness=5e-3)
    found = friction_curve_response(
        rubber(), 0.5, BALL, [0.2, 0.21], [1.0, 3.0], accuracy=LOOSE, interpolation=0.02, layer=layer
    )
    assert set(found.nodes.load) == {1.0, 3.0}
    assert np.all(found.matrix[0][found.nodes.load == 3.0] == 0.0)
    wanted = friction_response(rubber(), 0.5, BALL, [0.2, 0.21], [1.0, 3.0], accuracy=LOOSE, layer=layer)
    assert np.all(np.abs(found.response.friction - wanted.friction) <= 0.02 * wanted.friction.max())


def test_nodes_stay_where_they_are_as_speeds_move_a_little(curve: response_curve.CurveResponse) -> None:
    moved = friction_curve_response(rubber(), 0.5, BALL, [0.0501, 0.2004, 0.501], [1.0, 1.0, 3.0], accuracy=LOOSE)
    assert np.array_equal(moved.nodes.speed, curve.nodes.speed)
    step = np.log(0.0501 / 0.05)
    apart = moved.response.friction - curve.response.friction
    # Errors of what is read, times the largest wavenumber that 5 nodes to a decade tell apart.
    error = curve.nodes.error.max() + curve.interpolation_error.max()
    near = np.pi * 5.0 / np.log(10.0) * error
    slope = 0.5 * (curve.response.log_speed + moved.response.log_speed)
    assert near <= 0.1 * np.abs(slope).max()
    assert apart / step == pytest.approx(slope, abs=near)


def test_bad_input_is_refused() -> None:
    with pytest.raises(InputError, match=r"interpolation = 0\.0: must be"):
        friction_curve_response(rubber(), 0.5, BALL, 1.0, 1.0, interpolation=0.0)
