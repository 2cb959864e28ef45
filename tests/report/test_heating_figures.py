"""Figures of contacts that heat themselves draw what the results hold: both states, and the parts of the rise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import viscofric as vf
from viscofric import report
from viscofric.report.figures.heating import heated_parts_figure, temperature_map_figure

SPEED = np.array([0.1, 0.01, 1.0])  # not in order
COLD, HOT = np.array([0.3, 0.2, 0.1]), np.array([0.25, 0.2, 0.1])


@pytest.fixture(scope="module")
def curves() -> vf.friction.HeatedFrictionCurves:
    rise, none = np.array([20.0, 2.0, 50.0]), np.zeros(3)
    heat = {"temperature_rise": rise, "coulomb_rise": 0.75 * rise, "loss_rise": 0.25 * rise, "track_rise": none}
    states = {"cold_friction": COLD, "cold_rise": rise, "hot_friction": HOT, "hot_rise": rise + 10.0}
    return vf.friction.HeatedFrictionCurves(
        SPEED, np.full(3, 303.15), np.full(3, 5.0), COLD, none, none, np.ones(3), source="predicted",
        isothermal_friction=1.1 * COLD, face_rise=1.001 * rise, loss_weighted_rise=0.1 * rise, skin=none,
        temperature_rise_error=0.1 * rise, **heat, **states,
    )  # fmt: skip


def lines(axes):
    return {line.get_label(): line for line in axes.lines}


def test_both_states_stand_beside_the_isothermal_curve(curves):
    axes = Figure().subplots()
    report.plot_heated_friction(axes, curves)
    drawn = lines(axes)
    np.testing.assert_allclose(drawn["isothermal"].get_xdata(), [10.0, 100.0, 1000.0])
    np.testing.assert_allclose(drawn["heated, speed rising"].get_ydata(), COLD[[1, 0, 2]])
    np.testing.assert_allclose(drawn["heated, speed falling"].get_ydata(), HOT[[1, 0, 2]])
    shaded = axes.collections[0].get_paths()[0].vertices
    assert {0.25, 0.3} <= set(np.round(shaded[:, 1], 6))


def test_one_state_is_drawn_once(curves):
    axes = Figure().subplots()
    report.plot_heated_friction(axes, replace(curves, hot_friction=COLD))
    assert set(lines(axes)) == {"isothermal", "heated"}


def test_parts_of_the_rise_that_are_nothing_or_the_rise_itself_are_not_drawn(curves):
    axes = Figure().subplots()
    report.plot_temperature_rise(axes, curves)
    drawn = lines(axes)
    assert len(drawn) == 4  # the rise, which is that of the face, its two parts, and the rise below
    (whole,) = (line for words, line in drawn.items() if words.endswith("of the face"))
    np.testing.assert_allclose(whole.get_ydata(), [2.0, 20.0, 50.0])
    np.testing.assert_allclose(drawn["by Coulomb friction"].get_ydata(), [1.5, 15.0, 37.5])


def test_curves_without_heat_or_of_two_temperatures_are_refused(curves):
    axes = Figure().subplots()
    with pytest.raises(vf.InputError) as refused:
        report.plot_temperature_rise(axes, replace(curves, temperature=np.array([300.0, 300.0, 320.0])))
    assert refused.value.code == "several-temperatures"
    plain = vf.FrictionCurves(SPEED, np.full(3, 300.0), np.full(3, 5.0), COLD, COLD, COLD, np.ones(3))
    with pytest.raises(vf.InputError) as refused:
        report.plot_heated_friction(axes, plain)
    assert refused.value.code == "no-heating"


def test_results_without_heat_have_no_figures_of_it():
    assert heated_parts_figure(xr.DataTree()) is None
    assert temperature_map_figure(xr.DataTree()) is None
