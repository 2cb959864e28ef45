"""Messages of studies: what is done, and the sentence that follows."""

from __future__ import annotations

from pathlib import Path

import pytest

from study.wrong_run_files import NO_TOML, WRONG, Wrong
from viscofric.errors import InputError, StudyError
from viscofric.friction.cases.surfaces import step_of
from viscofric.notes import Note
from viscofric.study.contacts import nothing_solved
from viscofric.study.run_file.study import parse_study


@pytest.mark.parametrize("wrong", WRONG, ids=lambda wrong: f"{wrong.good} > {wrong.bad}"[:60])
def test_run_file(wrong: Wrong) -> None:
    with pytest.raises(StudyError) as caught:
        parse_study(wrong.text, Path("study.toml"))
    found = {one.where: one.code for one in caught.value.mistakes} or {"": caught.value.code}
    assert found == wrong.codes
    assert caught.value.field == (next(iter(wrong.codes)) or None)
    first, *more = str(caught.value).splitlines()
    assert str(caught.value).removeprefix("study.toml: ") == wrong.message
    assert not more or first.startswith(f"study.toml: {len(wrong.codes)} things are wrong:")


@pytest.mark.parametrize(("text", "code", "message"), NO_TOML)
def test_text_that_is_not_toml(text: str, code: str, message: str) -> None:
    with pytest.raises(StudyError) as caught:
        parse_study(text, Path("study.toml"))
    assert (caught.value.code, str(caught.value)) == (code, f"study.toml{message}")


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


def test_a_study_without_any_solution_says_why_the_first_case_failed() -> None:
    reason = Note("beyond-indenter", "the contact is wider than the ball; reduce the load.").at("60 °C, 20 mm/s")
    expected = "No case could be solved; the first one failed: 60 °C, 20 mm/s: the contact is wider than the ball; "
    assert str(nothing_solved(reason)) == f"{expected}reduce the load."
