"""The page's identification: the rubber behind friction, its anchor, what is told while it is at work."""

from __future__ import annotations

import shutil
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.web.jobs.context import Context, JobError
from viscofric.web.start import FORMS
from web.friction_workspace import STUDY, done, workspace

CONDITIONS = {**STUDY["conditions"], "temperature": ["40 degC", "60 degC"]}
CURVES = {**STUDY, "conditions": CONDITIONS, "measurement": {"curves": "curves.csv"}}
ANCHOR = {"of": "rubber", "frequency": "1 Hz", "temperature": "40 degC"}
QUICK: dict[str, Any] = {"accuracy": 0.05, "samples": 40}


@pytest.fixture(scope="module")
def context(tmp_path_factory: pytest.TempPathFactory) -> Context:
    return workspace(tmp_path_factory.mktemp("identify") / "workspace")


@pytest.fixture(scope="module")
def heard() -> list[dict[str, Any]]:
    return []


@pytest.fixture(scope="module")
def identified(context: Context, heard: list[dict[str, Any]]) -> dict[str, Any]:
    context.send = lambda event, message: heard.append(message) if event == "progress" else None
    return done("identify", context, CURVES, anchor=ANCHOR, **QUICK)


def test_the_planted_modulus_lies_in_the_band(identified: dict[str, Any]) -> None:
    band, modulus = identified["identified"], identified["modulus"]
    omega = np.array(modulus["angular_frequency"])
    reported = (omega >= band["low"]) & (omega <= band["high"])
    assert band["decades"] > 2.0
    for part in ("storage_modulus", "loss_modulus"):
        planted, low, high = (np.array(values)[reported] for values in (
            identified["known"][part], modulus[f"{part}_lower"], modulus[f"{part}_upper"]
        ))  # fmt: skip
        # A band of 95 % at each frequency; neighbours err together, and the contacts are solved to 5 %.
        assert np.mean((planted > low) & (planted < high)) > 0.6
        np.testing.assert_allclose(np.array(modulus[part])[reported], planted, rtol=0.15)


def test_the_anchor_is_the_rubbers_own_modulus(identified: dict[str, Any]) -> None:
    expected = abs(complex(vf.synthetic_fluoroelastomer().complex_modulus(2.0 * np.pi, "40 degC")))
    assert identified["anchor"]["modulus"] == pytest.approx(expected, rel=1e-5)
    assert identified["anchored"]
    assert identified["family"] == []


def test_shift_factors_and_fit_are_reported_at_all_temperatures(identified: dict[str, Any]) -> None:
    assert identified["factors"]["found"]
    assert len(identified["factors"]["temperature"]) == len(identified["fit"]) == 5
    assert identified["sentences"]


def test_temperatures_of_the_study_that_the_identified_material_lacks_are_told(identified: dict[str, Any]) -> None:
    assert identified["temperature"] == {"given": ["40 degC", "60 degC"], "kept": ["40 degC"]}  # measured up to 52 °C


def test_a_material_whose_magnitude_is_that_of_a_synthetic_one_is_synthetic(identified: dict[str, Any]) -> None:
    assert identified["from_synthetic"]  # the file with the friction does not say so


def test_progress_runs_from_begin_to_end(identified: dict[str, Any], heard: list[dict[str, Any]]) -> None:
    assert identified["sentences"]
    shares = [message["done"] / message["total"] for message in heard if message["total"] > 1]
    assert len(shares) > 5
    assert shares == sorted(shares)
    assert shares[-1] <= 1.0
    assert heard[-1]["label"].startswith("step ")


def test_the_rubber_can_be_fetched(context: Context, identified: dict[str, Any]) -> None:
    rubber = vf.read_card(context.downloads / identified["download"])
    assert rubber.synthetic == identified["from_synthetic"]
    modulus = identified["modulus"]
    found = np.asarray(rubber.complex_modulus(np.array(modulus["angular_frequency"])))
    np.testing.assert_allclose(found.real, modulus["storage_modulus"], rtol=1e-4)


