"""Studies on rough surfaces: what is solved is the contact itself, what is interpolated lies within its claims."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric import open_results, run_study
from viscofric.friction.cases.case import Case
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import solve
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import MadeSurface
from viscofric.friction.planning.plan import Plan
from viscofric.notes import codes
from viscofric.study import StudyResults
from viscofric.study.checking import check_study
from viscofric.study.run_file.study import parse_study
from viscofric.study.running.store import CaseStore

STUDY = """
[material]
catalogue = "synthetic fluoroelastomer"
[surface]
hurst = 0.8
rms_slope = 0.2
rolloff = "160 um"
shortest = "80 um"
spacing = "10 um"
points = 32
seed = [1, 2]
[conditions]
pressure = "50 kPa"
speed = ["10 mm/s", "1 m/s"]
temperature = ["30 degC", "60 degC"]
thickness = "2 mm"
[solver]
accuracy = 1e-2
cases = "each"
"""
SURFACE = MadeSurface(
    hurst=0.8, points=(48, 48), spacing=(1e-5, 1e-5), seed=4, shortest=8e-5, rolloff=1.6e-4, rms_slope=0.2
)
RUBBER = vf.synthetic_fluoroelastomer()


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> StudyResults:
    path = tmp_path_factory.mktemp("rough") / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    return run_study(path)


def surfaces() -> list[vf.Topography]:
    made = {"rolloff": "160 um", "shortest": "80 um", "rms_slope": 0.2}
    return [vf.self_affine(0.8, shape=(32, 32), spacing="10 um", seed=seed, **made) for seed in (1, 2)]


@pytest.mark.slow
def test_every_number_is_that_of_the_contact_solved_by_itself(results: StudyResults) -> None:
    found = vf.predict_rough_friction(
        RUBBER,
        surfaces(),
        speeds=["10 mm/s", "1 m/s"],
        temperatures=["30 degC", "60 degC"],
        pressure="50 kPa",
        tolerance=1e-7,
    )
    prediction = results.dataset
    assert prediction["friction_coefficient"].dims == ("seed", "temperature", "speed")
    for name in ("friction_coefficient", "friction_error", "contact_area_fraction"):
        # The same bits: it is the same problem, solved the same way.
        np.testing.assert_array_equal(
            prediction[name].transpose("temperature", "speed", "seed").values, getattr(found, name)
        )
    assert prediction["seed"].values.tolist() == [1, 2]
    assert prediction["pressure"].item() == pytest.approx(5e4)
    alone = vf.solve_periodic(
        RUBBER, surfaces()[1].to_surface(), speed=1.0, temperature="60 degC", pressure="50 kPa", tolerance=1e-7
    )
    last = prediction.isel(seed=1, temperature=1, speed=1)
    assert last["mean_gap"].item() == alone.mean_gap
    assert last["max_pressure"].item() == alone.max_pressure
    assert last["energy_balance"].item() == alone.diagnostics.energy
    assert last["complementarity"].item() == alone.diagnostics.complementarity <= 1e-5
    assert last["products"].item() == alone.diagnostics.products
    assert last["lateral_friction_coefficient"].item() == alone.lateral_friction_coefficient


@pytest.mark.slow
def test_results_show_of_the_surface(results: StudyResults) -> None:
    attributes = results.tree.attrs
    assert "32 × 32" in attributes["indenter"]
    assert "0.32 mm" in attributes["indenter"]
    assert attributes["surface_rms_slope"] == pytest.approx(0.2, rel=1e-12)
    assert len(json.loads(attributes["surface_steps"])) == 1  # how it was made
    assert "no-bands" in codes(results.notes)
    # 0.32 mm over 2 mm.
    assumptions = results.tree["assumptions"]
    assert assumptions["value"].values == pytest.approx([0.16])
    assert assumptions["holds"].values.tolist() == [1]
    # Of the first surface: the slowest, the middle and the fastest, at one temperature or the other.
    fields = results.tree["fields"].children
    assert len(fields) == 3
    for group in fields.values():
        assert group["pressure"].shape == (32, 32)
        assert float(group["pressure"].mean()) == pytest.approx(group["mean_pressure"].item(), rel=1e-5)
        assert group["seed"].item() == 1


@pytest.mark.slow
def test_stored_results_are_taken_up_and_exported(results: StudyResults) -> None:
    folder = results.folder
    assert folder is not None
    opened = open_results(folder)
    assert opened.dataset.equals(results.dataset)
    store = CaseStore(folder / "cases")
    records = [store.get(key) for key in store.stored()]
    assert len(records) == 8
    assert all(isinstance(record, Record) for record in records)
    solved: list[str] = []
    again = run_study(
        folder.parent / "study.toml",
        resume=True,
        progress=lambda event: solved.append(event.event) if event.event == "solved" else None,
    )
    assert solved == []
    assert again.dataset.equals(results.dataset)
    table = Path(results.export("csv")).read_text(encoding="utf-8")
    heading, *rows = [line for line in table.splitlines() if not line.startswith("#")]
    assert heading.startswith("seed,pressure (Pa),temperature (degC),speed (m/s),friction_coefficient,")
    assert len(rows) == 8
    assert "contact_area_fraction" in heading


@pytest.mark.apart
@pytest.mark.slow  # each of the processes imports everything
def test_two_processes_find_the_same(results: StudyResults, tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    assert run_study(path, workers=2).dataset.equals(results.dataset)


def carried_out(cases: Sequence[Case], material: vf.Material, each: bool) -> list[Record]:
    plan = Plan(cases, [material], accuracy=1e-3, each=each)
    while tasks := plan.wanted():
        for task in tasks:
            plan.receive(task.key, solve(task))
    found = plan.found()
    assert not any(isinstance(one, Failure) for one in found)
    return found  # type: ignore[return-value]


@pytest.mark.slow
def test_interpolated_contacts_lie_within_their_claims() -> None:
    cases = [
        SurfaceCase(0, SURFACE, kelvin, speed, 5e4)
        for kelvin in (303.15, 323.15, 343.15)
        for speed in np.geomspace(1e-3, 0.1, 14).tolist()
    ]
    found, alone = (carried_out(cases, RUBBER, each) for each in (False, True))
    pairs = [(one, other) for one, other in zip(found, alone, strict=True) if one.interpolated]
    assert len(pairs) > 0.4 * len(cases)
    off = np.array([one.friction_coefficient / other.friction_coefficient - 1.0 for one, other in pairs])
    claim = np.array([one.interpolation_error / one.friction_coefficient for one, _ in pairs])
    # As for indenters, claims are to hold for 95 %; of some thirty, one or two more may lie beyond.
    assert np.mean(np.abs(off) <= claim) >= 0.9
    assert np.abs(off).max() <= 1e-3  # the requested accuracy
    for one, other in pairs:
        assert (one.speed, one.temperature, one.pressure) == (other.speed, other.temperature, other.pressure)
        # Points come into contact one by one: of 2,304, some 120 touch, and a few more or less are not foretold.
        assert one.contact_area_fraction == pytest.approx(other.contact_area_fraction, rel=0.05)
        assert one.mean_gap == pytest.approx(other.mean_gap, rel=2e-3)
        assert one.friction_error >= 0.5 * other.friction_error
        assert one.max_pressure == pytest.approx(other.max_pressure, rel=0.03)


@pytest.mark.slow
def test_with_a_vertical_shift_the_pressure_counts_as_p_over_b() -> None:
    b = vf.rheology.VerticalShiftFactors([283.15, 303.15, 343.15], [-0.05, 0.0, 0.08], reference=303.15)
    rubber = vf.Material(RUBBER.spectrum, shift=RUBBER.shift, vertical_shift=b)
    factor = float(b(343.15))
    # Enough cases close to each other for a curve at either temperature.
    speeds = np.geomspace(0.01, 0.03, 4).tolist()
    alpha = float(RUBBER.shift(343.15))  # type: ignore[misc]
    hot = [SurfaceCase(0, SURFACE, 343.15, speed / alpha, factor * 5e4, modulus=factor * 1e7) for speed in speeds]
    cold = [SurfaceCase(0, SURFACE, 303.15, speed, 5e4, modulus=1e7) for speed in speeds]
    found, alone = (carried_out([*hot, *cold], rubber, each) for each in (False, True))
    for records in (found, alone):
        for one, other in zip(records[:4], records[4:], strict=True):
            # One and the same problem but for rounding, which the tolerance of 1e-7 may magnify.
            assert one.friction_coefficient == pytest.approx(other.friction_coefficient, rel=1e-5)
            assert one.max_pressure == pytest.approx(factor * other.max_pressure, rel=1e-4)
    assert any(one.interpolated for one in found)


def test_sheared_layers_and_directions_are_those_of_the_solver() -> None:
    layer = vf.Layer("0.2 mm")
    case = SurfaceCase(0, SURFACE, 303.15, 0.1, 5e4, direction=0.5, layer=layer, modulus=2e7)
    (record,) = carried_out([case], RUBBER, True)
    solution = vf.solve_periodic(
        RUBBER,
        SURFACE.topography().to_surface(),
        speed=0.1,
        temperature=303.15,
        pressure=5e4,
        direction=(np.cos(0.5), np.sin(0.5)),
        layer=layer,
        indenter_modulus=2e7,
        tolerance=1e-7,
    )
    assert record.friction_coefficient == solution.friction_coefficient
    assert record.lateral_friction_coefficient == solution.lateral_friction_coefficient
    assert record.warnings == solution.warnings


def test_check_shows_how_much_it_would_be(tmp_path: Path) -> None:
    text = STUDY.replace("points = 32", "points = 512")
    found = check_study(parse_study(text, tmp_path / "study.toml"), tmp_path / "study.toml")
    assert found.expected.solves == 8
    # Measured: 0.27 to 0.32 s for each contact of 512² points; 115 MB in all.
    assert 1.0 < found.expected.seconds < 6.0
    assert 1.1e8 < found.expected.memory_per_process < 3e8
    assert "no-bands" in codes(found.notes)


@pytest.mark.slow
def test_an_interface_acts_on_the_real_contact_area(tmp_path: Path) -> None:
    """As that of the Python interface on the same surface."""
    path = tmp_path / "study.toml"
    text = STUDY.replace("[1, 2]", "1").replace('["30 degC", "60 degC"]', '"30 degC"')
    path.write_text(text + '[interface]\nlaw = "constant"\nstress = "0.2 MPa"\n', encoding="utf-8")
    data = run_study(path).dataset
    surface = vf.self_affine(
        0.8, shape=(32, 32), spacing="10 um", rolloff="160 um", shortest="80 um", rms_slope=0.2, seed=1
    )
    same = vf.predict_rough_friction(
        RUBBER,
        surface,
        speeds=["10 mm/s", "1 m/s"],
        temperatures="30 degC",
        pressure="50 kPa",
        interface=vf.friction.ConstantShearStress("0.2 MPa"),
        tolerance=1e-7,
    )
    np.testing.assert_allclose(data["interface_friction"], same.interface_friction[0, :, 0], rtol=1e-9)
    np.testing.assert_allclose(data["total_friction"], data["friction_coefficient"] + data["interface_friction"])
    assert np.all(data["corrected_area_fraction"] < data["contact_area_fraction"])


def test_a_law_on_a_surface_has_its_constants(tmp_path: Path) -> None:
    with pytest.raises(vf.StudyError) as wrong:
        parse_study(STUDY + "[interface]\n", tmp_path / "study.toml")
    assert " interface" in str(wrong.value)
