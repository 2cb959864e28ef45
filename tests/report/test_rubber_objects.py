"""Figures drawn from the objects of the Python interface show their numbers, with units, sane ticks and no warning."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import matplotlib
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

import viscofric as vf
from refusals import refused
from rheology.planted import planted_sweeps
from viscofric.data import IsothermalSweeps
from viscofric.datasets import dataset
from viscofric.errors import InputError
from viscofric.report.data import moduli_of_sweeps
from viscofric.report.figures import rubber, shift_factors, style, superposition
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShiftFactors
from viscofric.rheology.superposition.result import check_superposition

REFERENCE = 303.15
LEVEL_95 = 1.959963984540054


def made_sweeps(celsius: Any = (10.0, 20.0, 30.0, 40.0, 50.0, 60.0), deformation: Any = "tension") -> IsothermalSweeps:
    """Sweeps of the synthetic fluoroelastomer without noise."""
    made = planted_sweeps(0, 0.0, celsius=celsius, frequencies=np.geomspace(0.1, 10.0, 9))
    return replace(made.sweeps, deformation=deformation)


@pytest.fixture(scope="module")
def fit() -> vf.rheology.Superposition:
    return vf.superpose(made_sweeps(), REFERENCE)


@pytest.fixture(scope="module")
def spectrum(fit: vf.rheology.Superposition) -> vf.RetardationSpectrum:
    return vf.fit_retardation_spectrum(fit.master_curve)


@pytest.fixture
def axes() -> Iterator[Axes]:
    """Axes one column wide; whatever is drawn on them must draw without a warning."""
    sizes = {"font.size": 7.5, "axes.labelsize": 8.0, "legend.fontsize": 7.0, "legend.handlelength": 1.6}
    with matplotlib.rc_context({**style.STYLE, **sizes}):
        figure = style.new_figure(85 / 25.4, 70 / 25.4)
        yield figure.subplots()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            figure.canvas.draw()


def labels_of(axis: Any) -> list[str]:
    axis.figure.canvas.draw()
    low, high = sorted(axis.get_view_interval())
    ticks = zip(axis.get_majorticklocs(), axis.get_majorticklabels(), strict=True)
    return [label.get_text() for place, label in ticks if low <= place <= high and label.get_text()]


def bands(axes: Axes) -> list[PolyCollection]:
    return [each for each in axes.collections if isinstance(each, PolyCollection)]


def heights_at(band: PolyCollection, x: float) -> tuple[float, float]:
    """Lower and upper end of a filled band at one of its own abscissae."""
    (path,) = band.get_paths()
    found = path.vertices[np.isclose(path.vertices[:, 0], x, rtol=1e-9), 1]
    return float(found.min()), float(found.max())


def overlaps_data(axes: Axes) -> bool:
    axes.figure.canvas.draw()
    legend = axes.get_legend()
    return legend is not None and legend.get_window_extent().overlaps(axes.get_window_extent().padded(-2))


def test_sweeps_as_read_are_drawn_in_their_own_modulus(axes: Axes) -> None:
    sweeps = made_sweeps(deformation="shear")
    scale = rubber.plot_isotherms(axes, sweeps, "loss")
    assert axes.get_ylabel() == "loss modulus $G''$ (MPa)"
    assert axes.get_xlabel() == r"angular frequency $\omega$ (rad/s)"
    assert len(axes.lines) == 6
    assert [str(line.get_label()) for line in axes.lines][::5] == ["10 °C", "60 °C"]
    np.testing.assert_allclose(axes.lines[2].get_ydata(), sweeps.isotherms[2].loss_modulus / 1e6)
    assert scale.get_clim() == pytest.approx((10.0, 60.0))
    with refused("wrong-choice"):
        rubber.plot_isotherms(axes, sweeps, "tangent")


def test_isotherms_that_were_joined_are_drawn_as_tensile(axes: Axes, fit: vf.rheology.Superposition) -> None:
    rubber.plot_isotherms(axes, fit)
    assert "$E'$" in axes.get_ylabel()
    np.testing.assert_allclose(axes.lines[0].get_ydata(), fit.isotherms[0].storage_modulus / 1e6)


@pytest.mark.parametrize("draw", [rubber.plot_isotherms, superposition.plot_wicket])
def test_one_isotherm_has_a_colour_bar_and_readable_axes(axes: Axes, draw: Any) -> None:
    scale = draw(axes, made_sweeps([20.0]))
    low, high = scale.get_clim()
    assert low < 20.0 < high
    assert len(axes.lines) == 1
    style.temperature_bar(axes.figure, scale, [axes])
    assert 2 <= len(labels_of(axes.xaxis)) <= 8
    assert 2 <= len(labels_of(axes.yaxis)) <= 8


@pytest.mark.parametrize(
    "draw",
    [
        rubber.plot_isotherms,
        superposition.plot_wicket,
        superposition.plot_cole_cole,
        superposition.plot_van_gurp_palmen,
    ],
)
def test_no_isotherm_at_all_gives_empty_axes(axes: Axes, draw: Any) -> None:
    draw(axes, IsothermalSweeps(()))
    assert not axes.lines


def test_consistency_plots_leave_frequency_out(axes: Axes) -> None:
    sweeps = made_sweeps()
    modulus = vf.synthetic_fluoroelastomer().complex_modulus(sweeps.isotherms[3].angular_frequency, 313.15)
    for draw, x, y in (
        (superposition.plot_wicket, modulus.real / 1e6, modulus.imag / modulus.real),
        (superposition.plot_cole_cole, modulus.real / 1e6, modulus.imag / 1e6),
        (superposition.plot_van_gurp_palmen, abs(modulus) / 1e6, np.angle(modulus, deg=True)),
    ):
        axes.clear()
        draw(axes, sweeps)
        np.testing.assert_allclose(axes.lines[3].get_xdata(), x)
        np.testing.assert_allclose(axes.lines[3].get_ydata(), y)
        assert "(MPa)" in axes.get_xlabel()
        assert axes.get_xscale() == "log"
    assert axes.get_ylabel() == r"loss angle $\delta$ (°)"
    assert axes.get_yscale() == "linear"


def test_check_is_drawn_without_its_vertical_shift(axes: Axes) -> None:
    sweeps = made_sweeps()
    fit = vf.superpose(sweeps, REFERENCE, vertical="density")
    check = check_superposition(fit)
    superposition.plot_booij_thoone_palmen(axes, check)
    assert len(axes.lines) == 6
    coldest = fit.isotherms[0]
    magnitude = np.hypot(coldest.storage_modulus, coldest.loss_modulus) / fit.vertical_shift(coldest.temperature) / 1e6
    np.testing.assert_allclose(axes.lines[0].get_xdata(), magnitude)
    np.testing.assert_allclose(axes.lines[0].get_ydata(), coldest.loss_modulus / coldest.storage_modulus)
    assert axes.get_xlabel() == "modulus $|E^*|$ (MPa)"


def test_causality_is_drawn_as_decades_with_the_ends_left_open(axes: Axes, fit: vf.rheology.Superposition) -> None:
    agreement = check_superposition(fit).kramers_kronig
    superposition.plot_kramers_kronig(axes, agreement)
    inner, ends = axes.lines[:2]
    np.testing.assert_allclose(inner.get_ydata(), agreement.storage_deviation[agreement.judged])
    np.testing.assert_allclose(ends.get_xdata(), agreement.angular_frequency[~agreement.judged])
    assert inner.get_fillstyle() == "full"
    assert ends.get_fillstyle() == "none"
    assert "(rad/s)" in axes.get_xlabel()
    assert not overlaps_data(axes)


def test_master_curve_and_spectrum_are_drawn_with_room_for_both(
    axes: Axes, fit: vf.rheology.Superposition, spectrum: vf.RetardationSpectrum
) -> None:
    rubber.plot_master_curve(axes, fit, spectrum)
    shown = {str(line.get_label()): line for line in axes.lines}
    np.testing.assert_allclose(shown["$E'$ measured"].get_ydata(), fit.master_curve.storage_modulus / 1e6)
    line = np.asarray(shown["$E''$ fitted"].get_xdata())
    np.testing.assert_allclose(shown["$E''$ fitted"].get_ydata(), spectrum.loss_modulus(line) / 1e6)
    assert line[0] < fit.master_curve.angular_frequency[0]
    assert line[-1] > fit.master_curve.angular_frequency[-1]
    assert axes.get_xlabel().endswith("(rad/s) at 30 °C")
    assert not overlaps_data(axes)


def test_master_curve_without_a_spectrum_shows_points_only(axes: Axes, fit: vf.rheology.Superposition) -> None:
    rubber.plot_master_curve(axes, fit.master_curve)
    assert [str(line.get_label()) for line in axes.lines] == ["$E'$ measured", "$E''$ measured"]


def test_band_of_moduli_is_filled_between_its_bounds(axes: Axes, fit: vf.rheology.Superposition) -> None:
    omega = np.geomspace(1.0, 100.0, 5)
    limits = {"storage_modulus_lower": 2e6, "storage_modulus_upper": 3e6}
    limits |= {"loss_modulus_lower": 1e5, "loss_modulus_upper": 4e5}
    columns = {name: (np.full(5, limit), "Pa", name) for name, limit in limits.items()}
    coordinates = {"angular_frequency": (omega, "rad/s", "angular frequency")}
    band = dataset("angular_frequency", columns, coordinates=coordinates)
    rubber.plot_master_curve(axes, fit, band=band)
    storage, loss = bands(axes)
    assert heights_at(storage, 1.0) == pytest.approx((2.0, 3.0))
    assert heights_at(loss, 100.0) == pytest.approx((0.1, 0.4))
    assert not overlaps_data(axes)


def test_samples_give_the_band_that_they_state(axes: Axes, fit: vf.rheology.Superposition, spectrum: Any) -> None:
    from viscofric.rheology.uncertainty.sampling import sample_materials

    samples = sample_materials(fit, spectrum, samples=20)
    rubber.plot_master_curve(axes, fit, spectrum, band=samples)
    omega = np.asarray(axes.lines[1].get_xdata())
    stated = samples.modulus_band(omega)
    storage, loss = bands(axes)
    for place in (0, 150, -1):
        ends = (stated.lower[place].real / 1e6, stated.upper[place].real / 1e6)
        assert heights_at(storage, omega[place]) == pytest.approx(ends)
        ends = (stated.lower[place].imag / 1e6, stated.upper[place].imag / 1e6)
        assert heights_at(loss, omega[place]) == pytest.approx(ends)


def test_a_band_beyond_the_points_lies_on_grey(axes: Axes, fit: vf.rheology.Superposition, spectrum: Any) -> None:
    rubber.plot_master_curve(axes, fit, spectrum)
    assert not axes.patches
    ends = {
        f"{one}_modulus_{end}": (np.ones(3), "Pa", end) for one in ("storage", "loss") for end in ("lower", "upper")
    }
    omega = (np.array([1e-9, 1e-2, 1e12]), "rad/s", "angular frequency")
    rubber.plot_master_curve(
        axes, fit, spectrum, band=dataset("angular_frequency", ends, coordinates={"angular_frequency": omega})
    )
    left, right = (patch.get_extents().transformed(axes.transData.inverted()) for patch in axes.patches)
    assert left.x1 == pytest.approx(fit.master_curve.angular_frequency[0], rel=1e-6)
    assert right.x0 == pytest.approx(fit.master_curve.angular_frequency[-1], rel=1e-6)


def test_residuals_need_a_fit(axes: Axes, fit: vf.rheology.Superposition) -> None:
    with pytest.raises(InputError) as caught:
        rubber.plot_residuals(axes, fit)
    assert caught.value.code == "no-fit"


def test_residuals_are_decades_of_measured_over_fit(axes: Axes, fit: vf.rheology.Superposition, spectrum: Any) -> None:
    rubber.plot_residuals(axes, fit, spectrum)
    curve = fit.master_curve
    storage, loss = axes.lines[:2]
    omega = curve.angular_frequency
    np.testing.assert_allclose(storage.get_ydata(), np.log10(curve.storage_modulus / spectrum.storage_modulus(omega)))
    np.testing.assert_allclose(loss.get_ydata(), np.log10(curve.loss_modulus / spectrum.loss_modulus(omega)))
    low, high = axes.get_ylim()
    assert low == -high
    assert np.max(np.abs(np.asarray(loss.get_ydata()))) < high
    assert not overlaps_data(axes)


def test_law_is_drawn_with_its_stated_uncertainty(axes: Axes, fit: vf.rheology.Superposition) -> None:
    law = fit.shift_factors.law("wlf")
    shift_factors.plot_shift_factors(axes, fit, "wlf")
    (line,) = [line for line in axes.lines if str(line.get_label()).startswith("WLF")]
    warm = np.asarray(line.get_xdata())
    np.testing.assert_allclose(np.log10(line.get_ydata()), law.log10(warm + 273.15), atol=1e-9)
    (band,) = bands(axes)
    for place in (0, 399):
        middle, doubt = law.log10(warm[place] + 273.15), LEVEL_95 * law.standard_error(warm[place] + 273.15)
        assert heights_at(band, warm[place]) == pytest.approx((10 ** (middle - doubt), 10 ** (middle + doubt)))
    assert not overlaps_data(axes)


def test_law_that_was_typed_in_has_no_band_and_stops_before_its_pole(axes: Axes) -> None:
    factors = vf.ShiftFactors([273.15, 303.15, 333.15], [8.0, 0.0, -3.0], REFERENCE)
    shift_factors.plot_shift_factors(axes, factors, vf.WLF(10.0, 20.0, REFERENCE))
    assert not bands(axes)
    (line,) = [line for line in axes.lines if str(line.get_label()).startswith("WLF")]
    assert np.min(np.asarray(line.get_xdata())) > 10.0  # 30 °C less C2


def test_endless_uncertainty_of_a_plateau_does_not_stretch_the_axis(axes: Axes) -> None:
    covariance = np.diag([1e6, 0.0, 1e-4])
    factors = vf.ShiftFactors([273.15, 303.15, 333.15], [3.0, 0.0, -3.0], REFERENCE, covariance)
    shift_factors.plot_shift_factors(axes, factors)
    low, high = axes.get_ylim()
    assert 1e-5 < low < 1e-3
    assert 1e3 < high < 1e5
    assert 2 <= len(labels_of(axes.yaxis)) <= 9


def test_residuals_of_laws_fall_about_zero_in_the_band_of_the_measurement(axes: Axes) -> None:
    law = vf.WLF(10.0, 90.0, REFERENCE)
    temperatures = np.array([283.15, 303.15, 323.15, 343.15])
    off = np.array([0.1, 0.0, -0.1, 0.2])
    factors = vf.ShiftFactors(temperatures, law.log10(temperatures) + off, REFERENCE, np.diag([0.01, 0.0, 0.01, 0.01]))
    shift_factors.plot_law_residuals(axes, factors, [law, vf.Arrhenius("2000 kJ/mol", REFERENCE)])
    wlf = next(line for line in axes.lines if line.get_label() == "WLF")
    np.testing.assert_allclose(wlf.get_ydata(), off, atol=1e-12)
    (band,) = bands(axes)
    assert heights_at(band, 10.0) == pytest.approx((-0.1 * LEVEL_95, 0.1 * LEVEL_95))
    assert not overlaps_data(axes)


def test_law_that_fails_does_not_hide_how_the_others_do(axes: Axes) -> None:
    temperatures = np.linspace(283.15, 343.15, 7)
    law = vf.WLF(10.0, 90.0, REFERENCE)
    factors = vf.ShiftFactors(temperatures, law.log10(temperatures), REFERENCE)
    laws = [law, vf.WLF(10.1, 90.0, REFERENCE), vf.Arrhenius("5 kJ/mol", REFERENCE)]
    shift_factors.plot_law_residuals(axes, factors, laws)
    assert max(np.abs(axes.get_ylim())) < 0.1


def test_vertical_shift_is_one_at_the_reference(axes: Axes) -> None:
    factors = VerticalShiftFactors([273.15, 303.15, 333.15], [-0.02, 0.0, 0.03], REFERENCE, np.diag([1e-4, 0.0, 1e-4]))
    shift_factors.plot_vertical_shift(axes, factors)
    (container,) = axes.containers
    np.testing.assert_allclose(container.lines[0].get_ydata(), 10.0 ** np.array([-0.02, 0.0, 0.03]))
    axes.clear()
    shift_factors.plot_vertical_shift(axes, DensityShift(REFERENCE, expansion=0.0), np.array([283.15, 323.15]))
    line = axes.lines[0]
    np.testing.assert_allclose(line.get_ydata(), (np.asarray(line.get_xdata()) + 273.15) / REFERENCE)
    assert axes.get_ylabel() == "vertical shift $b_T$"


def test_spectrum_shows_every_mode_above_zero(axes: Axes) -> None:
    C = np.array([0.0, 2e-8, 5e-8])
    modes = vf.RetardationSpectrum(1e6, 1.0 / (1e-6 - C.sum()), C, np.array([1e-6, 1e-3, 1.0]))
    rubber.plot_retardation_spectrum(axes, modes)
    (points,) = axes.lines
    np.testing.assert_allclose(points.get_xdata(), [1e-3, 1.0])
    np.testing.assert_allclose(points.get_ydata(), [2e-2, 5e-2])
    assert axes.get_xlabel() == r"retardation time $\tau_k$ (s)"
    assert "(1/MPa)" in axes.get_ylabel()
    (stems,) = axes.collections
    tops = [segment[:, 1].max() for segment in stems.get_segments()]
    np.testing.assert_allclose(tops, [2e-2, 5e-2])


def test_spectrum_of_no_modes_gives_empty_axes(axes: Axes) -> None:
    rubber.plot_retardation_spectrum(axes, vf.RetardationSpectrum(1e6, 1e6, [], []))
    assert not axes.lines


def test_relaxation_modes_are_those_of_the_conversion(axes: Axes, spectrum: vf.RetardationSpectrum) -> None:
    rubber.plot_relaxation_spectrum(axes, spectrum)
    series = spectrum.to_relaxation()
    shown = dict(zip(axes.lines[0].get_xdata(), axes.lines[0].get_ydata(), strict=True))
    for tau, E in zip(series.tau, series.E, strict=True):
        if E / series.E.max() > 1e-8:
            assert shown[tau] == pytest.approx(E / 1e6)
    assert axes.get_xlabel() == r"relaxation time $\tau_k$ (s)"


def test_modes_that_no_frequency_reached_lie_on_grey(axes: Axes, spectrum: vf.RetardationSpectrum) -> None:
    rubber.plot_retardation_spectrum(axes, spectrum)
    low, high = spectrum.fit.frequency_range
    spans = [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in axes.patches]
    assert spans
    for start, end in spans:
        assert end == pytest.approx(1.0 / high) or start == pytest.approx(1.0 / low)
    assert not overlaps_data(axes)


@pytest.mark.parametrize(
    ("low", "high"), [(1e-12, 1e12), (3e-8, 2e9), (0.4, 160.0), (0.02, 0.5), (2.1e8, 2.9e8), (1.0, 1.2), (3e-7, 8e-7)]
)
@pytest.mark.parametrize("which", ["x", "y"])
def test_log_axes_have_few_labels_on_any_range(axes: Axes, low: float, high: float, which: str) -> None:
    getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}lim")(low, high)
    axis = getattr(axes, f"{which}axis")
    style.decade_ticks(axis)
    shown = labels_of(axis)
    assert 2 <= len(shown) <= 9
    boxes = [
        label.get_window_extent()
        for place, label in zip(axis.get_majorticklocs(), axis.get_majorticklabels(), strict=True)
        if low <= place <= high and label.get_text()
    ]
    assert not any(first.overlaps(second) for first, second in pairwise(boxes))


def test_synthetic_mark_and_legend_above_do_not_cover_each_other(axes: Axes, fit: vf.rheology.Superposition) -> None:
    rubber.plot_master_curve(axes, fit, synthetic=True)
    style.mark_synthetic([axes])
    axes.figure.canvas.draw()
    (mark,) = axes.texts
    assert mark.get_text() == "synthetic data"
    assert not mark.get_window_extent().overlaps(axes.get_legend().get_window_extent())
    assert not mark.get_window_extent().overlaps(axes.get_window_extent())
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["$E'$ synthetic", "$E''$ synthetic"]


def test_readings_keep_their_isotherms_together() -> None:
    moduli = moduli_of_sweeps(list(made_sweeps([10.0, 20.0]).isotherms))
    np.testing.assert_array_equal(moduli.temperature, np.repeat([283.15, 293.15], 9))
    assert moduli.symbol == "E"


def test_figures_of_many_panels_share_one_colour_bar() -> None:
    figure = Figure()
    panels = figure.subplots(1, 2)
    scale = rubber.plot_isotherms(panels[0], made_sweeps())
    bar = style.temperature_bar(figure, scale, panels)
    assert bar.ax.get_ylabel() == "temperature (°C)"
    assert bar.vmin == pytest.approx(10.0)
    assert bar.vmax == pytest.approx(60.0)
