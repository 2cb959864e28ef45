"""``viscofric export`` and ``viscofric compare``: what they write and print, and their exit statuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.calls import call, refusal, succeed
from study.sweeps import made_results, made_sweep


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Return two results that differ in their loads, and in accuracy."""
    folder = tmp_path_factory.mktemp("pair")
    made_results(folder / "a", failed=[2])
    made_results(folder / "b", made_sweep(loads=(10.0, 30.0)), accuracy=1e-2)
    return folder / "a", folder / "b"


@pytest.mark.slow
def test_several_formats_are_written_beside_the_results(pair: tuple[Path, Path]) -> None:
    written = [pair[1] / name for name in ("results.csv", "results.xlsx", "prediction.nc")]
    done = succeed("export", pair[1], "--to", "csv", "--to", "excel", "--to", "csv", "--to", "netcdf")
    assert [line.split()[1] for line in done.stdout.splitlines()] == list(map(str, written))
    assert all(path.stat().st_size > 0 for path in written)


@pytest.mark.slow
def test_table_goes_into_a_pipe(pair: tuple[Path, Path], tmp_path: Path) -> None:
    printed = call("export", pair[0], "--to", "csv", "-o", "-").stdout
    call("export", pair[0], "-o", tmp_path / "a.csv")  # its ending names the format
    assert (tmp_path / "a.csv").read_text(encoding="utf-8") == printed
    assert len([line for line in printed.splitlines() if not line.startswith("#")]) == 19


def test_damaged_results_are_reported(tmp_path: Path) -> None:
    (tmp_path / "results.nc").touch()
    for words in (["export", tmp_path, "--to", "csv"], ["report", tmp_path]):
        assert refusal(*words)[:2] == (1, "damaged")


@pytest.mark.slow
def test_the_same_results_compare_as_the_same(pair: tuple[Path, Path]) -> None:
    done = call("compare", pair[0], pair[0] / "results.nc", "--tolerance", 0, "--json")
    found = json.loads(done.stdout)
    assert (done.exit_code, found["equal"], found["cases"]) == (0, True, 18)


@pytest.mark.slow
def test_different_results_are_reported_with_their_provenance(pair: tuple[Path, Path]) -> None:
    done = call("compare", *pair, "--json")
    assert done.exit_code == 1
    found = json.loads(done.stdout)
    assert (found["format"], found["equal"], found["cases"]) == ("viscofric comparison 1", False, 9)
    assert {one["name"] for one in found["differences"]} >= {"friction_coefficient", "indentation", "max_pressure"}


@pytest.mark.slow
def test_what_cannot_be_compared_has_an_exit_status_of_its_own(pair: tuple[Path, Path], tmp_path: Path) -> None:
    done = call("compare", pair[0], tmp_path)
    assert done.exit_code == 2
    assert done.stderr.startswith("Error: ")


def test_report_has_the_exit_status_of_the_run(pair: tuple[Path, Path], tmp_path: Path) -> None:
    for folder, status in ((pair[0], 3), (pair[1], 0)):
        done = call("report", folder, "--out", tmp_path, "--json")
        assert done.exit_code == status, done.output
        found = json.loads(done.stdout)
        assert found["exit_status"] == status
        assert len(found["failures"]) == (1 if status else 0)
        assert done.stderr.count("Failed: ") == (1 if status else 0)


def test_loads_of_line_contacts_are_per_length(tmp_path: Path) -> None:
    """And so they are not compared with those of point contacts."""
    table = "speed (m/s),temperature (K),load (N/m),viscoelastic\n0.1,300,5000,{}\n0.2,300,5000,0.2\n"
    (tmp_path / "point.csv").write_text(table.format(0.1).replace("N/m", "N"), encoding="utf-8")
    for name, friction in (("a.csv", 0.1), ("b.csv", 0.2)):
        (tmp_path / name).write_text(table.format(friction), encoding="utf-8")
    files = tmp_path / "a.csv", tmp_path / "b.csv"
    assert json.loads(call("compare", *files, "--json").output)["load_unit"] == "N/m"
    said = call("compare", *files).output
    assert "5 N/mm" in said
    assert "5000 N" not in said
    assert "5 N/mm" in call("compare", *files, "--out", "-").output
    assert refusal("compare", tmp_path / "point.csv", files[0])[:2] == (2, "other-geometry")
