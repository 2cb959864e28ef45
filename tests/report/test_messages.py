"""Sentences of other rooms are made readable, and failures of one reason are told together."""

from __future__ import annotations

from viscofric.report.messages import grouped_failures, readable


def test_conditions_are_rounded() -> None:
    assert readable("Most at 89.9995 °C, 19.9996 mm/s: it is 0.31 wide.") == "Most at 90 °C, 20 mm/s: it is 0.31 wide."
    assert readable("At -19.9996 °C, 9999.6 mm/s.") == "At −20 °C, 10 m/s."


def test_only_minus_signs_become_minus_signs() -> None:
    assert readable("-30 °C (-3) a-3 1e-3 dma-2.csv 2026-11-21") == "−30 °C (−3) a-3 1e-3 dma-2.csv 2026-11-21"


def test_failures_of_one_reason_are_one_line() -> None:
    failures = [f"30 °C, {speed} mm/s: the error is {speed * 1e-5:.3g}, not 0.001." for speed in range(20, 40)]
    (line,) = grouped_failures(failures, 5)
    assert line.startswith("20 cases (30 °C, 20 mm/s; 30 °C, 21 mm/s; ")
    assert "and 14 more): the error is 0.0002, not 0.001." in line


def test_few_failures_are_told_one_by_one() -> None:
    assert grouped_failures(["30.0001 °C, 20 mm/s: no."], 5) == ["30 °C, 20 mm/s: no."]
    assert grouped_failures([], 5) == []
    assert grouped_failures(["Something else.", "30 °C, 20 mm/s: no."], 5) == ["Something else.", "30 °C, 20 mm/s: no."]


def test_many_kinds_of_failure_end_with_the_number_of_the_rest() -> None:
    lines = grouped_failures([f"30 °C, 20 mm/s: reason {letter}." for letter in "abcdefg"], 5)
    assert len(lines) == 5
    assert lines[-1] == "3 more cases, for other reasons: see the report."
