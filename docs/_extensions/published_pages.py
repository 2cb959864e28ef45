"""Table, origins and figure of the page of published results, from the checks of `viscofric verify --published`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from page_parts import digest, is_made_of, made_of, table, write
from verification_pages import drawn, error, number

from viscofric.report.figures.style import STYLE, new_figure
from viscofric.report.figures.verification import plot_deviations, plot_sliding_ball
from viscofric.verification import Outcome, run_checks
from viscofric.verification.published import PUBLISHED
from viscofric.verification.published.contacts import BALL_POINTS, sliding_ball

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What all of it depends on, of the package.
DEPENDS_ON = (
    "contact",
    "rheology",
    "roughness",
    "verification",
    "report/figures/verification.py",
    "report/figures/style.py",
)


def numbers(outcomes: list[Outcome]) -> str:
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


def figure(outcomes: list[Outcome]) -> Figure:
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


def generate() -> None:
    """Run the published checks if their code has changed, and write the results.

    Raises
    ------
    RuntimeError
        If a check fails: it is not to be published.
    """
    state = digest(*DEPENDS_ON)
    if is_made_of("published", state):
        return
    outcomes = list(run_checks(PUBLISHED))
    failed = [outcome.check.name for outcome in outcomes if not outcome.passed]
    if failed:
        raise RuntimeError(f"checks of the page of published results failed: {', '.join(failed)}")
    write("published/numbers.md", numbers(outcomes))
    write("published/origins.md", origins(outcomes))
    with matplotlib.rc_context(STYLE):
        write("published/deviations.svg", drawn(figure(outcomes), "published"))
    made_of("published", state)
