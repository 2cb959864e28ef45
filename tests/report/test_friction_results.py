"""What the report says of bands, of assumptions, and of the shift factors that friction tells."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from viscofric.report.figures import saving
from viscofric.report.figures import study as drawing
from viscofric.report.texts.checks import all_checks
from viscofric.report.texts.friction_tables import detail_tables
from viscofric.report.texts.study import key_numbers

ZERO = 273.15


def column(values: object, dimension: str) -> tuple[str, object, dict[str, str]]:
    return dimension, values, {"units": "1", "long_name": "a number"}


def with_friction_shifts(tree: xr.DataTree, p_value: float = 0.6) -> xr.DataTree:
    """Add shift factors from friction, the hottest beyond the sweeps."""
    numbers = {
        "log10_shift_factor": [0.0, -0.8, -2.1],
        "standard_error": [0.0, 0.02, 0.03],
        "known_log10_shift_factor": [0.0, -0.82, np.nan],
        "known_standard_error": [0.0, 0.01, np.nan],
    }
    found = xr.Dataset(
        {name: column(values, "temperature") for name, values in numbers.items()},
        coords={"temperature": np.array([30.0, 40.0, 60.0]) + ZERO},
        attrs={
            "reference_temperature": 30.0 + ZERO,
            "sentence": "The shift factors agree within their errors.",
            "slope": 0.9761,
            "slope_error": 0.0274,
            "p_value": p_value,
        },
    )
    tree["friction_shift_factors"] = xr.DataTree(found)
    return tree


def check(tree: xr.DataTree, name: str) -> tuple[str, str]:
    (found,) = [check for check in all_checks(tree) if check.name == name]
    return found.verdict, found.sentence


@pytest.mark.parametrize(("p_value", "verdict"), [(0.6, "passed"), (0.001, "warning")])
def test_shift_factors_of_friction_are_judged_by_their_probability(
    tree: xr.DataTree, p_value: float, verdict: str
) -> None:
    reported = check(with_friction_shifts(tree, p_value), "Shift factors from friction")
    assert reported == (verdict, "The shift factors agree within their errors.")


def test_friction_does_not_test_the_rubber_identified_from_it(tree: xr.DataTree) -> None:
    tree = with_friction_shifts(tree)
    tree.attrs["identified_from_friction"] = 1
    verdict, _ = check(tree, "Shift factors from friction")
    assert verdict == "noted"
    assert not any(number.name == "Shift factors from friction" for number in key_numbers(tree))


def test_shift_factors_of_friction_are_a_key_number_and_a_table(tree: xr.DataTree) -> None:
    with_friction_shifts(tree)
    (number,) = [item for item in key_numbers(tree) if item.name == "Shift factors from friction"]
    assert number.value == "0.976 ± 0.027"
    (table,) = [table for table in detail_tables(tree) if table.key == "friction-shift-factors"]
    assert table.rows[1] == ["40 °C", "−0.800 ± 0.020", "−0.820 ± 0.010", "0.0200"]
    assert table.rows[2][2:] == ["–", "–"]


def test_shift_factors_of_friction_are_drawn_beside_those_that_are_known(
    tree: xr.DataTree, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: dict[str, int] = {}

    def points(figure: Figure, form: str) -> bytes:
        axes = figure.axes[0]
        drawn.update({str(container.get_label()): len(container.lines[0].get_xdata()) for container in axes.containers})
        return b""

    monkeypatch.setattr(saving, "_encoded", points)
    name = "friction_shift_factors"
    monkeypatch.setattr(drawing, "FRICTION_FIGURES", {name: drawing.FRICTION_FIGURES[name]})
    monkeypatch.setattr(drawing, "RUBBER_FIGURES", {})
    drawing.figure_images(with_friction_shifts(tree), ("svg",))
    assert sorted(drawn.values()) == [2, 3]


def test_assumptions_are_plain_checks(tree: xr.DataTree) -> None:
    names = ["half-space", "small contact", "linearity", "one temperature"]
    words = {
        "assumption_name": names,
        "holds": [-1, 0, 0, 1],
        "value": [np.nan, 0.2, 0.1, 0.01],
        "limit": [0.25, 0.1, 0.06, 0.05],
        "sentence": [f"A sentence about {name}." for name in names],
    }
    tree["assumptions"] = xr.DataTree(xr.Dataset({key: column(values, "a") for key, values in words.items()}))
    assert check(tree, "Half-space") == ("noted", "A sentence about half-space.")
    assert check(tree, "Linear viscoelasticity")[0] == "warning"
    assert check(tree, "Isothermal")[0] == "passed"
    # Small contacts are counted case by case, from the contacts themselves.
    assert not any("small contact" in one.sentence for one in all_checks(tree))


def test_bands_are_in_the_tables(tree: xr.DataTree) -> None:
    for name in ("prediction", "prediction_master"):
        found = tree[name].to_dataset()
        friction = found["friction_coefficient"]
        tree[name] = xr.DataTree(found.assign(friction_lower=0.98 * friction, friction_upper=1.02 * friction))
    (table,) = [table for table in detail_tables(tree) if table.key == "prediction"]
    row = dict(zip(table.headings, table.rows[0], strict=True))
    assert float(row["95 % from"]) == pytest.approx(0.98 * float(row["friction coefficient"]), rel=1e-3)
    assert float(row["to"]) == pytest.approx(1.02 * float(row["friction coefficient"]), rel=1e-3)
