"""Run files of rough surfaces: what they ask for, what does not go with a surface, and steps of preparation."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import DataFileError, StudyError
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import STEPS, MadeSurface, ScannedSurface, step_of, surface_of, unit_vector
from viscofric.study.run_file.study import load_study, parse_study

MATERIAL = '[material]\ncatalogue = "synthetic fluoroelastomer"\n'
MADE = """[surface]
hurst = 0.8
rms_slope = 0.2
rolloff = "200 um"
shortest = "40 um"
spacing = "10 um"
points = 32
seed = { from = 3, to = 5 }
"""
CONDITIONS = """[conditions]
pressure = ["20 kPa", "50 kPa"]
speed = ["1 mm/s", "1 m/s"]
temperature = "30 degC"
"""
SCAN = '[surface]\nfile = "scan.csv"\nunit = "um"\nspacing = "5 um"\n'
GOOD = MATERIAL + MADE + CONDITIONS
BALL = '[indenter]\nradius = "5 mm"\n'


def mistakes(text: str) -> list[str]:
    """Return the places of what is wrong in a run file."""
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    return [one.where for one in caught.value.mistakes]


def test_seeds_and_pressures_are_axes() -> None:
    sweep = parse_study(GOOD, Path("study.toml")).sweep()
    assert sweep.dimensions == ("material", "sample", "seed", "pressure", "temperature", "speed")
    assert sweep.axes[2].columns == {"seed": (3, 4, 5)}
    assert sweep.shape == (1, 1, 3, 2, 1, 2)
    first, last = sweep.cases[0], sweep.cases[-1]
    assert isinstance(first, SurfaceCase)
    assert first.surface == MadeSurface(
        hurst=0.8,
        points=(32, 32),
        spacing=(pytest.approx(1e-5), pytest.approx(1e-5)),
        seed=3,
        shortest=pytest.approx(4e-5),
        rolloff=pytest.approx(2e-4),
        rms_slope=0.2,
    )
    assert isinstance(last, SurfaceCase)
    assert (last.pressure, last.speed, last.direction, last.modulus) == (pytest.approx(5e4), 1.0, 0.0, None)
    assert last.surface == replace(first.surface, seed=5)  # type: ignore[type-var]


def test_a_rolloff_as_long_as_the_period_may_differ_from_it_by_rounding() -> None:
    text = GOOD.replace('"200 um"', '"0.32 mm"')
    case = parse_study(text, Path("study.toml")).sweep().cases[0]
    assert isinstance(case, SurfaceCase)
    assert case.surface.topography().rms_slope == pytest.approx(0.2, rel=1e-12)


def test_directions_and_elastic_surfaces_reach_every_case() -> None:
    text = GOOD.replace("[conditions]", 'modulus = "3 GPa"\n[layer]\nthickness = "2 mm"\n[conditions]')
    text += 'direction = { from = "-90 deg", to = "90 deg", points = 3 }\n'
    sweep = parse_study(text, Path("study.toml")).sweep()
    assert sweep.axes[-3].columns["direction"] == pytest.approx((-0.5 * math.pi, 0.0, 0.5 * math.pi))
    for case in sweep.cases:
        assert isinstance(case, SurfaceCase)
        assert (case.modulus, case.poisson_ratio, case.layer) == (3e9, 0.3, vf.Layer("2 mm"))


@pytest.mark.parametrize(("degrees", "vector"), [(0, (1, 0)), (90, (0, 1)), (180, (-1, 0)), (-90, (0, -1))])
def test_motions_along_an_axis_have_no_part_across_it(degrees: int, vector: tuple[int, int]) -> None:
    assert unit_vector(math.radians(degrees)) == vector
    assert unit_vector(math.radians(30.0)) == pytest.approx((math.sqrt(0.75), 0.5), rel=1e-15)


def test_direction_is_no_condition_of_an_indenter() -> None:
    text = MATERIAL + BALL + CONDITIONS.replace('pressure = ["20 kPa", "50 kPa"]', 'load = "5 N"')
    assert mistakes(text + 'direction = "10 deg"\n') == ["conditions.direction"]


def test_a_finer_grid_and_rounded_heights_have_no_shorter_waves(tmp_path: Path) -> None:
    made = vf.self_affine(0.8, shape=(24, 24), spacing="5 um", shortest="20 um", rms_height="3 um", seed=7)
    np.savetxt(tmp_path / "scan.csv", 1e6 * made.heights, fmt="%.4f", delimiter=",")
    path = tmp_path / "study.toml"
    path.write_text(MATERIAL + SCAN + 'prepare = ["periodic", "resample 1.25 um"]\n' + CONDITIONS, encoding="utf-8")
    case = load_study(path).sweep().cases[0]
    assert isinstance(case, SurfaceCase)
    assert case.surface.shape == (96, 96)
    assert case.surface.wavelengths == pytest.approx((20e-6, 120e-6), rel=1e-9)


def test_a_measured_surface_is_read_and_prepared(tmp_path: Path) -> None:
    made = vf.self_affine(0.8, shape=(24, 20), spacing="5 um", shortest="20 um", rms_height="3 um", seed=7)
    heights = 1e6 * made.heights + 0.05 * np.arange(24)[:, None]
    heights[3:5, 7] = -9999.0
    np.savetxt(tmp_path / "scan.csv", heights, delimiter=",")
    prepare = 'missing = -9999\nprepare = ["fill", "remove tilt", "window 0.2"]\n'
    path = tmp_path / "study.toml"
    path.write_text(MATERIAL + SCAN + prepare + CONDITIONS, encoding="utf-8")
    study = load_study(path)
    assert study.inputs == (tmp_path / "scan.csv",)
    case = study.sweep().cases[0]
    assert isinstance(case, SurfaceCase)
    assert isinstance(case.surface, ScannedSurface)
    read = vf.read_topography(tmp_path / "scan.csv", unit="um", spacing="5 um", missing=-9999.0)
    expected = read.fill().remove("tilt").window(0.2).to_surface()
    np.testing.assert_array_equal(surface_of(case.surface).z, expected.z)
    assert case.surface.shape == (24, 20)
    # Two points, and the longer period.
    assert case.surface.wavelengths == pytest.approx((1e-5, 1.2e-4), rel=1e-12)
    np.savetxt(tmp_path / "scan.csv", heights + 1.0, delimiter=",")
    with pytest.raises(DataFileError) as changed:
        case.surface.topography()
    assert changed.value.code == "changed"
    (tmp_path / "scan.csv").unlink()
    with pytest.raises(DataFileError) as missing:
        study.sweep()
    assert missing.value.code == "no-file"


def test_steps_do_what_the_topography_does() -> None:
    one = vf.self_affine(0.8, shape=(16, 12), spacing="5 um", shortest="20 um", rms_height="3 um", seed=7)
    expected = {
        "fill": one.fill(),
        "remove tilt": one.remove("tilt"),
        "window": one.window(),
        "mirror": one.mirror(),
        "shortest 40 um": one.keep_wavelengths(shortest="40 um"),
        "longest 1 mm": one.keep_wavelengths(longest="1 mm"),
        "resample 5 um": one.resample("5 um"),
        "inverted": one.inverted(),
        "along y": one.along_y(),
        "crop y 5 um to 25 um": one.crop(y=("5 um", "25 um")),
        "crop x 0 um to 20 um": one.crop(x=("0 um", "20 um")),
        "fill nearest": one.fill("nearest"),
    }
    for words, wanted in expected.items():
        found = step_of(words)(one)
        np.testing.assert_array_equal(found.heights, wanted.heights)
        assert (found.spacing, found.periodic, found.history) == (wanted.spacing, wanted.periodic, wanted.history)
    piece = step_of("periodic")(one.crop(x=("0 um", "20 um")))
    assert piece.periodic
    assert piece.history[-1].code == "taken-as-period"
    assert {next(name for name in STEPS if words.startswith(name)) for words in [*expected, "periodic"]} == set(STEPS)
