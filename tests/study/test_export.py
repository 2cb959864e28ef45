"""Results for other programs: every number where it belongs, in its unit, and again as it was."""

from __future__ import annotations

import csv
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import python_calamine
import xarray

from refusals import refused
from study.sweeps import friction_of, made_results, made_sweep
from viscofric.errors import DataFileError
from viscofric.files import says_synthetic
from viscofric.study.results import export
from viscofric.study.results.export import FORMS

#: Exports need no results file.
made = partial(made_results, stored=False)


def rows_of(path: Path) -> tuple[list[str], list[dict[str, str]]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    comments = [line for line in lines if line.startswith("#")]
    return comments, list(csv.DictReader(lines[len(comments) :]))


def sheets(path: Path) -> dict[str, list[list[Any]]]:
    book = python_calamine.CalamineWorkbook.from_path(str(path))
    return {name: book.get_sheet_by_name(name).to_python() for name in book.sheet_names}


def test_table_has_a_row_for_each_case_with_units_in_its_headings(tmp_path: Path) -> None:
    sweep = made_sweep(materials=("NBR", "EPDM"), together=False)
    results = made(tmp_path, sweep, failed=[5])
    comments, rows = rows_of(results.to_csv(tmp_path / "cases.csv"))
    assert list(rows[0])[:5] == ["material", "radius (m)", "load (N)", "temperature (degC)", "speed (m/s)"]
    for number, (case, row) in enumerate(zip(sweep.cases, rows, strict=True)):
        assert row["material"] == ("NBR", "EPDM")[case.material]
        assert float(row["temperature (degC)"]) + 273.15 == case.temperature
        assert (float(row["speed (m/s)"]), float(row["load (N)"])) == (case.speed, case.load)
        if number == 5:
            assert (row["friction_coefficient"], row["indentation (m)"], row["failed"]) == ("", "", "1")
        else:  # to the last digit
            assert float(row["friction_coefficient"]) == friction_of(case)
    said = "\n".join(comments)
    for word in ("made-up cases", "synthetic", "dma.csv (SHA-256 000", "viscofric: ", "case 5: accuracy not reached"):
        assert word in said


def test_cases_stepped_together_and_single_coordinates_are_columns(tmp_path: Path) -> None:
    sweep = made_sweep(temperatures=[303.15])
    _, rows = rows_of(made(tmp_path, sweep).to_csv(tmp_path / "cases.csv"))
    assert [(float(row["load (N)"]), float(row["radius (m)"])) for row in rows] == [
        (case.load, case.indenter.radius)  # type: ignore[attr-defined]
        for case in sweep.cases
    ]
    assert {row["temperature (degC)"] for row in rows} == {"30.0"}


def test_workbook_holds_every_table_and_says_what_its_headings_mean(tmp_path: Path) -> None:
    sweep = made_sweep(materials=("NBR", "EPDM / carbon black [50 phr]: a name beyond all bounds"), together=False)
    path = made(tmp_path, sweep, failed=[5]).to_excel(tmp_path / "all.xlsx")
    found = sheets(path)
    assert list(found)[:3] == ["summary", "prediction", "NBR spectrum"]
    assert list(found)[3].startswith("EPDM   carbon black  50 phr")
    heading, *rows = found["prediction"]
    assert heading[:5] == ["material", "radius (m)", "load (N)", "temperature (degC)", "speed (m/s)"]
    place = heading.index("friction_coefficient")
    friction = [row[place] for row in rows]
    assert friction.pop(5) == ""
    # a workbook has 16 digits
    assert friction == pytest.approx(
        [friction_of(case) for number, case in enumerate(sweep.cases) if number != 5], rel=1e-15, abs=0.0
    )
    assert found["NBR spectrum"][1:] == [[1e-3, 1e-7], [1.0, 2e-7]]
    said = [row[1:] for row in found["values"] if row[0] == "NBR spectrum"]
    numbers = [["E0", 3e6], ["range", 1.5], ["range", 2.5]]  # an error that is not known is left out
    assert said == [*numbers, ["statements", "One."], ["statements", "Another."]]
    meanings = {row[0]: row[1:] for row in found["variables"]}
    assert meanings["max_pressure"] == ["Pa", "largest contact pressure"]
    # what begins like a formula stays the text that it is
    assert ["warning", "=1+1 is no formula."] in [row[:2] for row in found["summary"]]


def test_workbooks_of_synthetic_data_say_so(tmp_path: Path) -> None:
    for origin in ("synthetic", "measured"):
        results = made(tmp_path)
        results.tree.attrs["data_origin"] = origin
        assert says_synthetic(results.to_excel(tmp_path / "all.xlsx")) is (origin == "synthetic")


def test_headings_stay_in_sight(tmp_path: Path) -> None:
    import zipfile

    path = made(tmp_path).to_excel(tmp_path / "all.xlsx")
    with zipfile.ZipFile(path) as archive:
        page = archive.read("xl/worksheets/sheet2.xml").decode()
    assert '<pane xSplit="4" ySplit="1"' in page  # load, radius, temperature and speed
    assert "<autoFilter" in page


def test_the_same_results_make_the_same_files(tmp_path: Path) -> None:
    results = made(tmp_path)
    for write, name in ((results.to_csv, "a.csv"), (results.to_excel, "a.xlsx")):
        once, again = (write(tmp_path / f"{number}{name}").read_bytes() for number in (1, 2))
        assert once == again


def test_more_cases_than_a_sheet_has_rows_are_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(export, "MOST_ROWS", 10)
    with refused("too-many-rows"):
        made(tmp_path).to_excel(tmp_path / "all.xlsx")


@pytest.mark.slow
def test_labelled_cases_come_back_from_another_format(tmp_path: Path) -> None:
    results = made(tmp_path, made_sweep(materials=("NBR", "EPDM"), together=False), failed=[3])
    for _ in range(2):  # the second time in place of the first
        path = results.export("netcdf")
    with xarray.open_dataset(path, engine="netcdf4") as found:
        xarray.testing.assert_equal(found.load(), results.dataset)
        assert found.attrs["viscofric_version"] == results.tree.attrs["viscofric_version"]
        assert found["max_pressure"].attrs["units"] == "Pa"
    assert path.parent == tmp_path
    assert not list(tmp_path.glob(".*"))


def test_nothing_else_is_replaced(tmp_path: Path) -> None:
    results = made(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "precious.txt").touch()
    for form in FORMS:
        with pytest.raises(DataFileError):
            results.export(form, tmp_path / "folder")
        with refused("results-file"):
            results.export(form, tmp_path / "results.nc")
    assert (tmp_path / "folder" / "precious.txt").exists()
    with refused("wrong-choice", naming=("form", "'csv'", "'excel'")):
        results.export("xml")  # type: ignore[arg-type]


def test_places_of_measured_points_come_first(tmp_path: Path) -> None:
    """Groups that are not over axes hold their places as variables."""
    from viscofric.study.results.columns import columns_of

    places = {"viscoelastic": ("point", [0.1]), "temperature": ("point", [303.15], {"units": "K"})}
    names, units, columns = columns_of(xarray.Dataset({**places, "speed": ("point", [np.nan])}))
    assert (names, units, columns) == (
        ["temperature", "speed", "viscoelastic"],
        ["degC", "1", "1"],
        [[30.0], [None], [0.1]],
    )
