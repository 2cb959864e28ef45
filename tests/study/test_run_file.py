"""Run files: quantities with units in, every mistake told in a sentence that names the field."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from viscofric.errors import StudyError
from viscofric.study.run_file.study import load_study, parse_study

GOOD = """
title = "a rubber"
[material]
dma = "dma.csv"
reference_temperature = "30 degC"
[indenter]
radius = "9.525 mm"
[conditions]
load = "25 N"
speed = { from = "20 mm/s", to = "200 mm/s", points = 3 }
temperature = ["30 degC", "60 degC"]
"""
TWO = 'temperature = ["30 degC", "60 degC"]'
MEASURED = f'{TWO}\n[measurement]\nmtm = "a.csv"'


def test_quantities_become_si_and_paths_are_beside_the_run_file(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(GOOD, encoding="utf-8")
    study = load_study(path)
    assert study.material.dma == (tmp_path / "dma.csv",)
    assert study.material.reference_temperature == pytest.approx(303.15, rel=1e-15)
    assert study.indenter.axes["radius"] == pytest.approx((9.525e-3,), rel=1e-15)
    # Three speeds over one decade, logarithmically spaced.
    np.testing.assert_allclose(study.conditions.speed, [0.02, np.sqrt(0.02 * 0.2), 0.2], rtol=1e-12)
    assert study.conditions.temperature == pytest.approx((303.15, 333.15), rel=1e-15)


def test_a_pattern_stands_for_all_files_of_that_kind(tmp_path: Path) -> None:
    for name in ("T20.txt", "T0.txt", "notes.md"):
        (tmp_path / name).write_text("", encoding="utf-8")
    path = tmp_path / "study.toml"
    path.write_text(GOOD.replace('"dma.csv"', '"T*.txt"'), encoding="utf-8")
    assert load_study(path).material.dma == (tmp_path / "T0.txt", tmp_path / "T20.txt")
    path.write_text(GOOD.replace('"dma.csv"', '["notes.md", "X*.txt"]'), encoding="utf-8")
    # Where nothing answers to the pattern, its reader says that there is no such file.
    assert load_study(path).material.dma == (tmp_path / "notes.md", tmp_path / "X*.txt")


def test_measurement_is_as_in_python(tmp_path: Path) -> None:
    for name in ("run1.txt", "run2.txt"):
        (tmp_path / name).write_text("", encoding="utf-8")
    path = tmp_path / "study.toml"
    more = 'zero = "-0.12 N"\nzero_error = "10 mN"\ncoulomb = 0.05\ntemperature_tolerance = "2 delta_degC"'
    more += "\nexcept_steps = 3"
    path.write_text(f"{GOOD}{MEASURED.removeprefix(TWO)}\n{more}".replace("a.csv", "run*.txt"), encoding="utf-8")
    measurement = load_study(path).measurement
    assert measurement is not None
    assert measurement.inputs == (tmp_path / "run1.txt", tmp_path / "run2.txt")
    assert measurement.except_steps == (3,)
    assert measurement.settings == {
        "zero": (-0.12, pytest.approx(0.01)),
        "coulomb": 0.05,
        "outliers": "keep",
        "speed_tolerance": 0.05,
        "temperature_tolerance": pytest.approx(2.0),
    }


def test_fixed_shift_factors_are_by_kelvin() -> None:
    text = GOOD.replace('"dma.csv"', '"dma.csv"\nfixed_shift_factors = { "-20 degC" = 4.2 }')
    study = parse_study(text, Path("study.toml"))
    ((kelvin, value),) = study.material.fixed_shift_factors.items()
    assert (kelvin, value) == (pytest.approx(253.15, rel=1e-15), 4.2)


def test_one_speed_or_temperature_needs_no_list() -> None:
    text = GOOD.replace('{ from = "20 mm/s", to = "200 mm/s", points = 3 }', '"1 m/s"')
    study = parse_study(text.replace('["30 degC", "60 degC"]', '"30 degC"'), Path("study.toml"))
    assert study.conditions.speed == (1.0,)
    assert study.conditions.temperature == pytest.approx((303.15,), rel=1e-15)


@pytest.mark.parametrize(
    ("good", "bad", "told"),
    [
        ('load = "25 N"', 'load = "0 N"', ["conditions.load", "above zero"]),
        ('load = "25 N"', 'load = "-3 N"', ["conditions.load", "above zero"]),
        ('load = "25 N"', "load = 25", ["conditions.load", "no unit"]),
        ('load = "25 N"', 'load = "25 mm"', ["conditions.load", "wrong kind of unit"]),
        ('load = "25 N"', 'laod = "25 N"', ["study.toml: conditions.laod", "did you mean 'load'?"]),
        ("[indenter]", "[indentr]", ["did you mean 'indenter'?"]),
        ('radius = "9.525 mm"', 'radius = "big"', ["indenter.radius", "has no number"]),
        ('"20 mm/s"', '"0 mm/s"', ["conditions.speed.from", "above zero"]),
        ("points = 3", "points = 1", ["conditions.speed.points"]),
        ("points = 3", "point = 3", ["did you mean 'points'?"]),
        ('["30 degC", "60 degC"]', "[]", ["conditions.temperature", "empty"]),
        ('"60 degC"', '"-300 degC"', ["conditions.temperature[1]", "absolute zero"]),
        ('dma = "dma.csv"', "", ["material: nothing says where the rubber comes from", "dma ="]),
        ('dma = "dma.csv"', 'dma = "dma.csv"\nfile = "rubber.json"', ["material: dma and file are both given"]),
        (
            'dma = "dma.csv"',
            'catalogue = "PVB interlayer"\ntau_ratio = 2.0',
            ["tau_ratio cannot be chosen", "(catalogue)"],
        ),
        ('reference_temperature = "30 degC"', "", ["material: reference_temperature is missing"]),
        ('dma = "dma.csv"', 'dma = "dma.csv"\nmodes = 12', ['modes is for spectrum = "sparse" only']),
        (
            'dma = "dma.csv"',
            'dma = "dma.csv"\nshift_factors = "a.csv"\nfixed_shift_factors = { "0 degC" = 1.2 }',
            ["shift_factors and fixed_shift_factors are both given"],
        ),
        (
            'dma = "dma.csv"',
            'dma = "dma.csv"\nfixed_shift_factors = { "cold" = 1.2 }',
            ["material.fixed_shift_factors", "has no number"],
        ),
        ('dma = "dma.csv"', 'dma = "dma.csv"\npoisson_ratio = 0.6', ["material.poisson_ratio", "0.5"]),
        ('title = "a rubber"', 'title = "a rubber', ["not valid TOML"]),
        (
            'temperature = ["30 degC", "60 degC"]',
            'temperature = "30 degC"\nthickness = "0 mm"',
            ["conditions.thickness"],
        ),
        (TWO, f"{TWO}\n[measurement]", ["measurement: nothing says what was measured", "mtm ="]),
        (TWO, f'{MEASURED}\ncurves = "b.csv"', ["measurement: mtm and curves are both given"]),
        (TWO, f"{MEASURED}\nzero = 0.1", ["measurement.zero", "no unit"]),
        (TWO, f'{MEASURED}\nzero_error = "0.1 N"', ["zero_error is the standard error of zero"]),
        (TWO, f'{MEASURED}\ncoulomb = "much"', ["measurement.coulomb", "neither a friction coefficient", "'constant'"]),
        (TWO, f'{MEASURED}\ncoulomb = "constant"\ncoulomb_error = 0.1', ["coulomb_error is the standard error"]),
        (TWO, f'{MEASURED}\noutliers = "drop"', ["measurement.outliers", "leave out"]),
        (TWO, f"{MEASURED}\nspeed_tolerance = 2.0", ["measurement.speed_tolerance"]),
        (
            TWO,
            f'{TWO}\n[measurement]\ncurves = "b.csv"\nzero = "0.1 N"',
            ["zero cannot be chosen for friction curves"],
        ),
    ],
)
def test_each_mistake_is_told_by_its_field(good: str, bad: str, told: list[str]) -> None:
    assert good in GOOD
    with pytest.raises(StudyError) as caught:
        parse_study(GOOD.replace(good, bad), Path("study.toml"))
    message = str(caught.value)
    first, *more = message.splitlines()
    assert first.startswith(("study.toml: ", "study.toml, line "))
    assert (len(more) == 0) or first == f"study.toml: {len(more)} things are wrong:"
    for words in told:
        assert words in message


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('title = "a\n', "study.toml, line 1, column 11: is not valid TOML: Illegal character '\\n'."),
        ("a = 1\na = 2\n", "study.toml, line 2, column 6: a key is given twice in the same table."),
        ("[solver]\n[solver]\n", "study.toml, line 2, column 8: the table [solver] is there twice"),
        ("[material", "study.toml, at its end: is not valid TOML"),
        ("a = " + "[" * 5000, "study.toml: lists or tables lie within each other too deeply for a run file."),
        (".".join("a" * 5000) + " = 1", "study.toml: lists or tables lie within each other too deeply for a run file."),
        ("a = " + "9" * 5000, "study.toml: a whole number has thousands of digits."),
        ("#" * 1_000_001, "study.toml: has more than 1,000,000 characters; is this a run file?"),
    ],
)
def test_what_is_no_toml_is_told_by_its_line(text: str, told: str) -> None:
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    assert str(caught.value).startswith(told)


@pytest.mark.parametrize(
    ("good", "bad", "told"),
    [
        ('title = "a rubber"', "title = 3", "title: 3 is not text; text stands between quotes."),
        ('radius = "9.525 mm"', 'load = "25 N"\nradius = "1 mm"', "indenter.load: unknown key; it belongs below [cond"),
        ('radius = "9.525 mm"', 'shape = "bal"', "indenter: shape = 'bal' is not known; did you mean 'ball'?"),
        ('radius = "9.525 mm"', 'shape = "cone"', "indenter.angle: is missing (between the flank"),
        ('radius = "9.525 mm"', "shape = 5", "indenter: shape is not text"),
        ('radius = "9.525 mm"', 'radius = "1 mm"\npoisson_ratio = 0.2', "indenter.poisson_ratio: is for an elastic"),
        ("points = 3", "points = true", "conditions.speed.points: true is not a whole number."),
        ("points = 3", "points = 3.5", "conditions.speed.points: 3.5 is not a whole number."),
        ("points = 3", "points = 10_001", "points: 10001 is too large; it must be 10,000 or less."),
        (
            "points = 3",
            'points = 3, spacing = "lin"',
            "speed.spacing: 'lin' is not known; did you mean 'linear'?",
        ),
        ('to = "200 mm/s"', 'to = "20 mm/s"', "conditions.speed.to: is the same as from"),
        ('"20 mm/s"', '"-20 mm/s"', "conditions.speed.from: '-20 mm/s': must be above zero"),
        (TWO, 'temperature = { from = "1 degC", to = "2 degC", points = 2, spacing = "log" }', "spacing: 'log' is not"),
        (TWO, 'temperature = ["30 degC", "86 degF"]', "conditions.temperature: holds the same value twice (entry 2)"),
        (TWO, "temperature = true", "conditions.temperature: true has no unit"),
        (
            TWO,
            f'{TWO}\n[layer]\nthickness = "1 mm"\nbase = "glued"',
            "layer.base: 'glued' is not known; right",
        ),
        (
            TWO,
            f'{TWO}\nthickness = "1 mm"\n[layer]\nthickness = "1 mm"',
            "conditions.thickness: checks",
        ),
        ('"dma.csv"', '"a\\u0000b"', "material.dma: 'a\\x00b' cannot be the name of a file"),
        ('"dma.csv"', f'"{300 * "x"}"', "cannot be the name of a file"),
        ('"dma.csv"', '"/**/*"', "material.dma: '/**/*' looks into all folders"),
        ('"dma.csv"', '["dma.csv", 3]', "material.dma[1]: 3 is not the name of a file"),
        ('"dma.csv"', '"dma.csv"\npoisson_ratio = nan', "material.poisson_ratio: nan is not a finite number"),
        ("[indenter]", '[outputs]\nformats = ["csv", "xls"]\n[indenter]', "outputs.formats[1]: 'xls' is not known"),
        ("[indenter]", '[cluster]\nmemory = "8 mm"\nwalltime = "2 h"\n[indenter]', "for instance, '8 GB'"),
        ("[indenter]", '[uncertainty]\nseed = "x"\n[indenter]', "uncertainty.seed: 'x' is not a whole number."),
    ],
)
def test_the_sentence_says_what_would_be_right(good: str, bad: str, told: str) -> None:
    assert good in GOOD
    with pytest.raises(StudyError) as caught:
        parse_study(GOOD.replace(good, bad), Path("study.toml"))
    assert told in str(caught.value)


def test_ranges_end_exactly_where_they_are_said_to() -> None:
    text = GOOD.replace("points = 3", "points = 1000").replace('"200 mm/s"', '"0.3 m/s"')
    speeds = parse_study(text, Path("study.toml")).conditions.speed
    assert (len(speeds), speeds[0], speeds[-1]) == (1000, 0.02, 0.3)
    text = GOOD.replace(TWO, 'temperature = { from = "90 degC", to = "30 degC", points = 3 }')
    falling = parse_study(text, Path("study.toml")).conditions.temperature
    assert falling == pytest.approx((363.15, 333.15, 303.15), rel=1e-15)


def test_a_cluster_and_what_is_kept_are_read() -> None:
    text = (
        GOOD
        + """
[cluster]
queue = "short"
memory = "1.5 GiB"
walltime = "90 min"
extra = ["--nice=100"]
[outputs]
fields = "none"
formats = ["csv", "zarr"]
"""
    )
    study = parse_study(text, Path("study.toml"))
    assert study.cluster is not None
    assert (study.cluster.memory, study.cluster.walltime, study.cluster.jobs) == (1_610_612_736, 5400, 1)
    assert (study.outputs.fields, study.outputs.formats) == ("none", ("csv", "zarr"))


def test_all_mistakes_are_told_at_once() -> None:
    text = GOOD.replace('"25 N"', '"25 mm"').replace("[indenter]", "[indentr]").replace("points = 3", "points = 1")
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    for field in ("conditions.load", "indentr", "conditions.speed.points"):
        assert field in str(caught.value)


def test_missing_run_file_and_folder_are_told(tmp_path: Path) -> None:
    with pytest.raises(StudyError, match="no such file"):
        load_study(tmp_path / "nothing.toml")
    with pytest.raises(StudyError, match="is a folder"):
        load_study(tmp_path)
