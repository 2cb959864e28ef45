"""Run files of rough surfaces: what they ask for, what does not go with a surface, and steps of preparation."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import DataFileError, InputError, StudyError
from viscofric.study.cases.surface_case import SurfaceCase
from viscofric.study.cases.surfaces import STEPS, MadeSurface, ScannedSurface, step_of, surface_of, unit_vector
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


def told(text: str) -> str:
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    return str(caught.value)


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


@pytest.mark.parametrize(
    ("good", "bad", "words"),
    [
        (MADE, "", "indenter: is missing (what slides or rolls over the rubber); give it, or [surface]"),
        (MADE, MADE + BALL, "surface: is there beside [indenter]; a study has one of them"),
        (MADE, BALL, "conditions.pressure: is not for an indenter; give its load instead, such as '25 N'"),
        ('pressure = ["20 kPa", "50 kPa"]', 'load = "5 N"', "conditions.load: is not for a [surface]; give its press"),
        ('pressure = ["20 kPa", "50 kPa"]', "", "conditions.pressure: is missing; a [surface] has one"),
        ("[conditions]", '[measurement]\nmtm = "a.csv"\n[conditions]', "measurement: is of a ball, but there is a"),
        ("hurst = 0.8\n", "", "surface: nothing says what it is; give file"),
        ("hurst = 0.8", 'hurst = 0.8\nfile = "a.csv"', "surface.hurst: is for a surface that is made, but there is"),
        ("hurst = 0.8", 'hurst = 0.8\nprepare = ["fill"]', "surface.prepare: is for a surface that is read from a fil"),
        ("seed = { from = 3, to = 5 }", "", "surface.seed: is missing"),
        ("seed = { from = 3, to = 5 }", "seed = [1, 2, 1]", "surface.seed: holds the same value twice (entry 3)"),
        ("{ from = 3, to = 5 }", "{ from = 3, to = 3 }", "surface.seed.to: must lie above from"),
        ("{ from = 3, to = 5 }", "{ from = 3, top = 5 }", "surface.seed.top: unknown key; did you mean 'to'?"),
        ("{ from = 3, to = 5 }", "-1", "surface.seed: -1 is too small"),
        ("rms_slope = 0.2", "", "surface.rms_height: give rms_height or rms_slope, one of them"),
        ("rms_slope = 0.2", 'rms_slope = 0.2\nrms_height = "1 um"', "surface.rms_height: give rms_height or rms_slope"),
        ('spacing = "10 um"', 'spacing = "30 um"', "surface.shortest: 4e-05 m is no more than two points of the grid"),
        ('rolloff = "200 um"', 'rolloff = "1 mm"', "must grow in this order; the period is the longest where none"),
        ("points = 32", "points = [32, 32, 32]", "surface.points: has 3 entries; at most 2"),
        ("hurst = 0.8", "hurst = 1.8", "surface.hurst: 1.8 is too large"),
        ("hurst", "hurts", "surface.hurts: unknown key; did you mean 'hurst'?"),
        ("[surface]", "[surfaces]", "surfaces: unknown key; did you mean 'surface'?"),
        (
            MADE,
            SCAN + 'prepare = ["fil"]\n',
            "surface.prepare[0]: 'fil' is no step of preparation; did you mean 'fill'?",
        ),
        (MADE, SCAN + 'prepare = "window 2"\n', "right would be a share of each length, as in 'window 0.1'."),
    ],
)
def test_what_does_not_go_with_a_surface_is_told(good: str, bad: str, words: str) -> None:
    assert good in GOOD
    message = told(GOOD.replace(good, bad, 1))
    assert words in message
    # Nothing else is wrong but where several keys are of the other kind of surface.
    assert "\n" not in message or good == MADE or "file =" in bad


def test_direction_is_no_condition_of_an_indenter() -> None:
    text = MATERIAL + BALL + CONDITIONS.replace('pressure = ["20 kPa", "50 kPa"]', 'load = "5 N"')
    assert "conditions.direction: is for a rough [surface]" in told(text + 'direction = "10 deg"\n')


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
    with pytest.raises(DataFileError, match="was changed while the study ran"):
        case.surface.topography()
    (tmp_path / "scan.csv").unlink()
    with pytest.raises(DataFileError, match="no such file"):
        study.sweep()


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
    assert piece.history[-1] == "taken as one period of the surface"
    assert {next(name for name in STEPS if words.startswith(name)) for words in [*expected, "periodic"]} == set(STEPS)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("mirror twice", "stands alone"),
        ("fill with water", "'harmonic' or 'nearest'"),
        ("remove", "right would be 'remove mean'"),
        ("resample", "needs a length"),
        ("shortest 5 N", "unit"),
        ("crop 5 um", "right would be 'crop x 0 um to 200 um'"),
        ("sand", "is no step of preparation; "),
    ],
)
def test_steps_that_cannot_be_done_are_told(words: str, why: str) -> None:
    with pytest.raises(InputError, match=re.escape(why)):
        step_of(words)
