"""The commands with heating: the same numbers as in Python, and the options that belong together."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from cli.calls import call, succeed
from viscofric.thermal import FILLED_RUBBER, STEEL

RUBBER = ["--material", "synthetic fluoroelastomer"]
LINE = [*RUBBER, "--cylinder", "10 mm", "--load", "500 N/m", "--accuracy", "0.1"]
HEAT = ["--heating", "steel", "--heating-coulomb", "0.4"]


def run(*arguments: str) -> str:
    done = succeed(*arguments)
    return done.stdout


def heated(**heating: object) -> vf.contact.ContactSolution:
    given = vf.Heating(rubber=FILLED_RUBBER, counterface=STEEL, coulomb=0.4, **heating)
    contact = {"speed": "0.1 m/s", "load": "500 N/m", "temperature": "30 degC", "accuracy": 0.1, "heating": given}
    return vf.solve_steady(vf.synthetic_fluoroelastomer(), vf.Cylinder("10 mm"), **contact)


@pytest.mark.slow
def test_a_heated_contact_has_the_numbers_of_python() -> None:
    options = ["--speed", "0.1 m/s", *HEAT, "--heating-average", "loss", "--heating-slip", "0.05 m/s"]
    found = json.loads(run("solve", *LINE, *options, "--json"))
    same = heated(average="loss", slip=0.05)
    assert same.heating is not None
    assert found["results"]["temperature_rise"] == same.heating.temperature_rise
    assert found["results"]["friction_coefficient"] == same.friction_coefficient
    assert found["results"]["units"]["loss_rise"] == "K"
    assert found["inputs"]["heating"]["counterface"]["name"] == "bearing steel"
    assert found["inputs"]["heating"]["slip"] == 0.05


@pytest.mark.apart
def test_a_heated_curve_has_both_frictions_and_a_picture(tmp_path: Path) -> None:
    picture = tmp_path / "curve.svg"
    options = ["--speed", "0.05 m/s, 0.2 m/s", *HEAT, "--heating-average", "contact"]
    said = run("curve", *LINE, *options, "--picture", str(picture))
    heading = next(line for line in said.splitlines() if "speed" in line)
    assert heading.split()[-4:] == ["isothermal", "rise", "(K)", "Coulomb"]
    assert picture.exists()
    points = json.loads(run("curve", *LINE, *options, "--json"))["results"]
    slow, fast = points["temperature_rise"]
    assert fast > slow > 0.0
    assert np.all(np.less(points["temperature_rise_error"], points["temperature_rise"]))
    assert min(points["temperature_rise_error"]) > 0.0


@pytest.mark.apart
def test_a_contact_over_time_is_heated() -> None:
    options = ["--slide", "1 mm", "--speed", "0.1 m/s", "--times", "5 ms, 10 ms", "--heating", "PTFE", *HEAT[2:]]
    found = json.loads(run("transient", *LINE, *options, "--json"))
    rises = found["results"]["face_rise"]
    assert rises[1] > rises[0] > 0.0
    assert found["results"]["temperature_rise"] == found["results"]["loss_weighted_rise"]
    assert "largest rise of temperature" in run("transient", *LINE, *options)


@pytest.mark.parametrize(
    ("options", "option"),
    [
        (["--heating-coulomb", "0.4"], "--heating-coulomb"),
        (["--heating", "steel", "--heating-track", "23 mm"], "--heating-track"),
        (["--heating", "steel", "--heating-track", "23,0"], "--heating-track"),
        (["--heating", "stele"], "--heating"),
        (["--heating", "steel", "--heating-rubber", "0.3 W/m/K"], "--heating-rubber"),
        ([*HEAT, "--heating-track", "23 mm,inf"], "passes"),  # of a line contact
    ],
)
def test_options_that_do_not_fit_are_refused(options: list[str], option: str) -> None:
    done = call("solve", *LINE, "--speed", "0.1 m/s", *options)
    assert done.exit_code != 0
    assert option in done.output
    assert "Traceback" not in done.output
