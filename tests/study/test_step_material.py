"""Materials from creep and relaxation tests: run file, results, files, figures, command."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner

import viscofric as vf
from refusals import refused
from viscofric.cli import main
from viscofric.study.run_file.study import material_of


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
    found = CliRunner().invoke(main, ["check", str(tmp_path / "study.toml"), "--json"])
    assert found.exit_code == 0, found.output
    assert '"isotherms": 3' in found.output


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["creep", "relaxation"])
def test_a_material_is_fitted_to_step_tests(tmp_path, kind):
    path = written(tmp_path, kind)
    arguments = ["material", "fit", str(path), f"--{kind}", "--reference", "10 degC", "--deformation", "tension"]
    arguments += ["--synthetic", "--samples", "20", "-o", str(tmp_path / "out")]
    if kind == "relaxation":  # E(t) states tension
        del arguments[6:8]
    found = CliRunner().invoke(main, arguments)
    assert found.exit_code == 0, found.output
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
    assert "storage_modulus_lower" in results.tree["spectrum_curve"]
    true = vf.synthetic_fluoroelastomer().at("10 degC")
    omega = np.array([1e-2, 1e-1])
    np.testing.assert_allclose(
        abs(vf.read_card(tmp_path / "out" / "rubber.json").complex_modulus(omega)),
        abs(true.complex_modulus(omega)),
        rtol=0.05,
    )


@pytest.mark.parametrize(
    "more",
    [{"shift_by": "storage"}, {"shift_weights": [1.0, 0.5]}, {"dma": "sweeps.csv"}, {"relaxation": "other.csv"}],
)
def test_what_belongs_to_sweeps_is_refused(more):
    with refused("contradiction", vf.StudyError):
        material_of({"creep": "creep.csv", "reference_temperature": "10 degC"} | more)


def test_kinds_on_the_command_line_exclude_each_other(tmp_path):
    path = written(tmp_path)
    found = CliRunner().invoke(
        main, ["material", "fit", str(path), "--creep", "--relaxation", "--reference", "10 degC"]
    )
    assert found.exit_code == 2
    assert "--creep and --relaxation exclude each other" in found.output
