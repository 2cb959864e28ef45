"""Figures of rough surfaces show what they are given."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric.report.figures import rough as figures
from viscofric.report.figures.saving import save_picture
from viscofric.report.figures.style import new_figure

RUBBER = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
ROAD = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="100 um", rms_slope=0.2)


@pytest.fixture(scope="module")
def road() -> vf.Topography:
    return vf.roughness.surface_from_spectrum(ROAD, shape=(32, 32), spacing=1e-3 / 32, seed=1)


@pytest.fixture(scope="module")
def solution(road: vf.Topography) -> vf.contact.PeriodicSolution:
    return vf.solve_periodic(RUBBER, road.to_surface(), speed="0.1 m/s", pressure="10 kPa")


@pytest.mark.slow
def test_a_surface_and_its_contact_are_drawn_into_a_file(road, solution, tmp_path: Path):
    def both():
        figure = new_figure()
        left, right = figure.subplots(1, 2)
        figures.plot_topography(left, road)
        figures.plot_contact_map(right, solution)
        return figure

    save_picture(tmp_path / "contact.svg", both, name="contact")
    assert (tmp_path / "contact.svg").stat().st_size > 5000


def test_maps_show_heights_in_a_fitting_unit_and_leave_out_what_does_not_touch(road, solution):
    axes = new_figure().subplots()
    mesh, label = figures.plot_topography(axes, road)
    assert label == "height above the mean (µm)"
    np.testing.assert_allclose(mesh.get_array(), 1e6 * (road.heights.T - road.heights.mean()), atol=1e-12)
    mesh, label = figures.plot_contact_map(new_figure().subplots(), solution)
    assert label == "pressure (MPa)"
    assert mesh.get_array().count() == np.count_nonzero(solution.pressure)


def test_a_line_scan_is_a_line():
    axes = new_figure().subplots()
    figures.plot_line_scan(axes, vf.Topography([0.0, 1e-6, 2e-6, np.nan], "1 um"))
    (line,) = axes.lines
    np.testing.assert_allclose(line.get_ydata()[:3], [-1.0, 0.0, 1.0], atol=1e-12)


def test_spectra_and_what_wavelengths_add_are_drawn_as_given(road, solution):
    axes = new_figure().subplots()
    figures.plot_power_spectra(axes, {"made of": ROAD, "measured": vf.roughness.power_spectrum(road)})
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), ROAD.density)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["made of", "measured"]
    axes = new_figure().subplots()
    part = vf.roughness.friction_by_wavelength(solution)
    figures.plot_friction_by_wavelength(axes, {"all": part})
    (steps,) = axes.patches
    areas = steps.get_data().values * np.diff(np.log10(steps.get_data().edges))
    assert areas.sum() == pytest.approx(solution.friction_coefficient, rel=1e-10)


def test_friction_curves_stand_beside_the_theory(road):
    speeds = [0.01, 0.1, 1.0]
    roads = [road, road.inverted()]
    found = vf.predict_rough_friction(RUBBER, roads, speeds=speeds, pressure="10 kPa")
    theory = vf.persson_theory(RUBBER, ROAD, speeds=speeds, pressure="10 kPa")
    axes = new_figure().subplots()
    figures.plot_rough_friction(axes, found, {"Persson": theory})
    solved, beside = axes.lines
    np.testing.assert_array_equal(solved.get_ydata(), found.mean_friction_coefficient[0])
    np.testing.assert_array_equal(beside.get_ydata(), theory.friction_coefficient[0])
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["solved, 2 surfaces", "Persson"]
    axes = new_figure().subplots()
    figures.plot_rough_friction(axes, found, {"Persson": theory}, area=True)
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), found.mean_area[0])
    axes = new_figure().subplots()
    both = {"cold": found, "warm": found}
    figures.plot_rough_friction(axes, both, {"Persson, warm": theory, "Persson, cold": theory})
    cold, warm, warm_theory, cold_theory = axes.lines
    assert warm_theory.get_color() == warm.get_color() != cold.get_color() == cold_theory.get_color()
    assert warm.get_label() == "solved, warm, 2 surfaces"
