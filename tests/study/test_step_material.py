"""Materials from creep and relaxation tests: run file, results, files, figures, command."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from cli.calls import call, succeed
from refusals import refused
from rheology.planted import write_moduli
from viscofric.notes import codes
from viscofric.rheology.catalogue import is_synthetic
from viscofric.study.make_rubber import make_rubber
from viscofric.study.rubber import rubber_at
from viscofric.study.rubber_datasets import rubber_groups
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.study import validated


def written(folder, kind="creep", celsius=(0.0, 10.0, 20.0)):
    """Write synthetic tests at three temperatures."""
    material = vf.synthetic_fluoroelastomer()
    time = np.logspace(0.0, 3.0, 25)
    unit = "J(t) (1/MPa)" if kind == "creep" else "E(t) (MPa)"
    rows = [f"T (degC);t (s);{unit}"]
    for one in celsius:
        spectrum = material.at(one + 273.15)
        response = (
            1e6 * spectrum.creep_compliance(time) if kind == "creep" else 1e-6 * spectrum.relaxation_modulus(time)
        )
        rows += [f"{one};{t:.8g};{r:.8g}" for t, r in zip(time, response, strict=True)]
    path = folder / f"{kind}.csv"
    path.write_text("\n".join(rows) + "\n")
    return path


STUDY = """title = "Creep"
data_origin = "synthetic"
[material]
creep = "creep.csv"
deformation = "tension"
reference_temperature = "10 degC"
[indenter]
radius = "10 mm"
[conditions]
load = "1 N"
speed = ["1 mm/s", "10 mm/s"]
temperature = "10 degC"
"""


@pytest.mark.slow
def test_a_run_file_takes_creep_tests(tmp_path):
    written(tmp_path)
    (tmp_path / "study.toml").write_text(STUDY)
    found = succeed("check", tmp_path / "study.toml", "--json")
    assert '"isotherms": 3' in found.output


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["creep", "relaxation"])
def test_a_material_is_fitted_to_step_tests(tmp_path, monkeypatch, kind):
    # figures are drawn, but not turned into images: tests of the report look at them
    monkeypatch.setattr("viscofric.report.figures.saving._encoded", lambda figure, form: form.encode())
    path = written(tmp_path, kind)
    arguments = ["material", "fit", str(path), f"--{kind}", "--reference", "10 degC", "--deformation", "tension"]
    arguments += ["--synthetic", "--samples", "20", "-o", str(tmp_path / "out")]
    if kind == "relaxation":  # E(t) states tension
        del arguments[6:8]
    succeed(*arguments)
    for name in (
        "rubber.json",
        "shift_factors.csv",
        "master_curve.csv",
        "figures/step_master_curve.svg",
        "report.html",
    ):
        assert (tmp_path / "out" / name).is_file(), name
    results = vf.open_results(tmp_path / "out")
    curve = results.tree["step_master_curve"]
    name = "creep_compliance" if kind == "creep" else "relaxation_modulus"
    assert curve[name].attrs["units"] == ("1/Pa" if kind == "creep" else "Pa")
    assert curve.attrs["rms_log10_step"] < 0.005
    assert results.tree.attrs["step_tests"] == kind
    assert is_synthetic(vf.read_card(tmp_path / "out" / "rubber.json"))
    assert "storage_modulus_lower" in results.tree["spectrum_curve"]
    true = vf.synthetic_fluoroelastomer().at("10 degC")
    omega = np.array([1e-2, 1e-1])
    np.testing.assert_allclose(
        abs(vf.read_card(tmp_path / "out" / "rubber.json").complex_modulus(omega)),
        abs(true.complex_modulus(omega)),
        rtol=0.05,
    )


@pytest.mark.parametrize("kind", ["creep", "relaxation"])
def test_a_test_at_one_temperature_is_its_own_master_curve(tmp_path, kind):
    chosen = {kind: str(written(tmp_path, kind, (10.0,))), "deformation": "tension", "reference_temperature": "10 degC"}
    made = make_rubber(validated(MaterialTable, chosen))
    groups = rubber_groups(made)
    assert {"/step_tests", "/step_master_curve"} <= set(groups)
    assert "/superposition" not in groups
    assert not made.material.has_shift_factors
    assert made.material.reference == pytest.approx(283.15)
    inside = np.geomspace(5e-3, 0.3, 5)
    planted = vf.synthetic_fluoroelastomer().complex_modulus(inside, "10 degC")
    # data of eight digits, and what a lattice of modes leaves
    np.testing.assert_allclose(abs(made.material.complex_modulus(inside)), abs(planted), rtol=0.03)
    factors = vf.ShiftFactors(["0 degC", "10 degC", "20 degC"], [1.0, 0.0, -0.9], "10 degC")
    factors.save(tmp_path / "factors.csv")
    shifted = make_rubber(validated(MaterialTable, chosen | {"shift_factors": str(tmp_path / "factors.csv")}))
    assert shifted.material.shift.log10("20 degC") == pytest.approx(-0.9)


def test_a_material_of_one_temperature_is_taken_there_alone(tmp_path):
    """Made from a file, and read back from the material file: by Python, commands and run files in the same way."""
    table = {"creep": str(written(tmp_path, "creep", (10.0,))), "deformation": "tension"}
    made = make_rubber(validated(MaterialTable, table | {"reference_temperature": "10 degC"}))
    file = vf.write_card(made.material, tmp_path / "rubber.json", "json")
    for material in (made, make_rubber(validated(MaterialTable, {"file": str(file)}))):
        known = rubber_at(material, [283.15])
        assert known.material.reference == pytest.approx(283.15)
        assert not codes(known.notes) & {"temperature-assumed"}
        with refused("outside-measured"):
            rubber_at(material, [283.15, 303.15])


def test_a_material_of_an_unknown_temperature_is_taken_at_the_one_of_the_study():
    unknown = make_rubber(validated(MaterialTable, {"catalogue": "VHB 4910"}))
    known = rubber_at(unknown, [303.15])
    assert known.material.reference == pytest.approx(303.15)
    (note,) = (note for note in known.notes if note.code == "temperature-assumed")
    assert note.values == {"temperature": pytest.approx(303.15)}
    with refused("no-shift"):
        rubber_at(unknown, [303.15, 313.15])


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ({"reference_temperature": "20 degC"}, "reference-outside"),
        ({"shift": "wlf"}, "contradiction"),
        ({"vertical_shift": "density"}, "contradiction"),
    ],
)
def test_what_a_test_at_one_temperature_cannot_have_is_refused(tmp_path, more, code):
    chosen = {"creep": str(written(tmp_path, celsius=(10.0,))), "deformation": "tension"}
    with refused(code):
        make_rubber(validated(MaterialTable, chosen | {"reference_temperature": "10 degC"} | more))


@pytest.mark.parametrize(
    "more",
    [
        {"shift_by": "storage"},
        {"shift_weights": [1.0, 0.5]},
        {"leave_out_temperatures": "10 degC"},
        {"ramps": "ramp.csv"},
        {"relaxation": "other.csv"},
        {"dma": "sweeps.csv", "relaxation": "other.csv"},
        {"dma": "sweeps.csv", "temperature": "10 degC"},
        {"dma": "sweeps.csv", "columns": {"temperature": "T (degC)"}},
        {"dma": "sweeps.csv", "shift_factors": "alpha.csv"},
        {"dma": "sweeps.csv", "vertical_shift": "free"},
    ],
)
def test_what_belongs_to_sweeps_is_refused(more):
    with refused("contradiction", vf.StudyError):
        validated(MaterialTable, {"creep": "creep.csv", "reference_temperature": "10 degC"} | more)


def test_kinds_on_the_command_line_exclude_each_other(tmp_path):
    path = written(tmp_path)
    found = call("material", "fit", path, "--creep", "--relaxation", "--reference", "10 degC")
    assert found.exit_code == 2
    assert all(option in found.output for option in ("--creep", "--relaxation"))


@pytest.mark.slow
def test_sweeps_and_creep_make_one_material(tmp_path):
    """Sweeps reach 0.6 rad/s at the warmest temperature; creep continues three decades below."""
    true = vf.synthetic_fluoroelastomer()
    sweeps = write_moduli(
        tmp_path / "sweeps.csv", true.complex_modulus, (-5.0, 0.0, 5.0, 10.0), np.logspace(-1.0, 1.0, 13)
    )
    chosen = {"dma": str(sweeps), "creep": str(written(tmp_path)), "reference_temperature": "10 degC"}
    made = make_rubber(validated(MaterialTable, chosen | {"deformation": "tension"}))
    groups = rubber_groups(made)
    assert {"/isotherms", "/master_curve", "/step_tests", "/step_master_curve"} <= set(groups)
    assert groups["/shift_factors"].attrs["isotherms_used"] == groups["/shift_factors"].attrs["isotherms_given"] == 5
    both = np.array([3e-3, 1e-1, 1e2])  # creep alone, both, sweeps alone
    planted = true.complex_modulus(both, "10 degC")
    # data of nine digits; what superposition of few isotherms and a lattice of modes leave
    np.testing.assert_allclose(abs(made.material.complex_modulus(both)), abs(planted), rtol=0.03)


def test_the_command_takes_creep_beside_sweeps(monkeypatch):
    tables = []

    def keep(table, *_, **__):
        tables.append(table)
        raise vf.InputError("enough")

    monkeypatch.setattr("viscofric.study.rubber_results.run_material", keep)
    arguments = ["material", "fit", "sweeps.csv", "--with-creep", "a.csv", "--with-creep", "b.csv"]
    assert call(*arguments, "--reference", "10 degC").exit_code == 1
    (table,) = tables
    assert (table.dma, table.creep, table.relaxation) == ((Path("sweeps.csv"),), (Path("a.csv"), Path("b.csv")), None)
