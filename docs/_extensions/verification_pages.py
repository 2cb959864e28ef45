"""Tables and figures of the pages of verification and of published results, from the checks of `viscofric verify`."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from page_parts import digest, is_made_of, made_of, table, write
from verification_figures import (
    plot_deviations,
    plot_errors,
    plot_hunter,
    plot_orders,
    plot_sliding_ball,
    plot_windows,
)

from viscofric.report.figures.style import STYLE, new_figure
from viscofric.verification import CHECKS, Check, Comparison, Outcome, run_checks
from viscofric.verification.line import ACCURACY, MEMORY_LENGTHS, MODULUS_RATIOS, hunter
from viscofric.verification.model_problems import SLOPE
from viscofric.verification.published import PUBLISHED
from viscofric.verification.published.contacts import BALL_POINTS, sliding_ball
from viscofric.verification.refinement import REFINEMENTS, Refinement, Windows, windows

#: Errors below this are called round-off: their digits differ from machine to machine.
ROUND_OFF = 1e-9


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
                f"{worst.quantity} ({worst.case})" if seen else "all equal",
                error(worst),
                # Which of several round-offs is the largest, and how it is counted, is chance.
                bound(worst) if seen else f"{max(one.bound for one in outcome.comparisons):.1e}",
            ]
        )
    return table(["check", "quantity and reference", "comparisons", "worst", "error", "bound"], rows)


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


def energy_table(outcome: Outcome) -> str:
    rows = [
        [one.case, one.quantity, number(one.computed), number(one.expected), error(one), bound(one)]
        for one in outcome.comparisons
    ]
    return table(["problem", "compared", "computed", "expected", "error", "bound"], rows)


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
    return table(
        ["problem", "quantity", "against", "cells", "error, coarsest → middle → finest", "observed order"], rows
    )


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


#: What all of it depends on, of the package.
DEPENDS_ON = ("contact", "rheology", "verification", "report/figures/style.py")
PUBLISHED_DEPENDS_ON = (*DEPENDS_ON, "roughness")


def drawn(figure: Figure, name: str, letters: str = "none") -> bytes:
    """Return a figure as SVG that is the same from run to run.

    Letters are text ("none": a tenth of the size), or "path", which formulas need.
    """
    target = io.BytesIO()
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": f"viscofric {name}", "svg.fonttype": letters}):
        figure.savefig(target, format="svg", metadata={"Creator": "viscofric", "Date": None})
    return target.getvalue()


def tables(outcomes: list[Outcome], refinements: list[Refinement], limit: Windows) -> dict[str, str]:
    """Return every table of the page by the name that the page includes it under."""
    named = {outcome.check.name: outcome for outcome in outcomes}
    return {
        "checks": summary(outcomes),
        "reasons": reasons(outcomes),
        "hunter": hunter_table(named["hunter"]),
        "ball": ball_table(named["ball-reference"]),
        "energy": energy_table(named["energy-balance"]),
        "orders": orders_table(refinements),
        "windows": windows_table(limit),
    }


def figures(outcomes: list[Outcome], refinements: list[Refinement], limit: Windows) -> dict[str, bytes]:
    """Return every figure of the page by its name."""
    (hunter_outcome,) = [outcome for outcome in outcomes if outcome.check.name == "hunter"]
    makers = {
        "hunter": lambda: hunter_figure(hunter_outcome),
        "orders": lambda: orders_figure(refinements),
        "windows": lambda: windows_figure(limit),
    }
    made = {}
    for name, maker in makers.items():
        with matplotlib.rc_context(STYLE):
            made[name] = drawn(maker(), name)
    return made


def published_numbers(outcomes: list[Outcome]) -> str:
    rows = []
    for outcome in outcomes:
        for place, one in enumerate(outcome.comparisons):
            name = f"`{outcome.check.name}`" if place == 0 else ""
            bound = f"{one.bound:.1e}"
            rows.append([name, one.case, one.quantity, number(one.expected), number(one.computed), error(one), bound])
    return table(["check", "case", "quantity", "theirs", "viscofric", "difference", "bound"], rows)


def linked(text: str) -> str:
    """Return a text with its DOIs as links."""
    return re.sub(r"doi:(10\.[^\s,;()]+)", r"[doi:\1](https://doi.org/\1)", text)


def origins(outcomes: list[Outcome]) -> str:
    entries = []
    for outcome in outcomes:
        check = outcome.check
        entry = f"`{check.name}`\n: {check.title}.\n\n  **Source:** {linked(check.source)}."
        entry += f"\n\n  **Obtained:** {check.obtained}"
        if check.unstated:
            entry += f"\n\n  **Not stated:** {check.unstated}"
        entries.append(f"{entry}\n\n  **Bounds:** {check.reason}")
    return "\n\n".join(entries)


def published_figure(outcomes: list[Outcome]) -> Figure:
    memory = np.geomspace(0.03, 30.0, 40)
    made = new_figure(10.0, 4.2)
    left, right = made.subplots(1, 2, width_ratios=[1.0, 1.2])
    friction = np.array([sliding_ball(float(one)) for one in memory])
    plot_sliding_ball(left, memory, friction, np.array(BALL_POINTS))
    deviations = {}
    for outcome in outcomes:
        scale = [abs(one.expected) if one.measure == "absolute" else 1.0 for one in outcome.comparisons]
        errors = np.array([one.error for one in outcome.comparisons]) / scale
        deviations[outcome.check.name] = errors, np.array([one.bound for one in outcome.comparisons]) / scale
    plot_deviations(right, deviations)
    return made


def checked(page: str, checks: Iterable[Check], depends_on: tuple[str, ...]) -> list[Outcome] | None:
    """Run the checks of a page if the code that they depend on has changed; None if not.

    Raises
    ------
    RuntimeError
        If a check fails: it is not to be published.
    """
    if is_made_of(page, digest(*depends_on)):
        return None
    outcomes = list(run_checks(checks, lambda check: None))
    failed = [outcome.check.name for outcome in outcomes if not outcome.passed]
    if failed:
        raise RuntimeError(f"checks of the page of {page} failed: {', '.join(failed)}")
    return outcomes


def generate() -> None:
    """Run the checks of both pages if their code has changed, and write the results."""
    outcomes = checked("verification", CHECKS, DEPENDS_ON)
    if outcomes is not None:
        refinements, limit = [make() for make in REFINEMENTS], windows()
        for name, text in tables(outcomes, refinements, limit).items():
            write(f"verification/{name}.md", text)
        for name, image in figures(outcomes, refinements, limit).items():
            write(f"verification/{name}.svg", image)
        made_of("verification", digest(*DEPENDS_ON))
    outcomes = checked("published", PUBLISHED, PUBLISHED_DEPENDS_ON)
    if outcomes is not None:
        write("published/numbers.md", published_numbers(outcomes))
        write("published/origins.md", origins(outcomes))
        with matplotlib.rc_context(STYLE):
            write("published/deviations.svg", drawn(published_figure(outcomes), "published"))
        made_of("published", digest(*PUBLISHED_DEPENDS_ON))
