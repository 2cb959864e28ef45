"""Failures of one reason are one line."""

from __future__ import annotations

from viscofric.notes import Note
from viscofric.report.texts.study import grouped_failures


def test_failures_of_one_code_are_one_line() -> None:
    failures = [
        Note("accuracy-not-reached", f"the error is {speed * 1e-5:.3g}, not 0.001.", f"−30 °C, {speed} mm/s")
        for speed in range(20, 40)
    ]
    (line,) = grouped_failures(failures, 5)
    assert line.startswith("20 cases (−30 °C, 20 mm/s; −30 °C, 21 mm/s; ")
    assert "and 14 more): the error is 0.0002, not 0.001." in line


def test_few_failures_are_reported_one_by_one() -> None:
    assert grouped_failures([], 5) == []
    assert grouped_failures([Note("", "Something else."), Note("", "no.", "30 °C, 20 mm/s")], 5) == [
        "Something else.",
        "30 °C, 20 mm/s: no.",
    ]
    assert grouped_failures([Note("", "no."), Note("", "no.")], 5) == ["2 times: no."]


def test_different_reasons_of_one_code_are_different_lines() -> None:
    failures = [Note("unexpected-error", f"unexpectedly, {error}: no.", "30 °C") for error in ("KeyError", "OSError")]
    assert grouped_failures([*failures, failures[0]], 5) == [
        "2 cases (30 °C; 30 °C): unexpectedly, KeyError: no.",
        "30 °C: unexpectedly, OSError: no.",
    ]


def test_many_kinds_of_failure_end_with_the_number_of_the_rest() -> None:
    lines = grouped_failures([Note("", f"reason {letter}.", "30 °C, 20 mm/s") for letter in "abcdefg"], 5)
    assert len(lines) == 5
    assert lines[-1] == "3 more cases, for other reasons: see the report."
