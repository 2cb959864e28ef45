"""The verification page says what the checks say: names, sources, bounds, and numbers computed anew."""

from __future__ import annotations

import importlib.util
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from viscofric.verification import CHECKS, select
from viscofric.verification.ball import QUANTITIES, ball_references
from viscofric.verification.line import ACCURACY
from viscofric.verification.model_problems import InHertzUnits, one_time, solve_cylinder

if TYPE_CHECKING:
    from types import ModuleType

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "verification.md").read_text(encoding="utf-8")
CHEAP = ["hertz-ball", "hertz-cylinder", "sneddon-cone", "flat-punch", "westergaard", "johnson-waves", "thin-layers"]


@cache
def script() -> ModuleType:
    specification = importlib.util.spec_from_file_location("make_verification", ROOT / "scripts/make_verification.py")
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def stored(name: str) -> str:
    found = re.search(rf"<!-- table: {name} -->\n\n(.*?)\n\n<!-- end -->", PAGE, re.DOTALL)
    assert found is not None
    return found[1]


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_every_check_is_on_the_page_with_its_source_and_reason() -> None:
    rows = [cells(line) for line in stored("checks").splitlines()[2:]]
    assert [row[0] for row in rows] == [f"`{check.name}`" for check in CHECKS]
    assert [row[1] for row in rows] == [f"{check.title}, against {check.source}" for check in CHECKS]
    assert stored("reasons").splitlines() == [f"- `{check.name}`: {check.reason}" for check in CHECKS]


@pytest.mark.parametrize("name", CHEAP)
def test_what_the_page_says_of_a_check_comes_out_again(name: str) -> None:
    (check,) = select(CHECKS, [name])
    outcome = check.run()
    assert outcome.passed
    new = cells(script().summary([outcome]).splitlines()[2])
    (old,) = [cells(line) for line in stored("checks").splitlines() if line.startswith(f"| `{name}`")]
    assert new[:4] == old[:4]
    assert new[5] == old[5]
    # Two digits are printed; the rest is left to other machines' FFTs.
    assert float(new[4]) == pytest.approx(float(old[4]), rel=0.1)


@pytest.mark.parametrize(("ratio", "memory"), [(2.0, 10.0), (10.0, 1.0), (1000.0, 100.0)])
def test_line_contacts_of_the_page_come_out_again(ratio: float, memory: float) -> None:
    (row,) = [
        cells(line)
        for line in stored("hunter").splitlines()
        if line.startswith(f"| k = {ratio:g}, vτ/a0 = {memory:g} ")
    ]
    found = InHertzUnits.of(solve_cylinder(one_time(ratio, memory), accuracy=ACCURACY))
    assert float(row[1]) == pytest.approx(found.friction, rel=ACCURACY)
    assert float(row[1]) == pytest.approx(float(row[2]), rel=ACCURACY)
    assert float(row[4]) == pytest.approx(found.front, rel=1e-3)


def test_reference_values_are_whole() -> None:
    rows = ball_references()
    assert len(rows) == 8
    assert [cells(line)[0] for line in stored("ball").splitlines()[2:]] == [row.case for row in rows]
    for row in rows:
        assert set(row.values) == set(row.errors) == set(QUANTITIES)
        # The least that a reference must be good for.
        assert all(0.0 < row.errors[name] < 0.01 * row.values[name] for name in QUANTITIES)


def test_tables_are_replaced_and_nothing_else() -> None:
    page = "a\n<!-- table: one -->\nold\n<!-- end -->\nb\n<!-- table: two --><!-- end -->"
    new = script().with_tables(page, {"one": "| 1 |", "two": "| 2 |"})
    assert new == "a\n<!-- table: one -->\n\n| 1 |\n\n<!-- end -->\nb\n<!-- table: two -->\n\n| 2 |\n\n<!-- end -->"
    assert script().with_tables(new, {"one": "| 1 |", "two": "| 2 |"}) == new


@pytest.mark.parametrize("name", ["hunter", "orders", "windows"])
def test_figures_are_there_and_small(name: str) -> None:
    path = ROOT / "docs" / "figures" / f"{name}.svg"
    assert f"(figures/{name}.svg)" in PAGE
    assert 5_000 < path.stat().st_size < 150_000
