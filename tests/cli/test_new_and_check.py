"""``viscofric new`` and ``viscofric check``: starter files that are right, mistakes that are all told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.calls import call, refusal, succeed
from viscofric import open_results
from viscofric.cli.check import duration
from viscofric.cli.new import SCHEMA, TEMPLATES, template_text
from viscofric.report.texts.checks import all_checks
from viscofric.study.results.export import NAMES

#: A run file up to the keys of its surface.
ROUGH = """[material]
catalogue = "synthetic fluoroelastomer"
[conditions]
pressure = "50 kPa"
speed = "1 mm/s"
temperature = "30 degC"
[surface]
"""


@pytest.mark.parametrize("template", TEMPLATES)
@pytest.mark.slow
def test_starter_files_and_their_data_are_right(tmp_path: Path, template: str) -> None:
    succeed("new", tmp_path, "--template", template)
    result = call("check", tmp_path / "study.toml", "--json")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    points = [len(next(iter(columns.values()))) for columns in found["axes"].values()]
    cases = 1
    for count in points:
        cases *= count
    assert found["cases"] == cases
    assert (found["surface"] is not None) == ("[surface]" in template_text(template))
    assert (found["measured_points"] is not None) == ("[measurement]" in template_text(template))
    checked = {check["name"] for one in found["materials"] for check in one["checks"]}
    assert ("Superposition" in checked) == ("dma.csv" in template_text(template))
    # Only what the run file names is written beside it.
    data = {path.name for path in tmp_path.iterdir()} - {"study.toml"}
    assert data == {name for name in ("dma.csv", "mtm.csv") if f'"{name}"' in template_text(template)}


def test_a_surface_is_checked_for_points_in_its_shortest_wave(tmp_path: Path) -> None:
    surface = {"hurst": 0.8, "rms_height": "2 um", "shortest": "20 um", "rolloff": "100 um", "points": 64, "seed": 1}
    lines = [f"{name} = {json.dumps(value)}" for name, value in surface.items()]
    for spacing, few in (("5 um", True), ("2.5 um", False)):
        given = ROUGH + "\n".join([*lines, f'spacing = "{spacing}"'])
        found = json.loads(call("check", "-", "--json", given=given).stdout)["surface"]
        assert found["points"] == [64, 64]
        assert found["rms_height"] == pytest.approx(2e-6)  # exact by its definition
        assert found["points_in_shortest_wave"] == pytest.approx(4.0 if few else 8.0)
        assert ("needed" in call("check", "-", given=given).stdout) == few


def test_a_scan_without_a_unit_is_noted_with_its_steps(tmp_path: Path) -> None:
    rows = [",".join(f"{1.0 + (i * j) % 5}" if i != j else "" for j in range(8)) for i in range(8)]
    (tmp_path / "scan.csv").write_text("\n".join(rows))
    scan = 'file = "scan.csv"\nspacing = "1 mm"\nprepare = ["fill", "window"]\n'
    (tmp_path / "study.toml").write_text(ROUGH + scan)
    found = json.loads(call("check", tmp_path / "study.toml", "--json").stdout)
    assert {"unit-assumed", "implausible-heights", "filled"} <= {one["code"] for one in found["note_records"]}


@pytest.mark.apart
@pytest.mark.timeout(600)
@pytest.mark.parametrize("template", TEMPLATES)
def test_starter_files_keep_what_they_promise(tmp_path: Path, template: str) -> None:
    call("new", tmp_path, "--template", template)
    study = tmp_path / "study.toml"
    # what is promised does not depend on the number of samples of the material
    text = study.read_text(encoding="utf-8").replace("draws = 200", "draws = 20").replace("members = 20", "members = 2")
    study.write_text(text, encoding="utf-8")
    result = call("run", study, "--json")
    assert result.exit_code == 0, result.output
    finished = json.loads(result.stdout.splitlines()[-1])
    assert (finished["failures"], finished["beyond_accuracy"]) == ([], 0)
    results = open_results(tmp_path / "study.results")
    verdicts = {check.name: check.verdict for check in all_checks(results.tree)}
    for name in ("Energy balance", "Contact conditions", "All cases solved", "Accuracy"):
        assert verdicts[name] == "passed", name
    assert verdicts.get("Half-space", "noted") != "warning"
    said = result.stderr.splitlines()
    assert len(set(said)) == len(said)


@pytest.mark.slow
def test_check_says_how_much_is_asked_for(tmp_path: Path) -> None:
    call("new", tmp_path, "--template", "sweep")
    result = call("check", tmp_path / "study.toml")
    assert result.exit_code == 0, result.output
    found = json.loads(call("check", tmp_path / "study.toml", "--json").stdout)
    counts = {name: len(next(iter(axis.values()))) for name, axis in found["axes"].items()}
    assert counts == {"material": 2, "sample": 1, "load_radius": 3, "temperature": 4, "speed": 31}
    assert found["cases"] == 744
    assert f"cases      {found['cases']} = " in result.stdout
    assert {"csv", "excel"} < set(found["outputs"])
    assert [one["synthetic"] for one in found["materials"]] == [True, True]  # the catalogue and the file say so
    assert "Note: " in result.stderr
    # Three balls under one nominal pressure are three of one family: a curve for each rubber, far fewer than its cases.
    assert 10 < found["expected"]["solves"] < 200
    assert not (tmp_path / "study.results").exists()


def test_run_file_comes_from_standard_input_and_goes_to_standard_output() -> None:
    written = call("new", "-", "--template", "layer")
    assert written.stdout == template_text("layer")
    result = call("check", "-", "--json", given=written.stdout)
    assert result.exit_code == 0, result.output
    assert json.loads(result.stdout)["axes"]["thickness"]["thickness"] == pytest.approx([1e-3, 2e-3, 5e-3])
    assert refusal("check", "-", given=b"\xff\xfe")[:2] == (1, "not-utf8")


def test_check_shows_all_mistakes_at_once(tmp_path: Path) -> None:
    text = template_text("ball").replace('"10 N"', '"10 mm"').replace("[solver]", "[solvr]")
    (tmp_path / "study.toml").write_text(text.replace('"90 degC"', '"-300 degC"'), encoding="utf-8")
    found = refusal("check", tmp_path / "study.toml")
    assert (found.status, found.code) == (1, "several-mistakes")
    _, *lines = found.sentence.splitlines()
    assert [line.split(":")[0] for line in lines] == ["  conditions.load", "  conditions.temperature[2]", "  solvr"]


def test_check_shows_what_is_wrong_with_every_data_file(tmp_path: Path) -> None:
    text = template_text("measured").replace("dma.csv", "no.csv").replace("mtm.csv", "none.csv")
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    found = refusal("check", tmp_path / "study.toml")
    assert (found.status, found.code) == (1, "several-mistakes")
    assert len(found.sentence.splitlines()) == 3
    assert all(name in found.sentence for name in ("no.csv", "none.csv"))


def test_check_names_the_files_that_a_study_writes(tmp_path: Path) -> None:
    text = template_text("layer") + '\n[outputs]\nformats = ["csv", "excel"]\n'
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    (line,) = (one for one in call("check", tmp_path / "study.toml").stdout.splitlines() if one.startswith("writes"))
    assert set(NAMES.values()) - {NAMES["netcdf"]} <= set(line.replace(",", "").split())


@pytest.mark.slow
def test_check_shows_a_temperature_without_a_shift_factor(tmp_path: Path) -> None:
    call("new", tmp_path, "--template", "ball")
    text = (tmp_path / "study.toml").read_text(encoding="utf-8").replace('"90 degC"', '"400 degC"')
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    assert refusal("check", tmp_path / "study.toml")[:3] == (1, "outside-measured", "conditions.temperature")


def test_schema_is_printed_or_written_beside_the_run_file(tmp_path: Path) -> None:
    printed = call("new", "--schema")
    assert printed.exit_code == 0
    assert json.loads(printed.stdout)["title"] == "Run file of viscofric"
    succeed("new", tmp_path, "--schema")
    assert (tmp_path / SCHEMA).read_text(encoding="utf-8") == printed.stdout
    text = (tmp_path / "study.toml").read_text(encoding="utf-8")
    assert text.startswith(f"#:schema ./{SCHEMA}\n")
    assert text.endswith(template_text("example"))


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.2, "about a second"),
        (97.0, "about 97 seconds"),
        (130.0, "about 2 minutes"),
        (7100.0, "about 120 minutes"),
        (1e4, "about 3 hours"),
        (1e7, "about 120 days"),
    ],
)
def test_times_are_reported_roughly(seconds: float, words: str) -> None:
    assert duration(seconds) == words


def test_each_case_solved_is_each_case_expected(tmp_path: Path) -> None:
    call("new", tmp_path, "--template", "ball")
    text = (tmp_path / "study.toml").read_text(encoding="utf-8").replace("[solver]", '[solver]\ncases = "each"')
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    found = json.loads(call("check", tmp_path / "study.toml", "--json").stdout)
    assert (found["cases"], found["expected"]["solves"]) == (93, 93)


def test_jobs_that_are_too_small_are_reported() -> None:
    text = template_text("layer") + '[cluster]\njobs = 2\ncores = 64\nmemory = "1 GB"\nwalltime = "10 ms"\n'
    assert refusal("check", "-", given=text).field == "cluster.walltime"
    result = call("check", "-", given=text.replace("10 ms", "1 s").replace("1e-2", "1e-4"))
    assert result.exit_code == 0, result.output
    assert "Note: " in result.stderr


def test_new_needs_a_folder() -> None:
    assert call("new").exit_code == 2


SOFT = """
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "2 mm"
[conditions]
load = {load}
speed = ["1 mm/s", "1 m/s"]
temperature = "60 degC"
[solver]
accuracy = 0.05
"""


@pytest.mark.slow
def test_check_warns_of_the_cases_that_fail_since_the_material_is_too_soft(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(SOFT.format(load='["25 N", "2000 N"]'), encoding="utf-8")
    (note,) = [one for one in json.loads(call("check", path, "--json").stdout)["note_records"] if one["code"]]
    assert (note["code"], note["values"]["cases"], note["values"]["of"]) == ("beyond-indenter", 2, 4)
    done = call("run", path, "--json")
    assert done.exit_code == 3
    failed = json.loads(done.stdout.splitlines()[-1])["failure_records"]
    assert [one["code"] for one in failed] == ["beyond-indenter"] * 2
    # the width that the solver finds, 15.8 mm, within a tenth
    assert abs(note["values"]["width"] / 0.0158 - 1.0) < 0.1
    path.write_text(SOFT.format(load='"25 N"'), encoding="utf-8")
    assert json.loads(call("check", path, "--json").stdout)["note_records"] == []
