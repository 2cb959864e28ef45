"""Figures of the dry interface draw what the results hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import viscofric as vf
from viscofric import report
from viscofric.datasets import dataset
from viscofric.friction.coulomb import with_interface
from viscofric.report.figures.interface import parts_figure

LAW = vf.friction.PowerShearStress(
    "0.2 MPa", 0.2, 0.03, shift=vf.Arrhenius("60 kJ/mol", 313.15), covariance=np.diag([1e8, 1e-4, 1e6])
)

PARTS = {
    "friction_coefficient": 0.1,
    "friction_error": 0.03,
    "interface_friction": 0.2,
    "interface_error": 0.04,
    "failed": 0,
}


@pytest.fixture(scope="module")
def contacts():
    speed, kelvin = np.tile(np.geomspace(0.01, 0.1, 4), 2), np.repeat([303.15, 313.15], 4)
    friction = {f"viscoelastic{name}": np.full(8, 0.02) for name in ("", "_error", "_scatter")}
    pressure = {"mean_pressure": np.full(8, 4e5), "mean_pressure_error": np.zeros(8)}
    return vf.FrictionCurves(speed, kelvin, np.full(8, 5.0), **friction, replicates=np.ones(8), **pressure)


def test_stress_is_drawn_at_the_reduced_speed_of_the_first_law(contacts):
    predicted = with_interface(contacts, LAW)
    measured = replace(predicted, coulomb_error=0.02 * predicted.coulomb)
    stress = vf.friction.shear_stress(measured, contacts, shift=LAW.shift)
    axes = Figure().subplots()
    report.plot_shear_stress(axes, stress, [LAW, vf.friction.ConstantShearStress("0.3 MPa")], synthetic=True)
    drawn = np.concatenate([bars.lines[0].get_xdata() for bars in axes.containers])
    reduced = 1e3 * stress.speed * LAW.shift(stress.temperature)
    np.testing.assert_allclose(np.sort(drawn), np.sort(reduced))
    law = next(line for line in axes.lines if len(line.get_xdata()) == 101)
    np.testing.assert_allclose(law.get_ydata(), 1e-6 * LAW(1e-3 * law.get_xdata(), 313.15))
    assert len(axes.collections) == 3  # two sets of bars and one band: the constant law has no errors
    assert "synthetic" in axes.get_legend().get_title().get_text()
    assert "40 °C" in axes.get_xlabel()


def test_a_study_shows_the_parts_at_three_temperatures():
    speed, kelvin = np.array([0.01, 0.1]), 293.15 + 10.0 * np.arange(4)
    numbers = {name: np.full((4, 2), value) for name, value in PARTS.items()}
    cases = dataset(
        ("temperature", "speed"),
        {name: (column, "1", name) for name, column in numbers.items()},
        coordinates={"temperature": (kelvin, "K", "temperature"), "speed": (speed, "m/s", "speed")},
    )
    figure = parts_figure(xr.DataTree.from_dict({"/prediction": cases}))
    assert [axes.get_xlabel().split("at ")[1] for axes in figure.axes] == ["20 °C", "40 °C", "50 °C"]
    for axes in figure.axes:
        (bars,) = axes.containers
        np.testing.assert_allclose(bars.lines[0].get_ydata(), 0.3)
        (upper,) = (segments[0][1][1] for segments in [bars.lines[2][0].get_segments()])
        assert upper == pytest.approx(0.3 + 1.96 * 0.05, rel=1e-4)
    assert parts_figure(xr.DataTree.from_dict({"/prediction": cases.drop_vars("interface_friction")})) is None


def test_parts_are_stacked_to_the_total(contacts):
    both = with_interface(contacts, LAW).at_temperature(313.15)
    axes = Figure().subplots()
    report.plot_friction_parts(axes, both)
    hysteresis, interface = (part.get_paths()[0].get_extents() for part in axes.collections[:2])
    assert (hysteresis.y0, hysteresis.y1) == pytest.approx((0.0, 0.02))
    assert interface.y1 == pytest.approx(both.total.max())
    with pytest.raises(vf.InputError) as refused:
        report.plot_friction_parts(axes, with_interface(contacts, LAW))
    assert refused.value.code == "several-temperatures"
    with pytest.raises(vf.InputError) as refused:
        report.plot_friction_parts(axes, contacts)
    assert refused.value.code == "no-coulomb"


@pytest.mark.parametrize("count", [1, 2])
def test_parts_of_rough_surfaces_are_means_with_the_interval_of_the_total(count):
    asked = {"shape": (32, 32), "spacing": "30 um", "shortest": "160 um", "rms_slope": 0.2}
    tracks = [vf.self_affine(0.8, **asked, seed=seed) for seed in range(count)]
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    law = vf.friction.ConstantShearStress("20 kPa", covariance=[[1e6]])
    found = vf.predict_rough_friction(rubber, tracks, speeds=[0.01, 0.1], pressure="20 kPa", interface=law)
    axes = Figure().subplots()
    report.plot_friction_parts(axes, found)
    (bars,) = axes.containers
    np.testing.assert_allclose(bars.lines[0].get_ydata(), found.total.mean(axis=-1)[0])
    tops = [segment[1][1] for segment in bars.lines[2][0].get_segments()]
    if count == 1:
        upper = (found.total + 1.95996 * np.hypot(found.friction_error, found.interface_error))[0, :, 0]
    else:
        upper = found.interval(of="total")[1][0]
    np.testing.assert_allclose(tops, upper, rtol=1e-4)


def test_parts_of_the_theory_and_of_a_given_coulomb_friction_are_drawn_alike():
    """Anything whose parts have these names, along any dimensions."""
    rubber = vf.synthetic_fluoroelastomer()
    road = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="10 um", rms_slope=0.3)
    asked = {"speeds": [0.1, 0.01], "temperatures": "60 degC"}
    theory = vf.persson_theory(rubber, road, **asked, pressure="0.3 MPa", interface=LAW)
    steel = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
    heating = vf.Heating(rubber=steel, counterface=steel, coulomb=0.3)
    heated = vf.predict_friction(rubber, vf.Cylinder("10 mm"), **asked, load=500.0, heating=heating, accuracy=0.1)
    for found, total, named in ((theory, theory.total[0], "interface"), (heated, heated.total, "Coulomb, given")):
        axes = Figure().subplots()
        report.plot_friction_parts(axes, found)
        (bars,) = axes.containers
        np.testing.assert_allclose(bars.lines[0].get_ydata(), total[::-1])
        assert named in [words.get_text() for words in axes.get_legend().get_texts()]
    halves = 0.5 * np.ptp([segment[:, 1] for segment in bars_of(theory)], axis=1)
    expected = 1.95996 * np.hypot(theory.interface_error, theory.friction_error)[0, ::-1]
    np.testing.assert_allclose(halves, expected, rtol=1e-4)
    both = vf.persson_theory(rubber, road, **asked | {"temperatures": [320.0, 340.0]}, pressure=3e5, interface=LAW)
    with pytest.raises(vf.InputError) as refused:
        report.plot_friction_parts(axes, both)
    assert refused.value.code == "several-temperatures"
    one = both.to_dataset().isel(temperature=1)
    report.plot_friction_parts(axes, one)
    np.testing.assert_allclose(axes.containers[-1].lines[0].get_ydata(), both.total[1, ::-1])


def bars_of(found):
    axes = Figure().subplots()
    report.plot_friction_parts(axes, found)
    return axes.containers[0].lines[2][0].get_segments()
