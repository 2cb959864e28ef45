"""Write the tables and figures of docs/verification.md from the checks of `viscofric verify`.

    python scripts/make_verification.py

Tables stand between `<!-- table: NAME -->` and `<!-- end -->`; the words around them are written by hand.
"""

from __future__ import annotations

import io
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
import numpy as np

from viscofric.report.house_style import STYLE, new_figure
from viscofric.report.verification_figures import plot_errors, plot_hunter, plot_orders, plot_windows
from viscofric.verification import CHECKS, Comparison, Outcome, run_checks
from viscofric.verification.line import ACCURACY, MEMORY_LENGTHS, MODULUS_RATIOS, hunter
from viscofric.verification.model_problems import SLOPE
from viscofric.verification.refinement import REFINEMENTS, Refinement
from viscofric.verification.windows import Windows, windows

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.figure import Figure

DOCS = Path(__file__).resolve().parents[1] / "docs"
#: Errors below this are called round-off: their digits differ from machine to machine.
ROUND_OFF = 1e-9


def table(headings: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table in Markdown, numbers to the right."""
    heads, lines = list(headings), [list(row) for row in rows]
    counts = [any(line[index][:1] in "−0123456789" and line[index] for line in lines) for index in range(len(heads))]
    sides = ["---:" if numbers and index > 0 else "---" for index, numbers in enumerate(counts)]
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, sides, *lines])


def number(value: float) -> str:
    return f"{value:.5g}".replace("-", "−")


def error(one: Comparison) -> str:
    if one.measure in ("at least", "at most"):
        return f"{number(one.computed)}, {one.measure} {number(one.expected)}"
    return "round-off" if one.error < ROUND_OFF else f"{one.error:.1e}"


def bound(one: Comparison) -> str:
    return f"{one.bound:.1e}{' abs.' if one.measure == 'absolute' else ''}" if one.bound else "none"


def summary(outcomes: list[Outcome]) -> str:
    rows = []
    for outcome in outcomes:
        worst = outcome.worst
        assert worst is not None
        seen = worst.error >= ROUND_OFF or worst.measure in ("at least", "at most")
        rows.append(
            [
                f"`{outcome.check.name}`",
                f"{outcome.check.title}, against {outcome.check.source}",
                str(len(outcome.comparisons)),
                f"{worst.quantity} ({worst.case})" if seen else "all alike",
                error(worst),
                # Which of several round-offs is the largest, and how it is counted, is chance.
                bound(worst) if seen else f"{max(one.bound for one in outcome.comparisons):.1e}",
            ]
        )
    return table(["check", "what, and against what", "compared", "worst of them", "error", "bound"], rows)


def reasons(outcomes: list[Outcome]) -> str:
    return "\n".join(f"- `{outcome.check.name}`: {outcome.check.reason}" for outcome in outcomes)


def by_quantity(outcome: Outcome) -> dict[str, dict[str, Comparison]]:
    """Return case -> quantity -> comparison, in their order."""
    found: dict[str, dict[str, Comparison]] = {}
    for one in outcome.comparisons:
        found.setdefault(one.case, {})[one.quantity] = one
    return found


def hunter_table(outcome: Outcome) -> str:
    rows = []
    for case, found in by_quantity(outcome).items():
        friction, front, rear = (found[name] for name in ("friction μR/a0", "front edge/a0", "rear edge/a0"))
        rows.append(
            [
                case,
                *(number(value) for value in (friction.computed, friction.expected)),
                error(friction),
                *(number(value) for value in (front.computed, front.expected, rear.computed, rear.expected)),
            ]
        )
    return table(["problem", "μR/a0", "exact", "error", "front/a0", "exact", "rear/a0", "exact"], rows)


def ball_table(outcome: Outcome) -> str:
    rows = []
    for case, found in by_quantity(outcome).items():
        row = [case]
        for one in found.values():
            row += [number(one.computed), number(one.expected), error(one)]
        rows.append(row)
    heads = ["problem"]
    for name in ("μR/a0", "δR/a0²", "area/πa0²", "p_max/p0"):
        heads += [name, "reference", "error"]
    return table(heads, rows)


def orders_table(found: list[Refinement]) -> str:
    rows = []
    for one in found:
        for quantity, errors in one.errors.items():
            sizes = " → ".join(f"{abs(errors[place]):.0e}" for place in (0, len(errors) // 2, -1))
            rows.append(
                [
                    one.name,
                    quantity,
                    one.exact,
                    f"{one.cells[0]} to {one.cells[-1]}",
                    sizes,
                    f"{one.order(quantity):.1f}",
                ]
            )
    return table(["problem", "quantity", "against", "cells", "error, coarsest → middle → finest", "order seen"], rows)


def windows_table(found: Windows) -> str:
    orders = ["", *(f"{order:.1f}" for order in found.orders)]
    rows = [
        [number(period), number(friction), f"{100.0 * deviation:.1f} %".replace("-", "−"), order]
        for period, friction, deviation, order in zip(
            found.periods, found.friction, found.deviations, orders, strict=True
        )
    ]
    rows.append(["free half-space", number(found.free), "", ""])
    return table(["period L/a0", "μR/a0", "deviation", "order"], rows)


def hunter_figure(outcome: Outcome) -> Figure:
    speeds = np.geomspace(MEMORY_LENGTHS[0], MEMORY_LENGTHS[-1], 80)
    exact = {
        ratio: (speeds, np.array([hunter(ratio, one).friction_coefficient / SLOPE for one in speeds]))
        for ratio in MODULUS_RATIOS
    }
    friction = [one for one in outcome.comparisons if one.quantity == "friction μR/a0"]
    memory = np.array(MEMORY_LENGTHS)
    rows = {ratio: friction[i * len(memory) : (i + 1) * len(memory)] for i, ratio in enumerate(MODULUS_RATIOS)}
    figure = new_figure(6.2, 5.6)
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[2.0, 1.0])
    plot_hunter(top, exact, {ratio: (memory, np.array([one.computed for one in row])) for ratio, row in rows.items()})
    errors = {ratio: np.array([one.error for one in row]) for ratio, row in rows.items()}
    plot_errors(bottom, dict.fromkeys(rows, memory), errors, ACCURACY)
    top.set_xlabel("")
    return figure


def orders_figure(found: list[Refinement]) -> Figure:
    figure = new_figure(10.0, 3.8)
    for place, (axes, one) in enumerate(zip(figure.subplots(1, len(found)), found, strict=True)):
        plot_orders(axes, one)
        if place > 0:
            axes.set_ylabel("")
    return figure


def windows_figure(found: Windows) -> Figure:
    figure = new_figure(5.2, 3.4)
    plot_windows(figure.subplots(), found)
    return figure


def with_tables(page: str, tables: dict[str, str]) -> str:
    """Put tables between their marks."""

    def filled(match: re.Match[str]) -> str:
        return f"<!-- table: {match[1]} -->\n\n{tables[match[1]]}\n\n<!-- end -->"

    filled_page, count = re.subn(r"<!-- table: (\w+) -->.*?<!-- end -->", filled, page, flags=re.DOTALL)
    assert count == len(tables), "each table has one place in the page"
    return filled_page


def save(figure: Figure, name: str) -> None:
    target = io.BytesIO()
    figure.savefig(target, format="svg", metadata={"Creator": "viscofric", "Date": None})
    (DOCS / "figures").mkdir(exist_ok=True)
    (DOCS / "figures" / f"{name}.svg").write_bytes(target.getvalue())


def main() -> None:
    outcomes = list(run_checks(CHECKS, lambda check: print(check.name, flush=True)))
    named = {outcome.check.name: outcome for outcome in outcomes}
    failed = [name for name, outcome in named.items() if not outcome.passed]
    assert not failed, f"not to be published: {failed}"
    refinements, limit = [make() for make in REFINEMENTS], windows()
    page = DOCS / "verification.md"
    tables = {
        "checks": summary(outcomes),
        "reasons": reasons(outcomes),
        "hunter": hunter_table(named["hunter"]),
        "ball": ball_table(named["ball-reference"]),
        "orders": orders_table(refinements),
        "windows": windows_table(limit),
    }
    page.write_text(with_tables(page.read_text(encoding="utf-8"), tables), encoding="utf-8")
    for name, draw in (
        ("hunter", lambda: hunter_figure(named["hunter"])),
        ("orders", lambda: orders_figure(refinements)),
        ("windows", lambda: windows_figure(limit)),
    ):
        # Letters as text: a tenth of the size, and they are found by a search.
        with matplotlib.rc_context({**STYLE, "svg.hashsalt": f"viscofric {name}", "svg.fonttype": "none"}):
            save(draw(), name)
    seconds = math.fsum(outcome.seconds for outcome in outcomes)
    print(f"{page} and its figures written; the checks took {seconds:.0f} s.")


if __name__ == "__main__":
    main()
