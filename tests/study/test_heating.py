"""Studies with [heating]: every case at the temperature of its own friction, its axes, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import ConvergenceError, StudyError
from viscofric.friction.cases.case import Rubbers
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.notes import codes
from viscofric.report.captions import captions
from viscofric.report.figures.heating import heated_parts_figure, heating_figure, temperature_map_figure
from viscofric.report.figures.histories import histories_figure
from viscofric.report.texts.study import scope
from viscofric.rheology.shifts.vertical_shift import DensityShift
from viscofric.rheology.spectra.quality import BEYOND, SpectrumFit
from viscofric.study.cases import heating as cases
from viscofric.study.checking import check_study
from viscofric.study.histories import Histories, material_notes
from viscofric.study.results.columns import columns_of
from viscofric.study.run_file.study import parse_study
from viscofric.thermal import FILLED_RUBBER, PTFE, STEEL

BASE = """
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
shape = "cylinder"
radius = "10 mm"
[conditions]
load = "500 N/m"
speed = ["50 mm/s", "200 mm/s"]
temperature = ["60 degC", "90 degC"]
[solver]
accuracy = 0.1
cases = "each"
[outputs]
fields = "none"
"""
HEATING = '[heating]\ncounterface = "PTFE"\ncoulomb = [0.2, 0.5]\naverage = "contact"\n'
ROUGH = """
[material]
catalogue = "synthetic fluoroelastomer"
[surface]
hurst = 0.8
points = 16
spacing = "1 um"
shortest = "4 um"
rms_slope = 0.1
seed = [0, 1]
[conditions]
pressure = "100 kPa"
speed = ["50 mm/s", "200 mm/s"]
temperature = "60 degC"
[solver]
cases = "each"
[outputs]
fields = "none"
"""
ROUGH_HEAT = '[heating]\ncounterface = "steel"\nnominal_radius = "5 mm"\n'
BALL = BASE.replace('shape = "cylinder"\n', "").replace("500 N/m", "2 N")


def run(folder: Path, text: str, base: str = BASE) -> vf.study.StudyResults:
    path = folder / "study.toml"
    path.write_text(base + text, encoding="utf-8")
    return vf.run_study(path)


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> vf.study.StudyResults:
    return run(tmp_path_factory.mktemp("heating"), HEATING)


@pytest.mark.slow
def test_every_case_is_heated_by_each_coulomb_friction(results: vf.study.StudyResults) -> None:
    """The same numbers as those of the Python interface, to all digits."""
    data = results.tree["heating"].to_dataset()
    assert dict(data.sizes) == {"temperature": 2, "speed": 2, "coulomb": 2}
    direct = vf.predict_friction(
        vf.synthetic_fluoroelastomer(),
        vf.Cylinder("10 mm"),
        speeds=[0.05, 0.2],
        temperatures="90 degC",
        load="500 N/m",
        accuracy=0.1,
        heating=vf.Heating(rubber=FILLED_RUBBER, counterface=PTFE, coulomb=0.5, average="contact"),
    )
    assert isinstance(direct, vf.friction.HeatedFrictionCurves)
    found = data.isel(temperature=1, coulomb=1)
    np.testing.assert_array_equal(found["friction_coefficient"], direct.viscoelastic)
    np.testing.assert_array_equal(found["temperature_rise"], direct.temperature_rise)
    np.testing.assert_array_equal(found["isothermal_friction"], direct.isothermal_friction)
    np.testing.assert_array_equal(found["isothermal_friction"], results.dataset["friction_coefficient"][1])
    np.testing.assert_allclose(data["total_friction"], data["friction_coefficient"] + data["coulomb"])
    assert np.all(data["temperature_rise"].diff("coulomb") > 0.0)
    assert "thin-skin" in codes(results.warnings)


@pytest.mark.slow
def test_the_heat_of_the_largest_coulomb_friction_is_checked(results: vf.study.StudyResults) -> None:
    """As of the same isothermal contacts in Python; a half-space of ν = ½ does not feel the shear."""
    data = results.dataset
    found = results.tree["assumptions"].to_dataset().set_index(assumption="assumption_name")
    speed, kelvin = (np.ravel(one) for one in np.meshgrid([0.05, 0.2], [333.15, 363.15]))
    zeros = np.zeros(4)
    curves = vf.FrictionCurves(
        speed,
        kelvin,
        np.full(4, 500.0),
        data["friction_coefficient"].values.ravel(),
        *(zeros, zeros, np.ones(4, dtype=int)),
        load_unit="N/m",
        coulomb=np.full(4, 0.5),
        slip=speed,
    )
    half = 0.5 * (data["front"] + data["rear"]).values.ravel()
    direct = vf.check_assumptions(
        vf.synthetic_fluoroelastomer(), vf.Cylinder("10 mm"), curves, contact_radius=half, counterbody=PTFE
    )
    values = {check.name: check.value for check in direct}
    assert values["one temperature"] > 0.05  # by Coulomb heat: without it 0.001
    assert found["value"].sel(assumption="one temperature") == pytest.approx(values["one temperature"], rel=1e-9)
    assert found["value"].sel(assumption="uncoupled") == values["uncoupled"] == 0.0


@pytest.mark.slow
def test_tables_keep_a_rise_of_temperature_in_kelvin(results: vf.study.StudyResults) -> None:
    data = results.tree["heating"].to_dataset()
    names, units, columns = columns_of(data)
    table = dict(zip(names, zip(units, columns, strict=True), strict=True))
    assert table["temperature"] == ("degC", [60.0] * 4 + [90.0] * 4)
    assert table["temperature_rise"] == ("K", data["temperature_rise"].values.ravel().tolist())


@pytest.mark.slow
def test_the_map_is_that_of_the_warmest_contact(results: vf.study.StudyResults) -> None:
    """Its mean over the contact on 40 cells is the rise of the face, found on 18 cells to 1 %; it is warmest inside."""
    data, curves = (results.tree[name].to_dataset() for name in ("temperature_map", "heating"))
    mean = float((data["rise"] * data["contact"]).sum() / data["contact"].sum())
    assert data.attrs["face_rise"] == float(curves["face_rise"].max())
    assert mean == pytest.approx(data.attrs["face_rise"], rel=0.01)
    assert float(data["contact"].values.ravel()[data["rise"].values.argmax()]) == 1.0
    assert data["rise"][0] > data["rise"][-1] >= 0.0  # warm behind, cold ahead


@pytest.mark.slow
def test_the_report_shows_heat_and_says_what_is_given(results: vf.study.StudyResults) -> None:
    figure = heating_figure(results.tree)
    assert figure is not None
    assert figure.axes[0].get_title() == "60 °C, Coulomb friction 0.2"
    parts = heated_parts_figure(results.tree)
    assert parts is not None
    assert len(parts.axes) == 3  # of four curves
    assert temperature_map_figure(results.tree) is not None
    said = captions(results.tree)
    assert "3 of 4" in said["heated_friction"]
    assert "as given" in said["heated_parts"]
    assert "handbook" in scope(results.tree)[-1]


@pytest.mark.slow
def test_rough_surfaces_are_heated_too(tmp_path_factory: pytest.TempPathFactory) -> None:
    """The same numbers as those of the Python interface, to all digits, on each seed; the heat of an interface."""
    heated = run(tmp_path_factory.mktemp("given"), ROUGH_HEAT + "coulomb = [0.1, 0.3]\n", ROUGH)
    data = heated.tree["heating"].to_dataset()
    assert dict(data.sizes) == {"seed": 2, "speed": 2, "coulomb": 2}
    made = {"spacing": "1 um", "shortest": "4 um", "rms_slope": 0.1}
    asked = {"speeds": [0.05, 0.2], "temperatures": "60 degC", "pressure": "100 kPa", "tolerance": 1e-7}
    bodies = {"rubber": FILLED_RUBBER, "counterface": STEEL, "nominal_radius": "5 mm"}
    rubber, track = vf.synthetic_fluoroelastomer(), vf.self_affine(0.8, shape=(16, 16), seed=1, **made)
    direct = vf.predict_rough_friction(rubber, track, **asked, heating=vf.Heating(**bodies, coulomb=0.3))
    assert isinstance(direct, vf.roughness.HeatedRoughFriction)
    found = data.isel(seed=1, coulomb=1)
    np.testing.assert_array_equal(found["friction_coefficient"], direct.friction_coefficient[0, :, 0])
    np.testing.assert_array_equal(found["temperature_rise"], direct.temperature_rise[0, :, 0])
    isothermal = data["isothermal_friction"].isel(coulomb=0)
    np.testing.assert_array_equal(isothermal, heated.dataset["friction_coefficient"])
    assert "temperature_map" not in heated.tree
    assert "mean-heat-left-out" not in codes(heated.warnings)
    assert heating_figure(heated.tree) is not None
    parts = heated_parts_figure(heated.tree)
    assert parts is not None
    assert len(parts.axes) == 3  # of four curves
    law = '[interface]\nlaw = "constant"\nstress = "1 MPa"\n'
    folder = tmp_path_factory.mktemp("interface")
    rubbed = run(folder, law + ROUGH_HEAT, ROUGH.replace("[0, 1]", "0")).tree["heating"].to_dataset()
    np.testing.assert_allclose(rubbed["interface_friction"], 1e6 / rubbed["mean_pressure"])
    assert rubbed.attrs["heat_of"] == "interface"


@pytest.mark.slow
def test_an_interface_makes_the_heat_and_is_warm_itself(tmp_path: Path) -> None:
    """A shear stress that does not depend on temperature, on the contact of the heated case."""
    text = '[interface]\nlaw = "constant"\nstress = "0.2 MPa"\nslip = "0.1 m/s"\n[heating]\ncounterface = "steel"\n'
    base = BASE.replace('["60 degC", "90 degC"]', '"60 degC"')
    data = run(tmp_path, text, base).tree["heating"].to_dataset()
    np.testing.assert_allclose(data["interface_friction"], 0.2e6 / data["mean_pressure"])
    np.testing.assert_allclose(data["total_friction"], data["friction_coefficient"] + data["interface_friction"])
    assert float(data["slip"]) == 0.1
    assert data.attrs["heat_of"] == "interface"


def test_heated_contacts_at_frequencies_that_were_not_measured_are_noted() -> None:
    case: Any = IndenterCase(0, vf.Cylinder("10 mm"), 333.15, 0.05, 500.0)
    contact = {"indenter": case.indenter, "temperature": 333.15, "load": 500.0, "accuracy": 0.1}
    heating = vf.Heating(rubber=FILLED_RUBBER, counterface=STEEL)
    rubber = vf.synthetic_fluoroelastomer()

    def noted(low: float, high: float) -> tuple[str, ...]:
        fit = SpectrumFit(None, None, False, False, (low, high), notes=("Of the fit.",))
        known = replace(rubber, spectrum=replace(rubber.modes_at(), fit=fit))
        lean = Rubbers([known], {}).without_notes(case)
        record = cases.solve_heated(lean, speeds=(0.05,), heating=heating, **contact)
        curves = vf.predict_friction(
            known, speeds=0.05, temperatures=333.15, heating=heating,
            **{name: value for name, value in contact.items() if name != "temperature"},
        )  # fmt: skip
        assert record.warnings == tuple(str(one) for one in curves.notes if one.code == BEYOND)
        return record.warnings

    assert noted(1e-9, 1e9) == ()
    assert len(noted(1e-9, 1e-6)) == 1


@pytest.mark.slow
def test_a_speed_without_a_solution_leaves_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = cases.predict_friction

    def refuse_fast(*arguments, **given):
        if np.max(given["speeds"]) > 0.1:
            raise ConvergenceError("too fast", code="not-converged")
        return whole(*arguments, **given)

    monkeypatch.setattr(cases, "predict_friction", refuse_fast)
    heating = vf.Heating(rubber=FILLED_RUBBER, counterface=STEEL)
    contact = {"indenter": vf.Cylinder("10 mm"), "temperature": 333.15, "load": 500.0, "accuracy": 0.1}
    rubber = vf.synthetic_fluoroelastomer()
    record = cases.solve_heated(rubber, speeds=(0.05, 0.2), heating=heating, **contact)
    assert record.columns["speed"].values == [0.05]
    assert len(record.warnings) == 1
    with pytest.raises(ConvergenceError):
        cases.solve_heated(rubber, speeds=(0.2, 0.3), heating=heating, **contact)


@pytest.mark.parametrize(
    ("text", "base", "place"),
    [
        ("[heating]\n", BASE, "heating.counterface"),
        ('[heating]\ncounterface = "stele"\n', BASE, "heating.counterface"),
        ('[heating]\ncounterface = "46 W/m/K, 7810 kg/m^3"\n', BASE, "heating.counterface"),
        ('[heating]\ncounterface = "46 W/m/K, -2 mm^2/s"\n', BASE, "heating.counterface"),
        ("[heating]\ncounterface = 46\n", BASE, "heating.counterface"),
        (HEATING.replace("0.2", "-0.2"), BASE, "heating.coulomb"),
        (HEATING.replace("0.2", "0.5"), BASE, "heating.coulomb"),
        (HEATING + "passes = 3\n", BALL, "heating.passes"),
        (HEATING + 'passes = 1.5\ntrack_radius = "2 cm"\n', BALL, "heating.passes"),
        (HEATING + 'track_radius = "2 cm"\n', BALL, "heating.track_radius"),
        (HEATING + 'passes = inf\ntrack_radius = "2 cm"\n', BASE, "heating.passes"),
        (HEATING + 'nominal_radius = "5 mm"\n', BALL, "heating.nominal_radius"),
        (HEATING + 'passes = 3\ntrack_radius = "2 cm"\n', ROUGH, "heating.nominal_radius"),
        (HEATING + '[layer]\nthickness = "5 mm"\n', BASE, "heating"),
        (HEATING + '[interface]\nlaw = "constant"\nstress = "1 MPa"\n', BASE, "heating.coulomb"),
        (
            '[heating]\ncounterface = "PTFE"\nslip = "1 m/s"\n[interface]\nlaw = "constant"\nstress = "1 MPa"\n',
            BASE,
            "heating.slip",
        ),
    ],
)
def test_contradictions_are_found_before_anything_is_solved(text: str, base: str, place: str, tmp_path: Path) -> None:
    with pytest.raises(StudyError) as wrong:
        parse_study(base + text, tmp_path / "study.toml")
    assert f" {place}" in str(wrong.value)


def test_a_body_has_a_name_or_properties_in_any_order(tmp_path: Path) -> None:
    text = '[heating]\ncounterface = "Steel"\nrubber = "1500 J/kg/K, 0.3 W/m/K, 1200 kg/m^3"\npasses = inf\n'
    study = parse_study(BALL + text + 'track_radius = "2 cm"\n', tmp_path / "study.toml")
    assert study.heating is not None
    heating = study.heating.heating(0.1, None)
    assert heating.counterface == STEEL
    assert heating.rubber == vf.ThermalProperties(0.3, 1200.0, 1500.0, "rubber")
    assert heating.passes == np.inf


def test_slip_may_be_negative_where_the_counterface_is_the_faster_surface(tmp_path: Path) -> None:
    def slips(given: str) -> tuple[float, ...]:
        study = parse_study(BASE + HEATING + f"slip = {given}\n", tmp_path / "study.toml")
        assert study.heating is not None
        assert study.heating.slip is not None
        return study.heating.slip

    assert slips('["-50 mm/s", "0 m/s"]') == (-0.05, 0.0)
    assert slips('{ from = "-1 m/s", to = "1 m/s", points = 3, spacing = "linear" }') == (-1.0, 0.0, 1.0)
    with pytest.raises(vf.StudyError, match=r"heating\.slip\.spacing"):
        slips('{ from = "-1 m/s", to = "1 m/s", points = 3 }')


SLIDE = '[history]\nslide = "1 mm"\n'


@pytest.mark.parametrize(
    ("text", "base"),
    [
        (HEATING + '[impact]\nmass = "4 g"\nspeed = "1 m/s"\n', BALL),
        (HEATING + SLIDE + 'before = "sliding"\n', BASE),
        (HEATING + SLIDE + "cycle = true\nstrokes = 2\n", BASE),
        (HEATING + 'slip = "1 mm/s"\n' + SLIDE, BASE),
        (HEATING + 'passes = 3\ntrack_radius = "2 cm"\n' + SLIDE, BALL),
        (HEATING + 'branch = "hot"\n' + SLIDE, BASE),
        (ROUGH_HEAT + SLIDE, ROUGH),
        ('[heating]\ncounterface = "PTFE"\n[interface]\nlaw = "constant"\nstress = "1 MPa"\n' + SLIDE, BASE),
    ],
)
def test_a_note_names_contacts_over_time_that_stay_isothermal(text: str, base: str, tmp_path: Path) -> None:
    notes = parse_study(base + text, tmp_path / "study.toml").notes
    assert [note.code for note in notes if note.code != "no-bands"] == ["history-isothermal"]


def test_contacts_over_time_are_heated(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    study = parse_study(BASE + HEATING + SLIDE + 'dwell = ["0 s", "1 s"]\n', path)
    assert not codes(study.notes)
    checked = check_study(study, path)
    assert not codes(checked.notes)
    assert checked.singles["histories"][0] == 16  # cases, dwells, Coulomb frictions
    rubbers = Rubbers([one.material for one in checked.rubbers], {})
    plan = Histories.of(study, checked.sweep, rubbers)
    assert plan is not None
    found = [(task.arguments["heating"].coulomb, task.arguments["history"].temperature[0]) for task in plan.wanted()]
    assert found[:4] == [(0.2, 333.15), (0.5, 333.15)] * 2
    assert len({task.key for task in plan.wanted()}) == 16
    # a vertical shift that changes has no known effect on earlier stress
    shifted = replace(rubbers.materials[0], vertical_shift=DensityShift("30 degC"))
    assert codes(material_notes(study, [shifted])) == {"history-isothermal"}
    plan = Histories.of(study, checked.sweep, Rubbers([shifted], {}))
    assert plan is not None
    assert "heating" not in plan.wanted()[0].arguments


@pytest.mark.slow
def test_heated_contacts_over_time_are_those_of_the_python_interface(tmp_path: Path) -> None:
    base = BALL.replace('["50 mm/s", "200 mm/s"]', '"0.1 m/s"').replace('["60 degC", "90 degC"]', '"60 degC"')
    results = run(tmp_path, '[heating]\ncounterface = "PTFE"\n[history]\ndwell = "1 ms"\npoints = 3\n', base)
    data = results.tree["history"].to_dataset()
    history = vf.motion.History([0.0, 1e-3], load="2 N", temperature="60 degC")
    alone = vf.motion.solve_transient(
        vf.synthetic_fluoroelastomer(), vf.Ball("10 mm"), history, times=data["time"].values, accuracy=0.1,
        heating=vf.Heating(rubber=FILLED_RUBBER, counterface=PTFE),
    )  # fmt: skip
    assert alone.heating is not None
    np.testing.assert_allclose(data["temperature_rise"], alone.heating.temperature_rise, rtol=1e-9)
    np.testing.assert_allclose(data["contact_radius"], alone.contact_radius, rtol=1e-9)
    assert float(data["temperature_rise"][-1]) > 0.0
    results.tree["history"]["friction_force"][-1] = 0.1  # as if it slid
    figure = histories_figure(results.tree)
    assert figure is not None
    *_, friction, warm = figure.axes
    assert len(friction.lines) == 3  # heated, without heating, and zero
    np.testing.assert_allclose(warm.lines[0].get_ydata()[-1], 1e3 * data["temperature_rise"][-1])  # mK
    assert "without heating" in captions(results.tree)["contacts_over_time"]


def test_a_diffusivity_is_enough(tmp_path: Path) -> None:
    text = '[heating]\ncounterface = "46 W/m/K, 12 mm^2/s"\n'
    study = parse_study(BASE + text, tmp_path / "study.toml")
    assert study.heating is not None
    assert study.heating.counterface.diffusivity == pytest.approx(12e-6)
    assert study.heating.counterface.conductivity == 46.0


def test_heated_curves_are_counted_before_they_are_solved(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    study = parse_study(BASE + HEATING, path)
    contacts, seconds = check_study(study, path).singles["heating"]
    assert contacts == 8
    assert seconds > 0.0
