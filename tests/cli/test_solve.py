"""`viscofric solve` as users meet it: words, JSON, pictures, fields, and how it fails."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from functools import cache, partial
from importlib import import_module
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import viscofric as vf
from cli import calls
from cli.calls import refusal
from viscofric.cli.commands import NOT_ACCURATE
from viscofric.contact import steady
from viscofric.report.figures.contact import contact_figure
from viscofric.report.figures.saving import save_picture
from viscofric.rheology.spectra.quality import SpectrumFit

RUBBER = ("--E0", "1 MPa", "--E-inf", "10 MPa", "--tau", "1 ms")
BALL = ("--ball", "10 mm", "--speed", "1 m/s", "--load", "1 N")


call = partial(calls.call, "solve")
succeed = partial(calls.succeed, "solve")
record = cache(partial(calls.record, "solve"))


@cache
def expected(**arguments: Any) -> vf.contact.ContactSolution:
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    return vf.solve_steady(rubber, vf.Ball("10 mm"), **{"speed": "1 m/s", "load": "1 N", **arguments})


def test_a_contact_beyond_the_frequencies_of_the_rubber_is_reported(tmp_path: Path) -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    fit = SpectrumFit(None, None, True, True, (100.0, 2e3), method="friction")
    vf.write_card(vf.Material(replace(solid, fit=fit)), tmp_path / "rubber.json", format="json")
    contact = ("--material", tmp_path / "rubber.json", "--ball", "10 mm", "--load", "1 N", "--accuracy", "0.1")
    # Contacts of about 1 mm.
    fast, slow = (record(*contact, "--speed", speed) for speed in ("10 m/s", "1 m/s"))
    assert [one["code"] for one in fast["warning_records"]] == ["beyond-measured"]
    assert (len(fast["warnings"]), slow["warnings"], slow["warning_records"]) == (1, [], [])
    assert "Warning: " in call(*contact, "--speed", "10 m/s").stderr


def test_a_rubber_without_shift_factors_is_taken_to_be_that_of_the_temperature() -> None:
    found = record(*RUBBER, *BALL, "--temperature", "40 degC", "--accuracy", "0.1", "--derivatives")
    assert "temperature-assumed" in {one["code"] for one in found["warning_records"]}
    assert found["inputs"]["temperature"] == pytest.approx(313.15)
    assert found["results"]["friction_coefficient"] == expected(accuracy=0.1).friction_coefficient
    assert "temperature-assumed" not in json.dumps(record(*RUBBER, *BALL, "--accuracy", "0.1"))


def test_what_the_fit_of_a_material_file_assumed_is_noted_with_its_contacts(tmp_path: Path) -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    fit = SpectrumFit(None, None, True, True, (1.0, 1e6), ("α(T) was assumed.",))
    vf.write_card(vf.Material(replace(solid, fit=fit)), tmp_path / "rubber.json", format="json")
    assert "Note: α(T) was assumed." in call("--material", tmp_path / "rubber.json", *BALL).stderr


def test_json_holds_what_python_gives() -> None:
    found, solution = record(*RUBBER, *BALL), expected()
    for name, value in solution.number_values.items():
        assert found["results"].get(name) == value, name
    assert found["results"]["power"] == found["results"]["friction_force"] == solution.friction_coefficient * 1.0
    assert found["results"]["friction_error"] == solution.diagnostics.friction_error
    assert found["diagnostics"]["shape"] == list(solution.diagnostics.shape)
    assert found["diagnostics"]["levels"][-1]["cells"] == max(solution.diagnostics.shape)
    assert found["inputs"]["material"] | {"name": ""} == {
        "name": "",
        "synthetic": False,
        "poisson_ratio": 0.5,
        "modes": 1,
        "E0": 1e6,
        "E_inf": 1e7,
        "C": [pytest.approx(9e-7)],
        "tau": [1e-3],
    }
    assert found["derivatives"] is None
    assert found["inputs"]["indenter"] == {"shape": "ball", "radius": 0.01, "elastic": None}
    assert found["inputs"]["held"] == "load"


def test_every_number_has_a_unit() -> None:
    found = record(*RUBBER, *BALL)
    units = found["results"]["units"]
    assert set(found["results"]) - {"geometry", "direction", "coulomb", "units"} == set(units)
    assert (units["contact_area"], units["power"], units["friction_error"]) == ("m**2", "W", "1")
    line = record(*RUBBER, "--cylinder", "10 mm", "--speed", "1 m/s", "--load", "100 N/m")
    assert line["results"]["units"]["load"] == "N/m"
    assert line["results"]["half_width"] is None


def test_words_show_the_numbers_and_their_errors() -> None:
    done = succeed(*RUBBER, *BALL)
    solution = expected()
    lines = dict(line.split("  ", 1) for line in done.stdout.splitlines()[2:] if not line.startswith(" "))
    friction = float(lines["viscoelastic friction coefficient"].split("±")[0])
    assert friction == pytest.approx(solution.friction_coefficient, abs=solution.diagnostics.friction_error)
    assert "± 0.0000" in lines["viscoelastic friction coefficient"]
    assert lines["indentation"].strip().startswith("298.")
    assert lines["indentation"].endswith("µm")
    assert lines["normal load"].strip() == "1 N"
    assert not any(line.startswith("lateral guiding force") for line in lines)
    assert lines["contact area"].strip().startswith("7.0")
    assert lines["contact area"].endswith("mm²")
    assert "largest contact pressure, not resolved: at least" in lines
    assert lines["centre of pressure along the direction"].strip().startswith("575.5")
    assert lines["grid"].strip().startswith("{} × {} cells".format(*solution.diagnostics.shape))


def test_a_contact_that_dissipates_nothing_has_no_friction() -> None:
    done = succeed(*RUBBER, "--cone", "5 deg", "--speed", "inf", "--indentation", "50 um")
    assert "no dissipation: elastic" in done.stdout
    found = record(*RUBBER, "--cone", "5 deg", "--speed", "-inf", "--indentation", "50 um")
    assert found["inputs"]["speed"] == "infinite"
    assert found["inputs"]["held"] == "indentation"
    assert found["inputs"]["indentation"] == pytest.approx(5e-5, rel=1e-15)
    assert found["inputs"]["load"] is None
    assert found["results"]["load"] == pytest.approx(0.2426, rel=1e-3)


def test_coulomb_friction_that_shears_a_contact_is_shown_beside_its_friction() -> None:
    shear = (*RUBBER, "--cylinder", "10 mm", "--speed", "-1 m/s", "--load", "100 N/m", "--coulomb", 0.3)
    lines = dict(line.split("  ", 1) for line in succeed(*shear).stdout.splitlines()[2:])
    assert float(lines["Coulomb friction, only as shear"]) == 0.3
    # The indenter moves against its direction, and the pressure lies ahead of it.
    assert lines["centre of pressure along the direction"].strip().startswith("−")


def test_the_catalogues_rubber_is_shifted_and_called_synthetic() -> None:
    arguments = (
        "--material",
        "synthetic fluoroelastomer",
        "--ball",
        "9.525 mm",
        "--speed",
        "100 mm/s",
        "--load",
        "25 N",
    )
    done = succeed(*arguments, "--temperature", "60 degC", "--accuracy", "0.01", "--tolerance", "1e-6")
    # An independent solution goes from 0.0251 at 20 mm/s to 0.0158 at 200 mm/s.
    friction = float(done.stdout.split("friction coefficient")[1].split("±")[0])
    assert 0.0158 < friction < 0.0251
    wide = record(*arguments[:-1], "60 N", "--accuracy", "0.01", "--tolerance", "1e-6")
    assert [one["code"] for one in wide["warning_records"]] == ["large-strain"]


def test_rubbers_come_from_files_too(tmp_path: Path) -> None:
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    vf.write_card(rubber, tmp_path / "rubber.json", format="json")
    found = record("--material", tmp_path / "rubber.json", *BALL)
    assert found["results"]["friction_coefficient"] == pytest.approx(expected().friction_coefficient, rel=1e-9)
    # The [material] of a run file, and the file that it names, beside it.
    (tmp_path / "study.toml").write_text(
        '[material]\nfile = "rubber.json"\n[indenter]\nradius = "1 mm"\n'
        '[conditions]\nload = "1 N"\nspeed = "1 m/s"\ntemperature = "20 degC"\n',
        encoding="utf-8",
    )
    again = record("--material", tmp_path / "study.toml", *BALL)
    assert again["results"] == found["results"]


def test_a_layer_stiffens_the_contact() -> None:
    found = record(*RUBBER, *BALL, "--layer", "1 mm", "--sliding-base", "--accuracy", 0.01)
    half_space = record(*RUBBER, *BALL)
    assert found["inputs"]["layer"] == {"thickness": 1e-3, "bonded": False}
    assert half_space["inputs"]["layer"] is None
    assert found["results"]["indentation"] < 0.9 * half_space["results"]["indentation"]


OBLIQUE = (*RUBBER, "--ellipsoid", "10 mm,30 mm", "--speed", "0.5 m/s", "--load", "1 N")


@pytest.mark.slow
def test_a_direction_is_an_angle_or_two_numbers() -> None:
    by_angle, by_numbers = record(*OBLIQUE, "--direction", "90 deg"), record(*OBLIQUE, "--direction", "0,2")
    assert by_angle["inputs"]["direction"] == [0.0, 1.0]
    assert by_angle["results"] == by_numbers["results"]
    exchanged = record(*RUBBER, "--ellipsoid", "30 mm,10 mm", *OBLIQUE[-4:])
    # Two solutions of one problem differ by what the solver leaves, 1e-8 of the indentation.
    for name in ("friction_coefficient", "indentation", "front", "rear"):
        assert by_angle["results"][name] == pytest.approx(exchanged["results"][name], rel=1e-6), name


@pytest.mark.slow
def test_the_force_across_the_motion_is_reported_with_its_side() -> None:
    found = record(*OBLIQUE, "--direction", "30 deg")
    assert found["results"]["lateral_friction_coefficient"] < 0.0
    # The other way along the same line: the same force at the other side, since the motion has turned round.
    back = record(*OBLIQUE[:-3], "-0.5 m/s", *OBLIQUE[-2:], "--direction", "30 deg")
    assert back["inputs"]["direction"] == found["inputs"]["direction"]
    mirrored = record(*OBLIQUE, "--direction", "-30 deg")
    straight = record(*RUBBER, *BALL, "--direction", "1,1")
    lateral, *others = (one["results"]["lateral_friction_coefficient"] for one in (found, back, mirrored, straight))
    # Two solutions of one problem differ by what the solver leaves, 1e-8 of the indentation.
    assert others == pytest.approx([-lateral, -lateral, 0.0], rel=1e-6, abs=1e-9)


@pytest.mark.slow
def test_derivatives_are_reported_as_slopes_in_logarithms() -> None:
    solution = expected(derivatives=True)
    assert solution.derivatives is not None
    found = record(*RUBBER, *BALL, "--derivatives")["derivatives"]
    for name in ("C", "tau"):
        assert found[name] == getattr(solution.derivatives, name).tolist()
        assert found[f"log_{name}"] == getattr(solution.derivatives.logarithmic, name).tolist()
    for name in ("E_inf", "speed", "error", "way"):
        assert found[name] == getattr(solution.derivatives, name)
    assert found["log_load"] == solution.derivatives.logarithmic.load
    assert (found["units"]["C"], found["units"]["log_load"]) == ("Pa", "1")
    words = call(*RUBBER, *BALL, "--derivatives").stdout

    def reported(start: str, column: int = -1) -> float:
        (line,) = (line for line in words.splitlines() if line.startswith(f"  {start}"))
        return float(line.split()[column].replace("−", "-"))

    # By other solves, a tenth up and down: friction to 1e-3 over the step, and its square.
    def slope(name: str, unit: str) -> float:
        up, down = (expected(**{name: f"{factor} {unit}"}).friction_coefficient for factor in (1.1, 1.0 / 1.1))
        return math.log(up / down) / (2.0 * math.log(1.1))

    error = solution.derivatives.error / solution.friction_coefficient
    assert 0.0 < error < 0.03
    assert reported("speed") == pytest.approx(slope("speed", "m/s"), abs=error + 1e-2)
    assert reported("load") == pytest.approx(slope("load", "N"), abs=error + 1e-2)
    # One mode: times and speed have one effect.
    assert reported("1 ms") == reported("speed")
    assert words.count("+0.520") == 2  # to the digit that the error is in


def test_of_many_modes_those_that_matter_are_shown() -> None:
    done = succeed(
        "--material", "synthetic fluoroelastomer", *BALL[2:4], "--ball", "9.525 mm", "--load", "25 N",
        "--temperature", "60 degC", "--accuracy", "0.02", "--tolerance", "1e-6", "--derivatives",
    )  # fmt: skip
    assert "the most important of 37:" in done.stdout
    head, table = done.stdout.split("d ln μ/d ln τ\n")
    assert len(table.splitlines()) == 5
    # Held by an indentation, it is that which is differentiated.
    held = call(*RUBBER, *BALL[:-2], "--indentation", "0.1 mm", "--accuracy", "0.02", "--derivatives")
    assert "indentation          d ln μ/d ln δ" in held.stdout
    assert "d ln μ/d ln F" in head
    assert "d ln μ/d ln F" not in held.stdout


def test_window_and_grid_may_be_given() -> None:
    found = record(*RUBBER, *BALL, "--grid", 128, "--window", "3 mm, 3 mm,0.2 cm")
    assert found["inputs"]["grid"] == 128
    assert found["inputs"]["window"] == pytest.approx([3e-3, 3e-3, 2e-3])
    along, across = found["diagnostics"]["shape"]
    assert 128 <= along < 140  # a few more, so that the axis lies between two of them
    assert across < 0.75 * along
    assert along * found["diagnostics"]["spacing"] == pytest.approx(6e-3, rel=0.1)


def test_elastic_indenter_softens_the_contact() -> None:
    found = record(*RUBBER, *BALL, "--indenter-modulus", "5 MPa", "--indenter-poisson-ratio", 0.4)
    solution = expected(indenter_modulus="5 MPa", indenter_poisson_ratio=0.4)
    assert found["results"]["indentation"] == solution.indentation
    assert found["inputs"]["indenter"]["elastic"] == {"modulus": 5e6, "poisson_ratio": 0.4}


def test_heights_of_a_ball_are_a_ball(tmp_path: Path) -> None:
    x = np.arange(-3.0, 3.01, 0.2)  # mm
    z = 1e3 * (x[:, None] ** 2 + x**2) / 20.0 + 5.0  # µm
    np.savetxt(tmp_path / "ball.csv", z, delimiter=",")
    np.save(tmp_path / "ball.npy", 1e-6 * z)
    found = record(
        *RUBBER, *BALL[2:], "--height-map", tmp_path / "ball.csv", "--spacing", "0.2 mm,200 um", "--height-unit", "um"
    )
    # A spline through a paraboloid is the paraboloid, but for rounding.
    assert found["results"]["friction_coefficient"] == pytest.approx(expected().friction_coefficient, rel=1e-6)
    assert found["inputs"]["indenter"]["points"] == [31, 31]
    text = (tmp_path / "ball.csv").read_text().replace(",", ";").replace(".", ",")
    (tmp_path / "ball.csv").write_text(f"# Width: 6.2 mm\n# Value units: um\n{text}")
    stated = record(*RUBBER, *BALL[2:], "--height-map", tmp_path / "ball.csv")
    assert stated["results"]["indentation"] == pytest.approx(found["results"]["indentation"], rel=1e-9)
    again = record(*RUBBER, *BALL[2:], "--height-map", tmp_path / "ball.npy", "--spacing", "0.2 mm")
    assert again["results"]["indentation"] == pytest.approx(found["results"]["indentation"], rel=1e-9)


def test_a_profile_of_a_cylinder_is_a_cylinder(tmp_path: Path) -> None:
    x = np.arange(-3.0, 3.01, 0.1)
    np.savetxt(tmp_path / "profile.txt", x**2 / 20.0)
    line = ("--speed", "1 m/s", "--load", "100 N/m")
    found = record(*RUBBER, *line, "--profile", tmp_path / "profile.txt", "--spacing", "0.1 mm", "--height-unit", "mm")
    cylinder = record(*RUBBER, *line, "--cylinder", "10 mm")
    assert found["results"]["friction_coefficient"] == pytest.approx(
        cylinder["results"]["friction_coefficient"], rel=1e-6
    )
    ellipsoid = record(*RUBBER, *BALL[2:], "--ellipsoid", "10 mm, 1 cm")
    assert ellipsoid["results"]["friction_coefficient"] == pytest.approx(expected().friction_coefficient, rel=1e-9)


@pytest.mark.slow
def test_pictures_are_drawn_and_the_same_every_time(tmp_path: Path) -> None:
    done = succeed(*RUBBER, *BALL, "--picture", tmp_path / "a.svg")
    assert f"picture  {tmp_path / 'a.svg'}" in done.stdout
    title = "Ball of radius 10 mm on standard linear solid"
    save_picture(tmp_path / "b.svg", lambda: contact_figure(expected(), vf.Ball("10 mm"), title), name="contact")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


@pytest.mark.slow
def test_pictures_of_line_contacts_have_no_map() -> None:
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    cylinder = vf.Cylinder("10 mm")
    line = vf.solve_steady(rubber, cylinder, speed="-1 m/s", load="100 N/m")
    assert [axes.get_ylabel() for axes in contact_figure(line, cylinder).axes] == ["pressure $p$ (kPa)", "height (µm)"]
    assert len(contact_figure(expected(), vf.Ball("10 mm")).axes) == 4  # the map, its bar, two profiles


def test_a_picture_turns_the_indenter_with_its_motion() -> None:
    from viscofric.report.figures.contact import plot_surface_profile
    from viscofric.report.figures.style import new_figure

    rubber, ellipsoid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms"), vf.Ellipsoid("10 mm", "30 mm")
    solution = vf.solve_steady(rubber, ellipsoid, speed="0.5 m/s", load="1 N", direction=(1, 2), accuracy=1e-2)
    axes = new_figure(4.0, 3.0).subplots()
    plot_surface_profile(axes, solution, ellipsoid)
    filled = axes.collections[0].get_paths()[0].vertices
    x, surface = axes.lines[0].get_data()
    lower = filled[1 : len(x) + 1, 1]
    middle = solution.pressure.shape[1] // 2
    touching = (solution.pressure[:, middle - 1] > 0.0) & (solution.pressure[:, middle] > 0.0)
    assert touching.sum() > 20
    assert filled[1 : len(x) + 1, 0] == pytest.approx(np.asarray(x))
    # In µm of some 200: what the solver leaves of a gap, and what the rows beside the middle differ.
    assert lower[touching] == pytest.approx(np.asarray(surface)[touching], abs=1e-2)


def test_pictures_show_the_conditions() -> None:
    figure = contact_figure(expected(speed="-1 m/s"), vf.Ball("10 mm"), title="A ball")
    assert figure.get_suptitle() == "A ball\n−1 m/s, 1 N: $\\mu$ = −0.05755"
    assert figure.axes[0].get_xlabel() == "← along the motion $x$ (mm)"
    rest = contact_figure(expected(speed=0.0), vf.Ball("10 mm"))
    assert rest.axes[0].get_xlabel() == "along the motion $x$ (mm)"


@pytest.mark.slow
def test_fields_are_written_with_their_units(tmp_path: Path) -> None:
    done = succeed(*RUBBER, *BALL, "--json", "-o", tmp_path / "fields.nc")
    assert json.loads(done.stdout)["results"]  # files are named on the other stream
    with xarray.open_dataset(tmp_path / "fields.nc", engine="netcdf4") as data:
        cell = float(data.x[1] - data.x[0]) * float(data.y[1] - data.y[0])
        assert data.pressure.attrs["units"] == "Pa"
        assert float(data.pressure.sum()) * cell == pytest.approx(1.0, rel=1e-9)  # rounding: the load is given
    succeed(*RUBBER, *BALL, "-o", tmp_path / "fields.csv")
    table = np.loadtxt(tmp_path / "fields.csv", delimiter=",", skiprows=1)
    assert table[:, 2].sum() * cell == pytest.approx(1.0, rel=1e-8)  # ten digits
    assert math.isclose(table[:, 3].max(), expected().indentation, rel_tol=1e-2)  # beside the axis by half a cell


def test_too_small_a_map_is_reported_with_its_file(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "one.csv", [[1.0, 2.0]], delimiter=",")
    found = refusal("solve", *RUBBER, *BALL[2:], "--height-map", tmp_path / "one.csv", "--spacing", "1 um")
    assert found[:2] == (1, "not-heights")
    assert found.sentence.startswith(f"{tmp_path / 'one.csv'}: ")


def test_an_input_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "heights.csv"
    path.write_bytes((Path(str(files("viscofric"))) / "example" / "mtm.csv").read_bytes())
    content = path.read_bytes()
    found = refusal("solve", *RUBBER, *BALL[2:], "--height-map", path, "--spacing", "1 um", "-o", path)
    assert found[:2] == (1, "is-input")
    assert path.read_bytes() == content


def test_ctrl_c_is_quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*arguments: object, **settings: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(steady, "solve_steady", interrupted)
    done = call(*RUBBER, *BALL)
    assert done.exit_code == 130
    assert done.output.split() == ["Interrupted."]


@pytest.mark.parametrize(
    ("command", "function"),
    [("solve", "viscofric.contact.steady.solve_steady"), ("curve", "viscofric.friction.prediction.predict_friction")],
)
def test_a_result_that_misses_the_accuracy_is_printed_with_a_status_of_its_own(
    command: str, function: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    module, _, name = function.rpartition(".")
    exact = getattr(import_module(module), name)
    monkeypatch.setattr(function, lambda *given, accuracy, **more: exact(*given, accuracy=0.1, **more))
    done = calls.call(command, *RUBBER, *BALL, "--json")
    assert done.exit_code == NOT_ACCURATE, done.output
    assert json.loads(done.stdout)


def test_an_accuracy_that_no_grid_reaches_has_the_same_status() -> None:
    done = call(*RUBBER, *BALL, "--finest", "128", "--accuracy", "1e-4")
    assert (done.exit_code, done.stdout) == (NOT_ACCURATE, "")
