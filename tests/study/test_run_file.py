"""Run files: quantities with units in, every mistake told in a sentence that names the field."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from study.wrong_run_files import BALL, MEASURED, TWO
from viscofric.errors import StudyError
from viscofric.study.run_file.study import load_study, parse_study

GOOD = BALL


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


@pytest.mark.slow
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
formats = ["csv", "excel"]
"""
    )
    study = parse_study(text, Path("study.toml"))
    assert study.cluster is not None
    assert (study.cluster.memory, study.cluster.walltime, study.cluster.jobs) == (1_610_612_736, 5400, 1)
    assert (study.outputs.fields, study.outputs.formats) == ("none", ("csv", "excel"))


def test_all_mistakes_are_reported_at_once() -> None:
    text = GOOD.replace('"25 N"', '"25 mm"').replace("[indenter]", "[indentr]").replace("points = 3", "points = 1")
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    for field in ("conditions.load", "indentr", "conditions.speed.points"):
        assert field in str(caught.value)


def test_missing_run_file_and_folder_have_codes(tmp_path: Path) -> None:
    for path, code in ((tmp_path / "nothing.toml", "no-file"), (tmp_path, "is-folder")):
        with pytest.raises(StudyError) as caught:
            load_study(path)
        assert caught.value.code == code
