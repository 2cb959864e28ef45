"""What the verification page includes comes from the checks: names, sources, bounds and numbers of real outcomes."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest

from viscofric.verification import CHECKS, Check, Comparison, Outcome, select
from viscofric.verification.ball import QUANTITIES, ball_references
from viscofric.verification.line import ACCURACY, MEMORY_LENGTHS, MODULUS_RATIOS
from viscofric.verification.model_problems import InHertzUnits, one_time, solve_cylinder

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "verification.md").read_text(encoding="utf-8")
CHEAP = ["hertz-ball", "hertz-cylinder", "sneddon-cone", "flat-punch", "westergaard", "johnson-waves", "thin-layers"]


@pytest.fixture
def pages(extension: Callable[[str], ModuleType]) -> ModuleType:
    return extension("verification_pages")


@cache
def outcomes() -> list[Outcome]:
    return [check.run() for check in select(CHECKS, CHEAP)]


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_every_table_and_figure_has_its_place(pages: ModuleType) -> None:
    included = re.findall(r"\{include\} _generated/verification/(\w+)\.md", PAGE)
    drawn = re.findall(r"\]\(_generated/verification/(\w+)\.svg\)", PAGE)
    assert set(included) == {"checks", "reasons", "hunter", "ball", "energy", "orders", "windows"}
    assert set(drawn) == {"hunter", "orders", "windows"}
    assert len(included) == len(set(included))


@pytest.mark.slow
def test_every_check_is_reported_with_its_source_reason_and_worst_comparison(pages: ModuleType) -> None:
    rows = [cells(line) for line in pages.summary(outcomes()).splitlines()[2:]]
    assert [row[0] for row in rows] == [f"`{name}`" for name in CHEAP]
    for row, outcome in zip(rows, outcomes(), strict=True):
        assert outcome.passed
        assert outcome.worst is not None
        assert row[1] == f"{outcome.check.title}, against {outcome.check.source}"
        assert int(row[2]) == len(outcome.comparisons)
        # two digits are printed
        assert float(row[4]) == pytest.approx(outcome.worst.error, rel=0.05)
    reported = pages.reasons(outcomes()).splitlines()
    assert reported == [f"- `{outcome.check.name}`: {outcome.check.reason}" for outcome in outcomes()]


def test_line_contacts_are_reported_beside_their_closed_form(pages: ModuleType) -> None:
    ratio, memory = MODULUS_RATIOS[1], MEMORY_LENGTHS[4]
    found = InHertzUnits.of(solve_cylinder(one_time(ratio, memory), accuracy=ACCURACY))
    exact = pages.hunter(ratio, memory)
    case = "one"
    (check,) = select(CHECKS, ["hunter"])
    outcome = Outcome(
        check,
        (
            Comparison(case, "friction μR/a0", found.friction, exact.friction_coefficient / pages.SLOPE, ACCURACY),
            Comparison(case, "front edge/a0", found.front, 1.0, 1.0),
            Comparison(case, "rear edge/a0", found.rear, 1.0, 1.0),
        ),
        "",
        0.0,
    )
    row = cells(pages.hunter_table(outcome).splitlines()[2])
    assert float(row[1]) == pytest.approx(float(row[2]), rel=ACCURACY)
    assert float(row[4]) == pytest.approx(found.front, rel=1e-4)


def test_reference_values_are_whole() -> None:
    rows = ball_references()
    assert len(rows) == 8
    for row in rows:
        assert set(row.values) == set(row.errors) == set(QUANTITIES)
        # The least that a reference must be good for.
        assert all(0.0 < row.errors[name] < 0.01 * row.values[name] for name in QUANTITIES)


def test_a_check_that_fails_is_not_published(
    pages: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = Check("wrong", "", "", "", "", lambda: [Comparison("case", "what", 2.0, 1.0, 0.1)])
    monkeypatch.setattr(pages, "CHECKS", (wrong,))
    monkeypatch.setattr("page_parts.GENERATED", tmp_path)
    with pytest.raises(RuntimeError, match="wrong"):
        pages.generate()
    assert not list(tmp_path.iterdir())
