"""Made surfaces have the statistics asked for, from seeds that no grid changes."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from refusals import refused

GRID = {"shape": (128, 96), "spacing": (1e-6, 1.5e-6), "shortest": "9 um"}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("more", [{}, {"rolloff": "40 um"}, {"aspect": 2.0, "angle": "30 deg"}, {"longest": "60 um"}])
def test_each_surface_has_just_the_rms_asked_for(seed, more):
    slope = vf.self_affine(0.7, rms_slope=0.3, seed=seed, **GRID, **more)
    assert slope.rms_slope == pytest.approx(0.3, rel=1e-12)
    height = vf.self_affine(0.7, rms_height="2 um", seed=seed, **GRID, **more)
    assert height.rms_height == pytest.approx(2e-6, rel=1e-12)
    assert height.heights.mean() == pytest.approx(0.0, abs=1e-18)


@pytest.mark.parametrize("exact", [True, False])
def test_a_finer_grid_holds_the_same_waves_and_a_shorter_cut_off_adds_to_them(exact):
    coarse = vf.self_affine(0.8, shape=(64, 48), spacing=(3.0, 4.0), shortest=12.0, rms_height=1.0, seed=7, exact=exact)
    fine = vf.self_affine(0.8, shape=(192, 96), spacing=(1.0, 2.0), shortest=12.0, rms_height=1.0, seed=7, exact=exact)
    np.testing.assert_allclose(fine.heights[::3, ::2], coarse.heights, atol=1e-13)
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=192.0, shortest=4.5, rms_height=1.0)
    made = {"shape": (192, 96), "spacing": (1.0, 2.0), "seed": 7, "exact": exact}
    rough = vf.roughness.surface_from_spectrum(spectrum, **made)
    smooth = vf.roughness.surface_from_spectrum(spectrum.limited(shortest=12.0), **made)
    kept = rough.keep_wavelengths(shortest=12.0)
    np.testing.assert_allclose(kept.heights, smooth.heights, atol=1e-13)
    assert rough.rms_slope > 1.2 * smooth.rms_slope


def test_random_amplitudes_give_the_rms_in_the_mean_and_scatter_about_it():
    found = np.array(
        [
            vf.self_affine(
                0.8, shape=(32, 32), spacing=1.0, shortest=4.0, rms_slope=1.0, seed=seed, exact=False
            ).rms_slope
            for seed in range(300)
        ]
    )
    square = found**2
    error = square.std() / np.sqrt(len(found))
    assert error < 0.02
    assert square.mean() == pytest.approx(1.0, abs=3.5 * error)  # 3.5 standard errors: once in two thousand
    assert found.std() > 0.01


def test_heights_of_many_surfaces_are_gaussian():
    heights = np.concatenate(
        [
            vf.self_affine(
                0.8, shape=(64, 64), spacing=1.0, shortest=4.0, rolloff=16.0, rms_height=1.0, seed=seed
            ).heights.ravel()
            for seed in range(60)
        ]
    )
    # Some 16 independent patches each: 1000 in all, sqrt(24/1000) = 0.15 of kurtosis and half of it of skewness.
    assert np.mean(heights**3) == pytest.approx(0.0, abs=0.25)
    assert np.mean(heights**4) == pytest.approx(3.0, abs=0.4)


def test_measured_spectrum_is_the_one_the_surface_was_made_of():
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=256.0, rolloff=64.0, shortest=6.0, rms_height=1.0)
    surface = vf.roughness.surface_from_spectrum(spectrum, shape=(256, 256), spacing=1.0, seed=2)
    found = vf.roughness.power_spectrum(surface)
    inner = slice(2, -2)
    # Rings of a twelfth of a decade, in which the density falls by a factor of two: averages over half of it.
    np.testing.assert_allclose(found.density[inner], spectrum(found.wave_number[inner]), rtol=0.05)
    assert found.rms_slope() == pytest.approx(surface.rms_slope, rel=0.02)
    assert found.rms_height() == pytest.approx(surface.rms_height, rel=0.03)
    # The last of wide rings goes on falling to the shortest wave, where it is a third of what it is in its middle.
    wide = vf.roughness.power_spectrum(surface, per_decade=4)
    assert wide.density[-1] == pytest.approx(float(spectrum(wide.wave_number[-1])), rel=0.2)


@pytest.mark.parametrize("aspect", [1.0, 2.0, 8.0])
def test_directions_without_waves_are_a_part_of_the_mean(aspect):
    surface = vf.self_affine(
        0.8, shape=(128, 128), spacing="8 um", shortest="64 um", rms_slope=0.2, aspect=aspect, angle=0.5, seed=1
    )
    spectrum = vf.roughness.power_spectrum(surface)
    # Rings are steps of a twelfth of a decade; as between the longest waves of isotropic surfaces.
    assert spectrum.rms_slope() == pytest.approx(0.2, rel=0.04)
    assert spectrum.rms_height() == pytest.approx(surface.rms_height, rel=0.1)


def test_copies_of_a_surface_and_ridges_keep_its_slope():
    """Most waves, and of copies whole rings between the longest ones, are missing there."""
    one = vf.self_affine(0.8, shape=(64, 64), spacing="8 um", shortest="64 um", rms_slope=0.2, seed=1)
    line = vf.self_affine(0.8, shape=256, spacing="8 um", shortest="64 um", rms_slope=0.2, seed=1).heights.reshape(
        -1, 1
    )
    for heights in (np.tile(one.heights, (3, 3)), np.repeat(line, 256, axis=1)):
        surface = vf.Topography(heights, one.spacing, periodic=True)
        spectrum = vf.roughness.power_spectrum(surface)
        # Few waves lie in each ring; the longest ones, which carry the height, are interpolated.
        assert spectrum.rms_slope() == pytest.approx(surface.rms_slope, rel=0.1)
        assert spectrum.rms_height() == pytest.approx(surface.rms_height, rel=1.0 / 3.0)


def test_few_points_a_decade_give_the_same_slope_and_friction():
    rubber, conditions = vf.synthetic_fluoroelastomer(), {"speeds": [0.01, 1.0], "pressure": 2e5, "temperatures": 303.0}
    # A whole surface without a bend, and a scan of one with it, whose points could hold shorter waves than there are.
    spectra = [
        vf.roughness.PowerSpectrum.self_affine(0.8, longest=800.0, rolloff=bend, shortest=6.0, rms_slope=0.4)
        for bend in (800.0, 100.0)
    ]
    plain, bent = (vf.roughness.surface_from_spectrum(one, shape=(512, 512), spacing=1.0, seed=1) for one in spectra)
    for surface, limit in ((plain, 0.01), (bent.crop(x=(0.0, 300.0), y=(50.0, 400.0)).remove("tilt"), 0.05)):
        surface = vf.Topography(1e-6 * surface.heights, 1e-6, periodic=surface.periodic)
        exact, few = (vf.roughness.power_spectrum(surface, per_decade=count) for count in (40, 2))
        friction = [vf.persson_theory(rubber, one, **conditions).friction_coefficient for one in (exact, few)]
        np.testing.assert_allclose(friction[1], friction[0], rtol=limit)
        assert few.rms_slope() == pytest.approx(surface.rms_slope, rel=0.01 + limit)
        assert few.shortest == pytest.approx(6e-6, rel=0.1)  # some waves of the scan further, which the window blurs


def test_a_windowed_scan_shows_the_spectrum_of_the_surface_it_was_cut_from():
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=512.0, rolloff=64.0, shortest=6.0, rms_height=1.0)
    ratios = []
    for seed in range(6):
        surface = vf.roughness.surface_from_spectrum(spectrum, shape=(512, 512), spacing=1.0, seed=seed)
        scan = surface.crop(x=(0.0, 255.0), y=(100.0, 355.0)).remove("tilt")
        found = vf.roughness.power_spectrum(scan)
        within = (found.wave_number > 2.0 * np.pi / 100.0) & (found.wave_number < 2.0 * np.pi / 7.0)
        ratios.append(found.density[within] / spectrum(found.wave_number[within]))
    # Six scans, tens of waves in the first ring: 10 % there, less further on.
    np.testing.assert_allclose(np.mean(ratios, axis=0), 1.0, atol=0.2)
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.04)


def test_tilt_of_a_scan_is_no_roughness():
    surface = vf.self_affine(0.8, shape=(256, 256), spacing=1.0, shortest=8.0, longest=128.0, rms_slope=0.3, seed=1)
    scan = surface.crop(x=(0.0, 149.0), y=(20.0, 149.0))
    x, y = np.meshgrid(scan.x, scan.y, indexing="ij")
    tilted = vf.Topography(scan.heights + 0.5 * x - 0.2 * y, 1.0)
    for spectrum in (vf.roughness.power_spectrum, vf.roughness.line_spectrum):
        found, level = spectrum(tilted), spectrum(scan)
        np.testing.assert_allclose(found.density, level.density, rtol=1e-9)
        assert level.rms_slope() < 0.35  # with its tilt 0.6


def test_a_surface_without_its_longest_waves_has_none_in_its_spectrum():
    surface = vf.self_affine(0.8, shape=(512, 512), spacing=1.0, shortest=10.0, longest=250.0, rms_slope=0.3, seed=1)
    found = vf.roughness.power_spectrum(surface)
    assert 2.0 * np.pi / found.wave_number[0] < 330.0  # those of 250 reach half a cell of waves beyond
    assert found.rms_height() == pytest.approx(surface.rms_height, rel=0.08)  # up to the period it was 22 % more


def test_lines_of_an_isotropic_surface_have_half_its_mean_square_slope():
    surface = vf.self_affine(0.8, shape=(256, 256), spacing=1.0, shortest=8.0, rolloff=64.0, rms_slope=1.0, seed=3)
    found = [vf.roughness.line_spectrum(surface, axis=axis).rms_slope() for axis in ("x", "y")]
    assert np.hypot(*found) == pytest.approx(1.0, rel=0.03)
    assert found[0] == pytest.approx(found[1], rel=0.1)


def test_lines_show_the_spectrum_of_an_isotropic_surface():
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=512.0, rolloff=128.0, shortest=6.0, rms_slope=1.0)
    surface = vf.roughness.surface_from_spectrum(spectrum, shape=(512, 512), spacing=1.0, seed=5)
    found = vf.roughness.line_spectrum(surface).isotropic()
    within = (found.wave_number > 2.0 * np.pi / 128.0) & (found.wave_number < 2.0 * np.pi / 8.0)
    ratio = found.density[within] / spectrum(found.wave_number[within])
    # Lines of one surface, whose classes of wavelength hold few waves where they are long.
    np.testing.assert_allclose(ratio, 1.0, atol=0.35)
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.06)
    assert found.rms_slope() == pytest.approx(1.0, rel=0.05)


def test_lines_of_a_power_law_are_one_with_a_known_factor():
    """C = k^(−s) has the lines √π Γ((s−1)/2)/Γ(s/2) q^(1−s)."""
    s = 3.6
    q = np.geomspace(1.0, 1e4, 60)
    lines = vf.roughness.LineSpectrum(
        q, math.sqrt(math.pi) * math.gamma(0.5 * s - 0.5) / math.gamma(0.5 * s) * q ** (1.0 - s)
    )
    found = lines.isotropic()
    # Far from the end, beyond which the lines of a power law that goes on have waves and these have none: the rms slope
    # of those up to the end is another one, by 0.7 %.
    np.testing.assert_allclose(found.density[:40] * q[:40] ** s, 1.0, rtol=0.02)


@pytest.mark.parametrize("periodic", [True, False])
def test_single_scans_have_the_slope_and_height_of_their_surface(periodic):
    """Each class of wavelengths holds one or a few waves, whose amplitudes scatter by as much as they are high."""
    slopes, heights = [], []
    for seed in range(12):
        surface = vf.self_affine(
            0.8, shape=(256, 64), spacing=1.0, shortest=8.0, longest=60.0, rms_slope=0.3, seed=seed
        )
        scan = vf.Topography(surface.heights[: 256 if periodic else 200, 5], 1.0, periodic)
        found = vf.roughness.line_spectrum(scan).isotropic()
        slopes.append(found.rms_slope() / 0.3)
        heights.append(found.rms_height() / surface.rms_height)
    # Of single scans they scatter by 0.08 to 0.16 and 0.2: the mean over twelve by a third of that.
    assert np.mean(slopes) == pytest.approx(1.0, abs=0.1)
    assert np.mean(heights) == pytest.approx(1.0, abs=0.2)


def test_profiles_follow_their_own_power_law():
    profile = vf.self_affine(0.8, shape=4096, spacing=1.0, shortest=8.0, rms_height=1.0, seed=0)
    assert profile.is_line
    assert profile.rms_height == pytest.approx(1.0, rel=1e-12)
    found = vf.roughness.line_spectrum(profile)
    slope = np.polyfit(np.log(found.wave_number[3:-2]), np.log(found.density[3:-2]), 1)[0]
    assert slope == pytest.approx(-2.6, abs=0.02)
    again = vf.roughness.surface_from_spectrum(found, shape=4096, spacing=1.0, seed=1)
    assert again.rms_slope == pytest.approx(profile.rms_slope, rel=0.02)


def test_the_lay_stretches_waves_along_itself():
    surface = vf.self_affine(
        0.8, shape=(256, 256), spacing=1.0, shortest=12.0, rms_slope=1.0, seed=4, aspect=4.0, angle="90 deg"
    )
    across, along = (np.square(np.gradient(surface.heights, axis=axis)).mean() for axis in (0, 1))
    # Wave numbers are four times larger across the lay than along it; differences are a little flatter.
    assert across / along == pytest.approx(16.0, rel=0.15)


def test_the_lay_turns_from_x_towards_y():
    surface = vf.self_affine(
        0.8, shape=(128, 128), spacing=1.0, shortest=16.0, rms_slope=1.0, seed=4, aspect=3.0, angle="30 deg"
    )
    slopes = np.stack([part.ravel() for part in np.gradient(surface.heights)])
    variances, directions = np.linalg.eigh(slopes @ slopes.T)
    flattest = np.degrees(np.arctan2(directions[1, 0], directions[0, 0])) % 180.0
    # A sum over some hundred waves on a square grid is turned by less than a degree, differences add as much.
    assert flattest == pytest.approx(30.0, abs=2.0)
    assert math.sqrt(variances[1] / variances[0]) == pytest.approx(3.0, rel=0.1)


def test_power_laws_between_points_are_integrated_in_closed_form():
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=1.0, rolloff=0.1, shortest=1e-3, rms_height=2.0)
    assert spectrum.rms_height() == pytest.approx(2.0, rel=1e-13)
    q = np.geomspace(2.0 * np.pi, 2.0 * np.pi * 1e3, 40001)
    for order, found in ((0, spectrum.rms_height()), (2, spectrum.rms_slope()), (4, 2.0 * spectrum.rms_curvature())):
        wanted = 2.0 * np.pi * np.trapezoid(q ** (order + 2) * spectrum(q), np.log(q))
        # Trapezoids of 1/5790 of the logarithm, and one that holds the kink.
        assert found**2 == pytest.approx(wanted, rel=1e-6)
    parts = spectrum.limited(shortest=0.05).moment(2.0) + spectrum.limited(longest=0.05).moment(2.0)
    assert parts == pytest.approx(spectrum.moment(2.0), rel=1e-13)
    assert spectrum.rms_slope(shortest=0.05) ** 2 == pytest.approx(spectrum.limited(shortest=0.05).moment(2.0))
    assert spectrum.scaled(rms_slope=0.1).rms_slope() == pytest.approx(0.1, rel=1e-13)
    harmonic = vf.roughness.PowerSpectrum([1.0, 2.0, 4.0], [1.0, 0.25, 0.0625])  # q^-2: the logarithm
    assert harmonic.moment(0.0) == pytest.approx(2.0 * np.pi * np.log(4.0), rel=1e-13)


def test_a_function_may_be_the_spectrum():
    made = {"shape": (32, 32), "spacing": 1.0, "seed": 0}
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.5, longest=32.0, shortest=4.0, rms_height=1.0)
    np.testing.assert_array_equal(
        vf.roughness.surface_from_spectrum(lambda q: spectrum(q), **made).heights,
        vf.roughness.surface_from_spectrum(spectrum, **made).heights,
    )


@pytest.mark.parametrize(
    ("arguments", "about"),
    [
        ({"hurst": 0.0}, "hurst"),
        ({"rms_height": 1e-6}, "give-one"),
        ({"rms_slope": None}, "give-one"),
        ({"shortest": "2 um"}, "shortest"),
        ({"aspect": 4.0, "shortest": "8 um"}, "shortest"),
        ({"rolloff": "1 m"}, "wavelengths-out-of-order"),
        ({"seed": -1}, "seed"),
        ({"seed": 1.5}, "seed"),
        ({"shape": (2, 2)}, "shape"),
        ({"shape": (64,)}, "shape"),
        ({"shape": (10**6, 10**6)}, "shape"),
        ({"longest": "9.1 um", "rolloff": "9.1 um"}, "no-wave"),
        ({"shape": 64, "aspect": 2.0}, "line-scan"),
    ],
)
def test_what_cannot_be_made_is_refused(arguments, about):
    asked = {"hurst": 0.8, "shape": (16, 16), "spacing": "2 um", "shortest": "9 um", "rms_slope": 0.1, "seed": 0}
    with refused(about):
        vf.self_affine(**{**asked, **arguments})


def test_spectra_that_are_none_are_refused():
    for rows, code in (
        (([1.0], [1.0]), "wrong-length"),
        (([1.0, 2.0], [1.0, 0.0]), "not-positive"),
        (([2.0, 1.0], [1.0, 1.0]), "not-ascending"),
        ((["a", "b"], [1.0, 1.0]), "no-number"),
    ):
        with refused(code):
            vf.roughness.PowerSpectrum(*rows)
    line = vf.roughness.LineSpectrum([1.0, 2.0], [1.0, 0.5])
    with refused("spectrum"):
        vf.roughness.surface_from_spectrum(line, shape=(16, 16), spacing=1.0, seed=0)
    with refused("no-wave"):
        vf.roughness.surface_from_spectrum(line, shape=16, spacing=1e-3, seed=0)
    with refused("not-positive"):
        vf.roughness.surface_from_spectrum(lambda q: -q, shape=16, spacing=1.0, seed=0)
    for wrong, code in ((lambda q: q[:3], "wrong-length"), (lambda q: "none", "not-a-number")):
        with refused(code, naming="spectrum"):
            vf.roughness.surface_from_spectrum(wrong, shape=16, spacing=1.0, seed=0)
    for measure in (vf.roughness.power_spectrum, vf.roughness.line_spectrum):
        with refused("topography"):
            measure(np.zeros((8, 8)))
    plane = np.outer(np.arange(64), np.ones(64)) + 0.1 * np.arange(64)
    for height in (np.zeros((8, 8)), np.full((8, 8), 0.1), plane, plane + 1e6, 1e-7 * plane):
        for measure in (vf.roughness.power_spectrum, vf.roughness.line_spectrum):
            with refused("flat"):
                measure(vf.Topography(height, 1.0))
    rough = vf.Topography(plane + 1e-6 * np.random.default_rng(1).standard_normal((64, 64)), 1.0)
    assert vf.roughness.power_spectrum(rough).rms_height() == pytest.approx(1e-6, rel=0.2)
    with refused("too-few-points"):
        vf.roughness.power_spectrum(vf.Topography(np.random.default_rng(1).standard_normal((2, 2)), 1.0))
    with refused("line-scan"):
        vf.roughness.power_spectrum(vf.Topography(np.zeros(8), 1.0))
