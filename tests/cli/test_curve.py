"""``viscofric curve``: what Python predicts, as a table, CSV, JSON and a picture, and how it fails."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import partial
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from cli import calls
from rheology.planted import write_moduli
from viscofric.cli.commands import SOME_CASES_FAILED
from viscofric.cli.curve import command
from viscofric.cli.speed_options import chosen_speeds
from viscofric.notes import Note
from viscofric.rheology.spectra.quality import SpectrumFit

DMA = str(files("viscofric") / "example" / "dma.csv")
RUBBER = ("--material", "synthetic fluoroelastomer")
SINGLE = ("--E0", "1 MPa", "--E-inf", "10 MPa", "--tau", "1 ms")
BALL = ("--ball", "9.525 mm", "--load", "25 N", "--accuracy", "0.02")
#: Options of which the inputs in JSON tell what they make: rubber, indenter, layer, and heating.
OF_PARTS = (
    *("dma", "columns", "deformation", "modulus_unit", "sheet", "leave_out_temperatures", "reference", "synthetic"),
    *("shift", "shift_factors"),
    *("rubber_modulus", "glass_modulus", "tau", "poisson_ratio"),
    *("ball", "cylinder", "ellipsoid", "cone", "profile", "height_map", "height_unit", "spacing"),
    *("indenter_modulus", "indenter_poisson_ratio", "sliding_base"),
    *("heating_coulomb", "heating_slip", "heating_rubber", "heating_average", "heating_branch", "heating_track"),
)
#: The results have speeds and temperatures.
NO_INPUTS = ("speeds", "points", "temperatures", "out", "picture", "as_json")
HERTZ = (0.1, 0.3, 1, 3, 10, 30, 100)


succeed = partial(calls.succeed, "curve")


@pytest.mark.slow
def test_table_file_and_json_hold_what_python_predicts(tmp_path: Path) -> None:
    words = (*RUBBER, *BALL, "--speed", "20 mm/s to 200 mm/s", "--points", 3, "--temperature", "60 degC, 90 degC")
    expected = vf.predict_friction(
        vf.synthetic_fluoroelastomer(),
        vf.Ball("9.525 mm"),
        speeds=np.geomspace(0.02, 0.2, 3),
        temperatures=["60 degC", "90 degC"],
        load="25 N",
        accuracy=0.02,
    )
    done = succeed(*words, "--out", tmp_path / "curves.csv", "--picture", tmp_path / "curves.svg")
    np.testing.assert_array_equal(vf.read_friction_curves(tmp_path / "curves.csv").viscoelastic, expected.viscoelastic)
    assert (tmp_path / "curves.svg").stat().st_size > 0
    table = done.stdout.split("\n\n")[1].splitlines()
    assert table[0].split() == ["T", "(°C)", "speed", "(mm/s)", "load", "(N)", "viscoelastic"]
    kelvin, speed, _, friction, error = np.array([row.replace("±", "").split() for row in table[1:]], dtype=float).T
    np.testing.assert_allclose(kelvin + 273.15, expected.temperature)
    np.testing.assert_allclose(1e-3 * speed, expected.speed, rtol=5e-4)  # four digits are shown
    assert np.all(np.abs(friction - expected.viscoelastic) <= error)


def test_json_shows_inputs_and_points() -> None:
    words = (*SINGLE, "--cylinder", "10 mm", "--load", "100 N/m", "--speed", "1 m/s", "--accuracy", "0.02")
    done = succeed(*words, "--temperature", "40 degC", "--json")
    found = json.loads(done.stdout)
    assert found["format"] == "viscofric friction curves 2"
    assert found["results"]["units"]["load"] == "N/m"
    point = {name: found["results"][name] for name in ("viscoelastic", "temperature")}
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    alone = vf.solve_steady(rubber, vf.Cylinder("10 mm"), speed="1 m/s", load="100 N/m", accuracy=0.02)
    # A rubber without shift factors is at the temperature that it is said to be at.
    assert point["viscoelastic"] == [alone.friction_coefficient]
    assert point["temperature"] == [pytest.approx(313.15)]
    assert found["inputs"]["material"]["E0"] == 1e6
    assert (found["inputs"]["load"], found["inputs"]["layer"]) == (100.0, None)
    assert found["inputs"]["indenter"] == {"shape": "cylinder", "radius": 0.01, "elastic": None}
    assert {one.name for one in command.params} - found["inputs"].keys() == {*OF_PARTS, *NO_INPUTS}


def test_points_at_frequencies_that_were_not_measured_are_marked(tmp_path: Path) -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    fit = SpectrumFit(None, None, True, True, (100.0, 2e3))
    vf.write_card(vf.Material(replace(solid, fit=fit)), tmp_path / "rubber.json", format="json")
    words = ("--material", tmp_path / "rubber.json", "--ball", "10 mm", "--load", "1 N", "--accuracy", "0.1")
    done = succeed(*words, "--speed", "1 m/s, 10 m/s", "--out", tmp_path / "curves.csv")  # contacts of about 1 mm
    measured, beyond = done.stdout.split("\n\n")[1].splitlines()[1:]
    assert (measured.endswith("*"), beyond.endswith("*")) == (False, True)
    curves = vf.read_friction_curves(tmp_path / "curves.csv")
    assert curves.within_measured_frequencies.tolist() == [1.0, 0.0]


@pytest.mark.slow
def test_a_rubber_of_sweeps_has_bands_about_its_friction() -> None:
    words = ("--dma", DMA, "--reference", "30 degC", *BALL, "--speed", "100 mm/s", "--temperature", "60 degC")
    done = succeed(*words, "--samples", 20, "--synthetic")
    *_, friction, lower, _, upper = done.stdout.split("\n\n")[1].splitlines()[1].split()
    assert float(lower) < float(friction) < float(upper)
    known = vf.solve_steady(
        vf.synthetic_fluoroelastomer(),
        vf.Ball("9.525 mm"),
        speed="100 mm/s",
        load="25 N",
        temperature="60 degC",
        accuracy=0.02,
    )
    # 2 % of the contact, 1 % noise of the sweeps
    assert float(friction) == pytest.approx(known.friction_coefficient, rel=0.03)


def test_friction_of_a_material_in_doubt_has_two_digits_and_no_numerical_error(tmp_path: Path) -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    for notes in ((), (Note("superposition-fails", "Superposition does not hold."),)):
        fit = SpectrumFit(None, None, True, True, (1e-3, 1e9), notes=notes)
        vf.write_card(vf.Material(replace(solid, fit=fit)), tmp_path / "rubber.json", format="json")
        words = ("--material", tmp_path / "rubber.json", "--ball", "10 mm", "--load", "1.234 N", "--accuracy", "0.1")
        curve = succeed(*words, "--speed", "1 m/s").stdout.split("\n\n")[1].splitlines()[1].split()
        lines = calls.succeed("solve", *words, "--speed", "1 m/s").stdout.splitlines()
        solved = {line[:42].strip(): line[42:].strip() for line in lines[2:]}
        friction = solved["viscoelastic friction coefficient"]
        assert solved["normal load"] == "1.234 N"  # as given
        assert ("±" in curve, "±" in friction) == (not notes, not notes)
    assert curve[-1] == friction
    assert len(friction.strip("0.")) == 2


@pytest.mark.slow
def test_columns_of_sweeps_are_named(tmp_path: Path) -> None:
    rubber = vf.synthetic_fluoroelastomer()
    strange = write_moduli(tmp_path / "strange.csv", rubber.complex_modulus, (30, 40, 50), HERTZ)
    _, *rows = strange.read_text(encoding="utf-8").splitlines()
    strange.write_text("\n".join(["Ofen,v1,Es,El", *rows]), encoding="utf-8")
    names = {"temperature": "Ofen (degC)", "frequency": "v1 (Hz)", "storage_modulus": "Es", "loss_modulus": "#4"}
    words = [word for one in names.items() for word in ("--column", "=".join(one))] + ["--modulus-unit", "MPa"]
    words += ["--dma", str(strange), "--reference", "40 degC", "--deformation", "tension"]
    contact = (*BALL, "--speed", "0.1 m/s", "--temperature", "40 degC")
    done = calls.succeed("solve", *words, *contact, "--json")
    known = vf.solve_steady(
        rubber, vf.Ball("9.525 mm"), speed="0.1 m/s", load="25 N", temperature="40 degC", accuracy=0.02
    ).friction_coefficient
    found = json.loads(done.stdout)["results"]["friction_coefficient"]
    assert found == pytest.approx(known, rel=0.02)  # moduli of three decades
    refused = calls.call("solve", *RUBBER, "--column", "frequency=v1 (Hz)", *contact)
    assert refused.exit_code == 2


@pytest.mark.slow
def test_sweeps_whose_moduli_contradict_each_other_are_doubted_before_friction(tmp_path: Path) -> None:
    def swapped(omega: float, kelvin: float) -> complex:
        return 1j * complex(known(omega, kelvin)).conjugate()

    known = vf.synthetic_fluoroelastomer().complex_modulus
    doubted = {}
    for name, modulus in (("right", known), ("swapped", swapped)):
        path = write_moduli(tmp_path / f"{name}.csv", modulus, (20, 30, 40), HERTZ)
        words = ("--dma", str(path), "--reference", "30 degC", *BALL, "--speed", "0.1 m/s")
        doubted[name] = "Warning: E' and E'' are inconsistent" in calls.succeed("curve", *words).stderr
    assert doubted == {"right": False, "swapped": True}


def test_curves_go_into_a_pipe_without_the_table() -> None:
    done = succeed(*SINGLE, "--ball", "10 mm", "--load", "1 N", "--speed", "1 m/s", "--accuracy", "0.1", "--out", "-")
    assert done.stdout.startswith("# viscofric friction curves")
    assert [line[:1] for line in done.stdout.splitlines()] == ["#", "#", "#", "#", "s", "1"]
    noted = done.stdout.splitlines()[2:4]
    assert ['"temperature-assumed"' in noted[0], '"frequencies-unknown"' in noted[1]] == [True, True]
    assert [line.split()[0] for line in done.stderr.splitlines()] == ["Note:", "Note:"]  # nothing to warn of


@pytest.mark.parametrize(
    "text", ["1 mm/s to 1 m/s", "1 mm/s - 1 m/s", "1 mm/s .. 1 m/s", "1 mm/s…1 m/s", "1e-3 m/s – 1 m/s"]
)
def test_a_range_of_speeds_may_be_written_in_several_ways(text: str) -> None:
    found = chosen_speeds({"speeds": [text], "points": 4})
    np.testing.assert_allclose(found, [1e-3, 1e-2, 1e-1, 1.0], rtol=1e-12)


def test_a_contact_without_a_solution_leaves_the_curve_of_the_others(tmp_path: Path) -> None:
    x = np.linspace(-1.0, 1.0, 81)
    heights = tmp_path / "profile.csv"
    np.savetxt(heights, np.c_[x, x**2 / 20.0], delimiter=",", header="x (mm),height (mm)", comments="")
    stiff_when_fast = ("--E0", "1 MPa", "--E-inf", "20 MPa", "--tau", "5 ms", "--profile", heights)
    words = (*stiff_when_fast, "--load", "200 N/m", "--accuracy", "0.01", "--speed", "1 mm/s, 20 m/s, 30 m/s")
    done = calls.call("curve", *words, "--out", tmp_path / "curve.csv", "--json")
    assert done.exit_code == SOME_CASES_FAILED
    found = json.loads(done.stdout)
    assert found["results"]["speed"] == [20.0, 30.0]
    assert [one["values"]["contacts"] for one in found["note_records"] if one["code"] == "unsolved"] == [1]
    np.testing.assert_array_equal(vf.read_friction_curves(tmp_path / "curve.csv").speed, [20.0, 30.0])
