"""Numbers are written as readers want them."""

from __future__ import annotations

import math

import pytest

from viscofric.report.texts import numbers

NBSP = "\N{NO-BREAK SPACE}"


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.0, 3, "0"),
        (0.0078412, 3, "0.00784"),
        (9.9996, 3, "10.0"),
        (200.0, 4, "200.0"),
        (-21.456, 3, "−21.5"),
        (123456.0, 3, "123000"),
        (1.234e-7, 3, "1.23 × 10⁻⁷"),
        (-5.5e12, 2, "−5.5 × 10¹²"),
        (math.nan, 3, "–"),
        (math.inf, 3, "–"),
    ],
)
def test_significant_digits(value: float, digits: int, text: str) -> None:
    assert numbers.significant(value, digits).replace(NBSP, " ") == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (10.04, 0.05, "10.040 ± 0.050"),
        (89.6, 12.0, "90 ± 12"),
        (-3.0, 0.4, "−3.00 ± 0.40"),
        (3.0, 0.0, "3"),
        (3.0, math.nan, "3"),
        (math.nan, 0.1, "–"),
    ],
)
def test_a_value_has_the_digits_that_its_error_leaves(value: float, error: float, text: str) -> None:
    assert numbers.with_error(value, error) == text


def test_moduli_choose_their_unit() -> None:
    assert numbers.megapascals(3.021e6) == f"3.02{NBSP}MPa"
    assert numbers.megapascals(1.507e9) == f"1.51{NBSP}GPa"


def test_running_text_has_no_trailing_zeros() -> None:
    assert [numbers.short(value) for value in (25.0, 0.5, 200.0, 9.525, 1500.0)] == [
        "25",
        "0.5",
        "200",
        "9.525",
        "1500",
    ]


def test_shares_and_lists_in_words() -> None:
    assert numbers.percent(0.0322) == f"3.2{NBSP}%"
    assert numbers.signed_percent(-0.0041) == f"−0.4{NBSP}%"
    assert numbers.signed_percent(-0.0004) == f"0.0{NBSP}%"
    assert numbers.several(["a", "b", "c"]) == "a, b and c"
    assert numbers.several(["a"]) == "a"


def test_speeds_choose_their_unit() -> None:
    assert [numbers.speed(value) for value in (1e-4, 0.0199996, 0.999999, 10.0)] == [
        "0.1 mm/s",
        "20 mm/s",
        "1 m/s",
        "10 m/s",
    ]
