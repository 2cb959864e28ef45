"""``viscofric identify``: the planted rubber comes back, as a table, JSON, a file and a picture."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from cli import calls
from viscofric.cli.friction_sources import is_of_synthetic
from viscofric.files import SYNTHETIC
from viscofric.notes import codes, note_of

RUBBER = vf.Material.standard_linear_solid("2 MPa", "6 MPa", "10 ms")
ANCHOR = ("--anchor-modulus", "2.287 MPa", "--anchor-frequency", "60 rad/s", "--anchor-temperature", "300 K")
#: On a ball of 10 mm under 5 N the loss peak of this solid lies between.
SPEEDS = np.geomspace(0.02, 2.0, 6)


succeed = partial(calls.succeed, "identify")


def curves(path: Path) -> Path:
    ball = vf.Ball("10 mm")
    friction = [
        vf.solve_steady(RUBBER, ball, speed=speed, load="5 N", accuracy=1e-2).friction_coefficient for speed in SPEEDS
    ]
    same, error = np.ones(len(SPEEDS)), 0.01 * np.array(friction)
    measured = vf.FrictionCurves(SPEEDS, 300.0 * same, 5.0 * same, friction, error, error, same.astype(int))
    vf.write_friction_curves(measured, path)
    return path


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """Identify once; return the folder with the files, and the JSON."""
    folder = tmp_path_factory.mktemp("identified")
    done = succeed(
        curves(folder / "curves.csv"), "--ball", "10 mm", *ANCHOR, "--modes", 8, "--samples", 20, "--accuracy", 0.1,
        "--out", folder / "rubber.json", "--picture", folder / "modulus.svg", "--json",
    )  # fmt: skip
    return folder, json.loads(done.stdout, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


@pytest.mark.slow
def test_the_planted_modulus_comes_back_where_it_is_identified(found: tuple[Path, dict[str, Any]]) -> None:
    reported = found[1]
    band, modulus = reported["identified"], reported["results"]
    assert [note_of(one).words("python") for one in reported["note_records"]] == reported["notes"]
    known = {note_of(one).words("python") for one in reported["note_records"]}
    assert [one for one in reported["sentences"] if one in known]  # what the text prints of the result has codes here
    assert band["high"] > 99.0 * band["low"]  # frequencies on a lattice: exactly two decades but for rounding
    omega = np.array(modulus["angular_frequency"])
    inside = (omega >= band["low"]) & (omega <= band["high"])
    found_modulus = np.array(modulus["storage_modulus"]) + 1j * np.array(modulus["loss_modulus"])
    true = RUBBER.complex_modulus(omega)
    # Three of the standard errors of 5 % that the band claims: one mode is the least smooth of all spectra.
    assert np.all(np.abs(np.abs(found_modulus[inside]) / np.abs(true[inside]) - 1.0) < 0.15)
    assert reported["results"]["anchored"]
    assert reported["inputs"]["indenter"] == {"shape": "ball", "radius": 0.01}
    assert reported["family"] == []
    points, measured = reported["points"], vf.read_friction_curves(found[0] / "curves.csv")
    assert points["speed"] == measured.speed.tolist()
    # All errors are alike, 1 %, so that residuals are one multiple of what the fit leaves over of ln μ.
    left = np.log(measured.viscoelastic / points["viscoelastic"])
    np.testing.assert_allclose(points["residual"] / left, points["residual"][0] / left[0], rtol=1e-6)
    assert points["residual"][0] * left[0] > 0.0
    assert len(reported["samples"]) == 20
    assert {len(sample["C"]) for sample in reported["samples"]} == {len(reported["material"]["retardation_time"])}
    anchor = {"modulus": 2.287e6, "angular_frequency": 60.0, "temperature": 300.0, "part": "magnitude", "error": 0.01}
    assert reported["inputs"]["anchor"] == anchor
    assert not {"ball", "cone", "leave_out_outliers", "zero_error"} & set(reported["inputs"])


@pytest.mark.slow
def test_the_rubber_is_read_back_by_the_other_commands(found: tuple[Path, dict[str, Any]]) -> None:
    folder, reported = found
    rubber = vf.read_card(folder / "rubber.json")
    np.testing.assert_allclose(rubber.modes_at().C, reported["material"]["creep_coefficient"], rtol=1e-12)
    fit = rubber.modes_at().fit
    assert fit is not None
    assert fit.from_friction
    assert fit.frequency_range == (reported["identified"]["low"], reported["identified"]["high"])
    calls.succeed("material", "show", folder / "rubber.json", "--frequency", "10 rad/s")
    assert (folder / "modulus.svg").stat().st_size > 0


@pytest.mark.parametrize(
    ("option", "text", "name", "value"),
    [
        ("indentation", "0.3 mm", "indentation", 3e-4),
        ("area", "7 mm^2", "contact_area", 7e-6),
        ("half_width", "1.7 mm", "half_width", 1.7e-3),
    ],
)
def test_the_size_of_a_contact_is_an_anchor_too(option: str, text: str, name: str, value: float) -> None:
    from viscofric.cli.identify import check_anchor, make_anchor

    names = ("modulus", "frequency", "indentation", "area", "half_width", "speed", "load", "temperature", "error")
    asked: dict[str, Any] = {f"anchor_{one}": None for one in names}
    asked |= {"anchor_speed": "1 m/s", "anchor_load": "1 N", "anchor_temperature": "300 K", f"anchor_{option}": text}
    what = check_anchor(asked)
    assert what == option
    anchor = make_anchor(asked, what, "N")
    assert isinstance(anchor, vf.friction.ContactAnchor)
    assert getattr(anchor, name) == pytest.approx(value, rel=1e-12)
    assert (anchor.speed, anchor.load, anchor.temperature) == (1.0, 1.0, 300.0)


def test_tables_show_what_is_identified_and_what_not(capsys: pytest.CaptureFixture[str]) -> None:
    from types import SimpleNamespace

    from viscofric.cli.identify import _print
    from viscofric.friction.identification.conclusions import SHARED
    from viscofric.notes import Note
    from viscofric.report.texts.inverse import family_lines, modulus_lines

    def modulus(omega: Any) -> Any:
        found = RUBBER.spectrum.modulus_dataset(omega)
        for end, factor in (("lower", 0.9), ("upper", 1.1)):
            found = found.assign({f"{name}_{end}": factor * part for name, part in found.data_vars.items()})
        return found

    band = SimpleNamespace(low=5.0, high=500.0, decades=2.0, relative=False)
    fits = tuple(SimpleNamespace(factor=f, modulus=f * 2e6, rms=0.01, penalty=f) for f in (0.5, 2.0))
    made: Any = SimpleNamespace(
        to_dataset=modulus, identified=band, frequency_range=(3.0, 300.0), middle=30.0, family=fits
    )
    heading, *rows = modulus_lines(made)
    assert heading.split()[:2] == ["ω", "(rad/s)"]
    # From a decade below 1 rad/s to one above 1000 rad/s, of which 10 and 100 lie in the band.
    assert [float(row.split()[0]) for row in rows] == [0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0]
    assert ["not identified" in row for row in rows] == [True, True, False, False, True, True]
    assert f"{1e-6 * complex(RUBBER.complex_modulus(10.0)).real:.2f}" in rows[2]
    band.relative = True
    remarks = [" ".join(row.split()[9:]) for row in modulus_lines(made)[1:]]
    assert remarks == ["not identified"] * 2 + ["magnitude not identified"] * 2 + ["not identified"] * 2
    assert len(family_lines(made)) == 3
    assert "× 0.5" in family_lines(made)[1]
    made.family = ()
    assert family_lines(made) == []
    made.sentences = (Note("errors-shared", "Errors may be shared", remedy=SHARED),)
    _print(made)
    assert "--common-error" in capsys.readouterr().out


def test_a_prior_or_shift_of_a_synthetic_material_is_one(tmp_path: Path) -> None:
    made = vf.write_card(vf.synthetic_fluoroelastomer(), tmp_path / "made.json", "json")
    measured = vf.write_card(vf.catalogue_material("PVB interlayer"), tmp_path / "measured.json", "json")
    table = tmp_path / "shift.csv"
    table.write_text("# Synthetic\ntemperature (degC),log10 shift factor\n0,1\n20,0\n", encoding="utf-8")
    named = ["synthetic fluoroelastomer", str(made), str(table), "PVB interlayer", str(measured), None]
    assert [is_of_synthetic(one) for one in named] == [True, True, False, False, False, False]
    assert SYNTHETIC in codes(vf.read_shift_factors(table).notes)
