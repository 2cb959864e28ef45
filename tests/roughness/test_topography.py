"""Topographies: what each step of their preparation does, and what it is recorded as."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscofric as vf
from refusals import refused
from viscofric.notes import codes

N, M = 48, 32
X, Y = np.meshgrid(np.arange(N) / N, np.arange(M) / M, indexing="ij")


def waves(*numbers: tuple[int, int]) -> np.ndarray:
    return sum((np.cos(2.0 * np.pi * (i * X + j * Y) + i) for i, j in numbers), np.zeros((N, M)))


def periodic(heights: np.ndarray) -> vf.Topography:
    return vf.Topography(heights, (1.0 / N, 1.0 / M), periodic=True)


def test_tilt_and_curvature_are_removed_to_rounding_and_nothing_else_of_a_plane_is():
    plane = 3.0 + 2.0 * X - 5.0 * Y
    bowl = plane + X**2 - 3.0 * X * Y + 0.5 * Y**2
    # Rounding of a least-squares problem with heights of order one.
    assert np.abs(vf.Topography(plane, 1.0).remove("tilt").heights).max() < 1e-13
    assert np.abs(vf.Topography(bowl, 1.0).remove("curvature").heights).max() < 1e-13
    assert np.abs(vf.Topography(bowl, 1.0).remove("tilt").heights).max() > 0.1
    assert vf.Topography(bowl, 1.0).remove("mean").heights.mean() == pytest.approx(0.0, abs=1e-13)


def test_a_surface_without_its_tilt_does_not_repeat_itself_any_more():
    surface = periodic(waves((1, 1), (2, 0)))
    assert surface.remove("mean").periodic
    with refused("not-periodic"):
        surface.remove("tilt").to_surface()


@pytest.mark.parametrize("step", ["window", "mirror"])
def test_a_tilt_that_would_become_a_long_wave_is_noted(step):
    rough = 0.1 * np.random.default_rng(0).normal(size=X.shape)
    for slope, noted in ((0.1, False), (2.0, True)):
        scan = vf.Topography(slope * X + rough, 1e-3)
        (*_, last) = getattr(scan, step)().history
        assert (last.code == "tilted") == noted
        if noted:
            variance = np.var(slope * X)
            assert last.values["share"] == pytest.approx(variance / (variance + 0.01), abs=0.01)
        assert "tilted" not in codes(getattr(scan.remove("tilt"), step)().history)


def test_a_trend_is_found_round_missing_heights():
    plane = 1.0 + 2.0 * X - Y
    plane[5:20, 3:9] = np.nan
    left = vf.Topography(plane, 1.0).remove("tilt")
    assert left.missing == 15 * 6
    assert np.nanmax(np.abs(left.heights)) < 1e-13


def test_a_line_scan_loses_its_tilt_and_curvature():
    x = np.linspace(0.0, 1.0, 40)
    assert np.abs(vf.Topography(1.0 + x - x**2, 1.0).remove("curvature").heights).max() < 1e-14


@pytest.mark.parametrize("repeats", [False, True])
def test_harmonic_filling_continues_a_plane_exactly_and_makes_no_summit(repeats):
    plane = 1.0 + 2.0 * X - Y
    holes = plane.copy()
    holes[10:20, 8:19] = holes[30, 3] = np.nan
    filled = vf.Topography(holes, (1.0 / N, 1.0 / M), periodic=repeats).fill()
    np.testing.assert_allclose(filled.heights, plane, atol=1e-12)
    rough = np.where(np.isnan(holes), np.nan, np.random.default_rng(0).normal(size=holes.shape))
    found = vf.Topography(rough, 1.0).fill().heights
    # Maximum principle of Laplace's equation.
    assert found.max() == np.nanmax(rough)
    assert found.min() == np.nanmin(rough)


def test_filling_reaches_round_the_edge_of_a_periodic_surface():
    z = np.zeros((8, 8))
    z[-1] = 1.0
    z[:3] = np.nan
    z[3] = 5.0
    near = vf.Topography(z, 1.0, periodic=True).fill("nearest").heights
    assert near[0, 0] == 1.0
    assert near[2, 0] == 5.0
    harmonic = vf.Topography(z, 1.0, periodic=True).fill().heights
    np.testing.assert_allclose(harmonic[:3, 4], [2.0, 3.0, 4.0], atol=1e-12)
    across = vf.Topography(z, 1.0).fill().heights
    np.testing.assert_allclose(across[:3, 4], 5.0, atol=1e-12)  # an open edge lets nothing through


def test_missing_heights_are_refused_by_what_needs_them_and_filling_is_recorded():
    holes = waves((1, 1))
    holes[0, 0] = np.nan
    surface = vf.Topography(holes, 1.0, periodic=True, name="road")
    for needs in (surface.to_surface, surface.window, surface.mirror, lambda: surface.resample(2.0)):
        with refused("missing-heights"):
            needs()
    assert surface.fill("nearest").history[0].values == {"heights": 1, "method": "nearest"}
    assert surface.fill().fill() is not surface
    with refused("missing-heights"):
        vf.Topography([[np.nan, np.nan], [np.nan, np.nan]], 1.0).fill()


def test_band_pass_keeps_just_the_waves_in_between():
    surface = periodic(waves((1, 0), (3, 0), (0, 5)))
    kept = surface.keep_wavelengths(shortest=1.0 / 3.0, longest=1.0 / 3.0)
    np.testing.assert_allclose(kept.heights, waves((3, 0)), atol=1e-13)
    low = surface.keep_wavelengths(shortest=1.0 / 3.0)
    np.testing.assert_allclose(low.heights, waves((1, 0), (3, 0)), atol=1e-13)
    high = surface.keep_wavelengths(longest=1.0 / 4.0)
    np.testing.assert_allclose(high.heights, waves((0, 5)), atol=1e-13)
    assert [(step.code, step.values) for step in high.history] == [("waves-left-out", {"longest": 0.25})]
    with refused("no-wave"):
        surface.keep_wavelengths(longest=1e-3)
    with refused("give-one"):
        surface.keep_wavelengths()
    with refused("not-periodic"):
        vf.Topography(surface.heights, 1.0).keep_wavelengths(shortest=1.0)


@settings(max_examples=15, deadline=None)
@given(st.sampled_from([(9, 8), (8, 9), (10, 12), (7, 7)]), st.integers(13, 30), st.integers(13, 30))
def test_a_periodic_surface_comes_back_from_a_finer_grid(shape, nx, ny):
    heights = np.random.default_rng(3).normal(size=shape)
    coarse = vf.Topography(heights, (1.0 / shape[0], 1.0 / shape[1]), periodic=True)
    fine = coarse.resample((1.0 / nx, 1.0 / ny))
    assert fine.shape == (nx, ny)
    back = fine.resample(coarse.spacing)
    for axis, points in enumerate(shape):
        if points % 2 == 0:  # the Nyquist wave, which a coarser grid leaves out
            sign = (-1.0) ** np.arange(points).reshape((-1, 1) if axis == 0 else (1, -1))
            heights = heights - sign * (sign * heights).mean(axis=axis, keepdims=True)
    np.testing.assert_allclose(back.heights, heights, atol=1e-12)


@pytest.mark.parametrize(("shape", "times"), [((8, 9), (2, 3)), ((7, 6), (3, 2)), ((10, 1), (4, 1))])
def test_a_finer_grid_keeps_the_heights_of_all_old_points(shape, times):
    heights = np.random.default_rng(4).normal(size=shape)
    steps = 1.0 / shape[0], 1.0 / shape[1]
    fine = vf.Topography(heights, steps, periodic=True).resample((steps[0] / times[0], steps[1] / times[1]))
    np.testing.assert_allclose(fine.heights[:: times[0], :: times[1]], heights, atol=1e-13)


def test_resampling_an_open_scan_follows_smooth_heights_and_averages_away_what_is_too_short():
    smooth = vf.Topography(np.sin(3.0 * X) * np.cos(2.0 * Y), (1.0 / N, 1.0 / M))
    finer = smooth.resample((0.5 / N, 0.4 / M))
    x, y = finer.x[:, None], finer.y[None, :]
    # Cubic splines: third differences of the sine, (3/48)^4 / 24, larger at the open ends.
    np.testing.assert_allclose(finer.heights, np.sin(3.0 * x) * np.cos(2.0 * y), atol=1e-5)
    zigzag = vf.Topography((-1.0) ** np.arange(64), 1.0)
    # Cells of four points hold two waves; half a cell beyond the end there is nothing to average with.
    assert np.abs(zigzag.resample(4.0).heights[1:-1]).max() < 1e-12


def test_window_and_mirror_make_a_scan_that_repeats_itself_without_steps():
    scan = vf.Topography(waves((2, 1)) + 3.0 * X, (1.0 / N, 1.0 / M)).remove("tilt")
    for made in (scan.window(0.2), scan.mirror()):
        assert made.periodic
        z = made.heights
        within = max(np.abs(np.diff(z, axis=0)).max(), np.abs(np.diff(z, axis=1)).max())
        assert max(np.abs(z[0] - z[-1]).max(), np.abs(z[:, 0] - z[:, -1]).max()) <= within
    assert scan.mirror().rms_height == pytest.approx(scan.rms_height, rel=1e-14)
    middle = (slice(N // 4, 3 * N // 4), slice(M // 4, 3 * M // 4))
    shift = scan.window(0.2).heights[middle] - scan.heights[middle]
    np.testing.assert_allclose(shift, 0.0, atol=1e-13)
    for edge in (0.0, 0.6):
        with refused("edge"):
            scan.window(edge)


def test_a_piece_is_cut_out_by_positions():
    scan = vf.Topography(X + 10.0 * Y, (1.0 / N, 1.0 / M))
    piece = scan.crop(x=(10.0 / N, 20.0 / N), y=(4.0 / M, 4.0 / M))
    np.testing.assert_array_equal(piece.heights, scan.heights[10:21, 4:5])
    assert piece.is_line
    assert piece.history[0].values["x"] == pytest.approx([10.0 / N, 20.0 / N])
    for wrong in ((2.0, 3.0), (0.1, 0.1), 5.0):
        with refused("x"):
            scan.crop(x=wrong)


def test_rms_slope_is_that_of_the_waves():
    surface = periodic(waves((2, 3)))
    assert surface.rms_slope == pytest.approx(2.0 * np.pi * np.hypot(2, 3) / np.sqrt(2.0), rel=1e-13)
    line = vf.Topography(np.cos(2.0 * np.pi * np.arange(400) / 400), 1.0 / 400)
    # Differences of neighbours, without that between the last one and the first, where it is flat: 1/800.
    assert line.rms_slope == pytest.approx(2.0 * np.pi / np.sqrt(2.0), rel=2e-3)
    piece = vf.self_affine(0.8, shape=(128, 128), spacing="10 um", shortest="30 um", rms_slope=0.2, seed=1)
    cut = piece.crop(x=(0.0, "1.27 mm"), y=(0.0, "1.27 mm"))  # all of it, no longer periodic
    assert cut.rms_slope == pytest.approx(0.2, rel=0.04)  # central differences were 9 % too low


def test_history_shows_all_steps_in_their_order_and_nothing_changes_in_place():
    scan = vf.Topography(waves((2, 1)), (1.0 / N, 1.0 / M), name="cast")
    made = scan.inverted().remove("mean").window().keep_wavelengths(shortest=0.1)
    assert [step.code for step in made.history] == ["inverted", "mean-removed", "windowed", "waves-left-out"]
    assert scan.history == ()
    assert made.to_dataset().attrs["history"] == "; ".join(made.history)
    with pytest.raises(ValueError, match="read-only"):
        made.heights[0, 0] = 1.0


def test_exchanged_axes_slide_as_the_other_direction():
    surface = vf.Topography(1e-6 * waves((1, 2), (2, -1)), (1e-3 / N, 2e-3 / M), periodic=True)
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    turned = vf.solve_periodic(rubber, surface.along_y().to_surface(), speed=0.1, pressure=2e3)
    across = vf.solve_periodic(rubber, surface.to_surface(), speed=0.1, pressure=2e3, direction=(0.0, 1.0))
    # The solver's tolerance is 1e-8 of the heights.
    assert turned.friction_coefficient == pytest.approx(across.friction_coefficient, rel=1e-5)


def test_a_ball_with_the_roughness_taken_off_is_the_ball_and_roughness_adds_summits():
    points, step = 65, 2e-5
    flat = vf.Topography(np.zeros((points, points)), step)
    made = flat.to_indenter(vf.Ball(radius="5 mm"))
    x = np.array([1e-4, -2e-4])
    # The paraboloid is a polynomial of second degree, which the spline goes through.
    np.testing.assert_allclose(made.height(x, 0.5 * x), 1.25 * x**2 / 1e-2, rtol=1e-10)
    summit = np.zeros((points, points))
    summit[points // 2, points // 2] = 1e-6
    assert made.z.min() - vf.Topography(summit, step).to_indenter(vf.Ball("5 mm")).z.min() == pytest.approx(1e-6)


def test_a_line_scan_is_roughness_on_a_cylinder_and_a_map_on_a_ball():
    line = vf.Topography(1e-7 * np.cos(np.arange(200)), 1e-5)
    assert isinstance(line.to_indenter(vf.Cylinder("5 mm")), vf.Profile)
    assert isinstance(line.to_indenter(), vf.Profile)
    with refused("line-or-map"):
        line.to_indenter(vf.Ball("5 mm"))
    with refused("line-or-map"):
        vf.Topography(np.zeros((9, 9)), 1e-5).to_indenter(vf.Cylinder("5 mm"))


@pytest.mark.parametrize(
    ("arguments", "about"),
    [
        ({"heights": [[1.0, 2.0]], "spacing": 1.0}, "heights"),
        ({"heights": [1.0, np.inf], "spacing": 1.0}, "heights"),
        ({"heights": [1.0, 2.0], "spacing": (1.0, 1.0, 1.0)}, "spacing"),
        ({"heights": [1.0, 2.0], "spacing": 0.0}, "spacing"),
    ],
)
def test_what_is_no_topography_is_refused(arguments, about):
    with refused(about):
        vf.Topography(**arguments)
    with refused("spacing"):
        vf.Topography(np.zeros((100, 100)), 1.0).resample(1e-7)


def test_roughness_of_no_height_on_a_ball_rubs_as_the_ball_and_waves_rub_more():
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    waves = vf.self_affine(0.8, shape=(96, 96), spacing=2e-3 / 96, shortest=2.5e-4, rms_height="4 um", seed=1)
    flat = vf.Topography(np.zeros((96, 96)), 2e-3 / 96)
    asked = {"speed": 0.1, "load": 0.05, "accuracy": 1e-2}
    smooth = vf.solve_steady(rubber, vf.Ball("5 mm"), **asked)
    same = vf.solve_steady(rubber, flat.to_indenter(vf.Ball("5 mm")), **asked)
    # The spline goes through the paraboloid.
    assert same.friction_coefficient == pytest.approx(smooth.friction_coefficient, rel=1e-9)
    rough = vf.solve_steady(rubber, waves.to_indenter(vf.Ball("5 mm")), **asked)
    assert rough.friction_coefficient > 1.1 * smooth.friction_coefficient
    assert rough.contact_area < smooth.contact_area


def test_a_topography_is_solved_as_its_surface() -> None:
    road = vf.self_affine(0.8, shape=(16, 16), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    case = {"speed": "0.1 m/s", "pressure": "5 kPa"}
    found, same = (vf.solve_periodic(rubber, one, **case) for one in (road, road.to_surface()))
    assert found.friction_coefficient == same.friction_coefficient
    with refused("not-periodic"):
        vf.solve_periodic(rubber, vf.Topography(road.heights, "10 um"), **case)
