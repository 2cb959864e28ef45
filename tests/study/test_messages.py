"""Messages of studies: what is done, and the sentence that follows."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import viscofric as vf
from study.wrong_run_files import NO_TOML, WRONG, Wrong
from viscofric.errors import InputError, StudyError
from viscofric.friction.cases.surfaces import step_of
from viscofric.friction.identification.result import with_origin
from viscofric.study.run_file.study import parse_study


@pytest.mark.parametrize("wrong", WRONG, ids=lambda wrong: f"{wrong.good} > {wrong.bad}"[:60])
def test_run_file(wrong: Wrong) -> None:
    with pytest.raises(StudyError) as caught:
        parse_study(wrong.text, Path("study.toml"))
    first, *more = str(caught.value).splitlines()
    assert str(caught.value).removeprefix("study.toml: ") == wrong.message
    assert not more or first.startswith(f"study.toml: {len(wrong.codes)} things are wrong:")


@pytest.mark.parametrize(("text", "message"), [(text, message) for text, _, message in NO_TOML])
def test_text_that_is_not_toml(text: str, message: str) -> None:
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    assert str(caught.value) == f"study.toml{message}"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("mirror twice", "'mirror twice': 'mirror' takes no argument"),
        ("fill with water", "'fill with water': expected 'fill harmonic' or 'fill nearest'"),
        ("remove", "'remove ': expected 'remove mean', 'remove tilt' or 'remove curvature'"),
        ("resample", "'resample' needs a length, such as 'resample 5 um'"),
        ("crop 5 um", "'crop 5 um': expected 'crop x 0 um to 200 um'"),
        ("fil", "'fil' is not a preparation step; did you mean 'fill'?"),
    ],
)
def test_preparation_of_a_surface(words: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        step_of(words)
    assert str(caught.value) == message


@pytest.mark.parametrize(("source", "behind"), [("fr.csv", " (fr.csv)"), ("", "")])
def test_origin_of_an_identified_rubber(source: str, behind: str) -> None:
    solid = vf.Material.standard_linear_solid("2 MPa", "6 MPa", "10 ms")
    band = SimpleNamespace(low=3.0, high=400.0)
    found: Any = SimpleNamespace(
        material=vf.Material(solid.modes_at()),
        identified=band,
        middle=30.0,
        METHOD="friction",
        UNMEASURED="",
        known=("Known.",),
    )
    spectrum = with_origin(found, source).spectrum
    assert isinstance(spectrum, vf.RetardationSpectrum)
    assert spectrum.fit is not None
    assert spectrum.fit.notes == (
        f"The material was identified from friction{behind}; none of its moduli was measured.",
        "Known.",
    )
