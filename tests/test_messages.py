"""Messages about quantities: what was given, and the sentence that follows."""

from __future__ import annotations

import pytest

from viscofric.errors import InputError
from viscofric.units import to_si


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("9,525 mm", "m", "has a decimal comma; write '9.525 mm', or '9525 mm' if it separates thousands."),
        ("25,5 N", "N", "has a decimal comma; write '25.5 N'."),
        ("1 000 N", "N", "has thousands separators; write '1000 N'."),
        ("2*3 mm", "m", "is not one plain number followed by one unit; write, for example, '9.525 mm'."),
        ("mm", "m", "has no number; write, for example, '9.525 mm'."),
        ("25", "N", "has no unit; write, for example, '25 N'."),
        ("", "N", "is empty; write, for example, '25 N'."),
        ("1e400 N", "N", "is not a finite number; write, for example, '25 N'."),
        ("5 foo", "N", "'foo' is not a known unit; write, for example, '25 N'."),
        ("5 kg", "N", "has the wrong kind of unit (kilogram); write, for example, '25 N'."),
        ("60 C", "K", "has the wrong kind of unit (coulomb); write '60 degC'."),
        ("5 MPA", "Pa", "'MPA' is not a known unit; write '5 MPa'."),
        (
            "20 delta_degC",
            "K",
            "is a temperature difference where a temperature is needed; write, for example, '30 degC'.",
        ),
        (
            "51.6 degC",
            "delta_degC",
            "is a temperature where a temperature difference is needed; write, for example, '10 K'.",
        ),
        (
            "17 K",
            "dimensionless",
            "has a unit (kelvin), but must be a pure number; write, for example, the plain number 0.5.",
        ),
    ],
)
def test_quantities(text: str, unit: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        to_si(text, unit, "load")
    assert str(caught.value) == f"load = {text!r}: {message}"
