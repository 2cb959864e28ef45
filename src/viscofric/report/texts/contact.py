"""One solved contact: lines for people, plain types for other programs."""

from __future__ import annotations

import math

import numpy as np

from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.solution import OF_THE_SOLVER, ContactSolution
from viscofric.report.texts.numbers import AFTER_PLUS_MINUS, TWO_DIGITS, in_doubt, length, prefixed, short
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.showing import Row, texts
from viscofric.units import shown_number

# Numbers that the heading has, or that only the solver needs.
_NOT_SHOWN = ("speed", "temperature", *OF_THE_SOLVER)


def contact_rows(solution: ContactSolution | PeriodicSolution) -> dict[str, Row]:
    """Return the numbers of a contact that are shown, by name; rounding is zero, and no lateral force is not shown."""
    spacing = abs(solution.x[-1] - solution.x[0]) / len(solution.x)
    rounding = {"1": max(1e-12, 1e-5 * abs(solution.friction_coefficient)), "m": 1e-6 * spacing}
    rows: dict[str, Row] = {}
    doubtful = in_doubt(solution.warnings)
    for name, (label, value, unit, error) in solution.number_rows.items():
        if doubtful and error is not None and error > 1e-9 * abs(value):  # not what was given
            value, error = float(f"{value:.1e}"), None
        if name == "max_pressure" and not getattr(solution.diagnostics, "peak_resolved", True):
            rows[name] = (f"{label}, not resolved: at least", value, unit, None)
        elif name not in _NOT_SHOWN and math.isfinite(value):
            rounded = abs(value) < rounding.get(unit, 0.0)
            if not rounded or name != "lateral_friction_coefficient":
                rows[name] = (label, 0.0, unit, None) if rounded else (label, value, unit, error)
    if solution.coulomb:
        rows["coulomb"] = ("Coulomb friction, only as shear", solution.coulomb, "1", None)
    return rows


def contact_lines(solution: ContactSolution, seconds: float) -> list[tuple[str, str]]:
    """Return the numbers of a contact with their errors, and the work of the solver, as pairs of name and value."""
    diagnostics = solution.diagnostics
    cells = " × ".join(str(count) for count in diagnostics.shape if count > 1)
    dissipates = solution.friction_coefficient != 0.0
    balance = f"{shown_number(100.0 * diagnostics.energy, '+.2g')} %" if dissipates else "no dissipation: elastic"
    closed = f"gap closed to {diagnostics.complementarity:.0e} of the indentation"
    return [
        *texts(contact_rows(solution).values()),
        *(texts(solution.heating._shown()) if solution.heating else ()),
        ("energy balance", balance),
        ("grid", f"{cells} cells of {length(diagnostics.spacing)}, {len(diagnostics.levels)} nested grids"),
        ("solver", f"{diagnostics.linear_iterations} iterations, {diagnostics.products} products, {closed}"),
        ("time", f"{seconds:.2f} s"),
        TWO_DIGITS if in_doubt(solution.warnings) else AFTER_PLUS_MINUS,
    ]


#: Modes that are shown; all of them are in the record.
_MOST_MODES = 5
#: Share of the largest mode's effect below which a mode is not shown.
_NEGLIGIBLE = 0.01


def derivative_lines(solution: ContactSolution, spectrum: RetardationSpectrum) -> list[str]:
    """Return d ln μ/d ln of speed, load, glassy modulus and of the modes that matter most, a line each."""
    derivatives, friction = solution.derivatives, solution.friction_coefficient
    if derivatives is None or friction == 0.0:
        return ["no derivatives: the friction is zero"]
    of_logarithms = derivatives.logarithmic
    error = derivatives.error / abs(friction)

    # To the digit that the error is in.
    decimals = min(max(1, -math.floor(math.log10(error))), 6) if error > 0.0 else 6

    def relative(value: float | None) -> str:
        return shown_number((value or 0.0) / friction, f"+.{decimals}f")

    held = ("load", "F", of_logarithms.load) if of_logarithms.indentation is None else ("indentation", "δ", None)
    rows = [
        ("speed", "d ln μ/d ln v", of_logarithms.speed),
        (held[0], f"d ln μ/d ln {held[1]}", held[2] if held[2] is not None else of_logarithms.indentation),
        ("glassy modulus", "d ln μ/d ln E∞", of_logarithms.E_inf),
    ]
    lines = [f"sensitivity of friction to each quantity, all others fixed (error of d ln μ: ± {short(error, 1)})"]
    lines += [f"  {name:<21}{symbol:<15}{relative(value):>9}" for name, symbol, value in rows]
    effect = np.maximum(np.abs(of_logarithms.C), np.abs(of_logarithms.tau))
    order = np.argsort(-effect, kind="stable")[:_MOST_MODES]
    shown = np.sort(order[effect[order] > _NEGLIGIBLE * effect.max()])
    among = f", the most important of {len(spectrum)}" if len(shown) < len(spectrum) else ""
    lines.append(f"  modes{among}:")
    lines.append(f"  {'retardation time τ':<21}{'d ln μ/d ln C':>15}{'d ln μ/d ln τ':>17}")
    for k in shown:
        time = prefixed(float(spectrum.tau[k]), None, "s")
        lines.append(f"  {time:<21}{relative(of_logarithms.C[k]):>15}{relative(of_logarithms.tau[k]):>17}")
    return lines