def test_a_rubber_from_friction_is_no_witness_of_friction(context: Context, identified: dict[str, Any]) -> None:
    shutil.copy(context.downloads / identified["download"], context.files / "found.json")
    found = done("agreement", context, {**CURVES, "material": {"file": "found.json"}, "solver": {"accuracy": 0.1}})
    assert found["warning_records"][0]["code"] == "identified-from-friction"
    assert len(found["warnings"]) == len(found["warning_records"])
    # It fits what it was found from to its noise, which proves nothing.
    assert np.nanmax(np.abs([value for one in found["points"] for value in one["difference"]])) < 0.15


@pytest.mark.parametrize(
    ("anchor", "field", "refusal"),
    [
        ({"of": "modulus", "frequency": "1 Hz", "temperature": "40 degC"}, "modulus", ("missing",)),
        ({"of": "modulus", "modulus": "8 MPa", "temperature": "40 degC"}, "frequency", ("missing",)),
        ({**ANCHOR, "of": "modulus", "modulus": "8 N"}, "modulus", ("wrong-unit", "'8 N'")),
        ({**ANCHOR, "of": "modulus", "modulus": "8 MPa", "frequency": "-1 Hz"}, "frequency", ("not-positive",)),
        ({**ANCHOR, "temperature": "warm"}, "temperature", ("no-number",)),
        ({"of": "indentation", "temperature": "40 degC"}, "size", ("missing",)),
        (
            {**ANCHOR, "of": "half_width", "size": "1 kg", "speed": "1 m/s", "load": "25 N"},
            "size",
            ("wrong-unit", "'1 kg'"),
        ),
        (
            {**ANCHOR, "of": "contact_area", "size": "1 mm^2", "speed": "1 m/s", "load": "5 mm"},
            "load",
            ("wrong-unit", "'5 mm'"),
        ),
    ],
)
def test_an_anchor_that_cannot_be_used_is_reported_beside_its_field(
    context: Context, anchor: dict[str, Any], field: str, refusal: tuple[str, ...]
) -> None:
    with refused(refusal[0], JobError, naming=refusal[1:]) as caught:
        done("identify", context, CURVES, anchor=anchor)
    assert caught.value.field == f"@identify.{field}"
    assert caught.value.field in {one["path"] for one in FORMS["identify"]}


def test_the_identification_asks_for_other_shift_factors_where_its_choice_is(context: Context) -> None:
    spectrum = vf.synthetic_fluoroelastomer().spectrum
    vf.write_card(vf.Material(spectrum), context.files / "cold.json", format="json")
    with refused("no-shift", JobError) as caught:
        done("identify", context, {**CURVES, "material": {"file": "cold.json"}}, shift="rubber")
    assert caught.value.field == "@identify.shift"


def test_what_is_missing_is_reported(context: Context) -> None:
    with refused("missing", JobError) as caught:
        done("identify", context, {"measurement": CURVES["measurement"]}, beside=False)
    assert caught.value.field == "indenter"


def test_contacts_are_solved_to_the_accuracy_of_the_study_and_with_the_errors_of_temperatures(
    context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []

    def asked(*_: object, accuracy: float, temperature_error: float, **__: object) -> None:
        seen.append((accuracy, temperature_error))
        raise vf.InputError("enough.", code="enough")

    monkeypatch.setattr("viscofric.web.jobs.identify.identify_material", asked)
    for solver, more in (({"accuracy": 5e-3}, {}), ({}, {"temperature_error": "1.5 K"})):
        with refused("enough"):
            done("identify", context, {**CURVES, "solver": solver}, anchor=ANCHOR, **more)
    assert seen == [(5e-3, 0.0), (1e-3, 1.5)]
    with refused("out-of-range", JobError) as caught:
        done("identify", context, CURVES, anchor=ANCHOR, temperature_error="30 K")
    assert caught.value.field == "@identify.temperature_error"
