"""One solved contact: lines for people, plain types for other programs."""

from __future__ import annotations

import math

import numpy as np

from viscofric.contact.solution import ContactSolution
from viscofric.report.texts.numbers import length, prefixed, short, significant, with_error
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import shown_number

# Friction from the pressure below it is rounding.
_ROUND_OFF = 1e-12

# Relative to the friction: a lateral one below it is what the solver's tolerance leaves of none.
_LEAST_LATERAL = 1e-5


def contact_lines(solution: ContactSolution, seconds: float) -> list[tuple[str, str]]:
    """Return what an engineer wants to know of a contact, as pairs of name and value."""
    line = solution.geometry == "line"
    diagnostics = solution.diagnostics
    force = "N/m" if line else "N"
    peak = prefixed(solution.max_pressure, diagnostics.max_pressure_error, "Pa")
    if not diagnostics.peak_resolved:
        peak = f"at least {prefixed(solution.max_pressure, None, 'Pa')} (not resolved by this grid)"
    cells = " × ".join(str(count) for count in diagnostics.shape if count > 1)
    edge, closed = diagnostics.edge_error, f"gap closed to {diagnostics.complementarity:.0e} of the indentation"
    lines = [
        ("friction coefficient", _friction(solution)),
        ("  from the pressure", _five(solution.pressure_friction_coefficient)),
        ("  from the energy", f"{_five(solution.energy_friction_coefficient)}{_balance(solution)}"),
        ("friction force", prefixed(solution.friction_force, None, force)),
        *([("Coulomb friction, its shear only", _five(solution.coulomb))] if solution.coulomb else []),
        *_lateral(solution),
        ("load", prefixed(solution.load, diagnostics.load_error, force)),
        ("indentation", length(solution.indentation, diagnostics.indentation_error)),
        (
            "contact width" if line else "contact area",
            prefixed(solution.contact_area, diagnostics.contact_area_error, "m", 1 if line else 2),
        ),
        ("  ahead of the axis", length(solution.front, edge)),
        ("  behind the axis", length(solution.rear, edge)),
    ]
    if not line:
        lines.append(("  half width across", length(solution.half_width, edge)))
    lines += _heat(solution)
    lines += [
        ("largest pressure", peak),
        ("mean pressure", prefixed(solution.mean_pressure, None, "Pa")),
        ("centre of pressure", _centre(solution)),
        ("grid", f"{cells} cells of {length(diagnostics.spacing)}, {len(diagnostics.levels)} nested grids"),
        ("solver", f"{diagnostics.linear_iterations} iterations, {diagnostics.products} products, {closed}"),
        ("time", f"{seconds:.2f} s"),
        ("after ±", "errors of the numerical solution, not of the material"),
    ]
    return lines


def _heat(solution: ContactSolution) -> list[tuple[str, str]]:
    """Return the lines of a contact that its own friction heats."""
    heat = solution.heating
    if heat is None:
        return []

    def kelvin(rise: float) -> str:
        return f"{short(rise, 3)} K"

    lines = [
        ("rise of temperature", f"{with_error(heat.temperature_rise, heat.temperature_rise_error)} K"),
        ("  by Coulomb friction", kelvin(heat.coulomb_rise)),
        ("  by the loss", kelvin(heat.loss_rise)),
        *([("  of it by earlier passes", kelvin(heat.track_rise))] if heat.track_rise else []),
        ("  of the face", kelvin(heat.face_rise)),
        ("  where the loss is released", kelvin(heat.loss_weighted_rise)),
        ("isothermal friction", _five(heat.isothermal_friction)),
    ]
    if heat.other_rise is not None and heat.other_friction is not None:
        lines.append(("other stable state", f"{_five(heat.other_friction)}, {kelvin(heat.other_rise)} warmer"))
    return lines


def _friction(solution: ContactSolution) -> str:
    value, error = solution.friction_coefficient, solution.diagnostics.friction_error
    if value == 0.0:
        return "0 (elastic: no dissipation)"
    return with_error(value, error)


def _lateral(solution: ContactSolution) -> list[tuple[str, str]]:
    """Return the line of the force across the motion, where an indenter may have one."""
    # Looking along the motion, whose sense is that of the speed.
    value = solution.lateral_friction_coefficient * math.copysign(1.0, solution.speed)
    if abs(value) <= _LEAST_LATERAL * abs(solution.friction_coefficient):
        oblique = 0.0 not in solution.direction and solution.geometry == "point"
        return [("lateral friction", "0 (no lateral force)")] if oblique else []
    side = "left" if value > 0.0 else "right"
    return [("lateral friction", f"{short(abs(value))} (a force to the {side} is needed to keep the direction)")]


def _five(friction: float) -> str:
    return significant(friction if abs(friction) > _ROUND_OFF else 0.0, 5)


def _balance(solution: ContactSolution) -> str:
    if solution.friction_coefficient == 0.0:
        return ""
    if solution.diagnostics.energy == -1.0:
        return " (all at the sharp edge)"
    return f" (energy balance {shown_number(100.0 * solution.diagnostics.energy, '+.2g')} %)"


def _centre(solution: ContactSolution) -> str:
    distance = solution.centre_of_pressure * math.copysign(1.0, solution.speed)
    if abs(distance) < 1e-6 * solution.diagnostics.spacing:
        return "on the axis"
    return f"{length(abs(distance))} {'ahead of' if distance > 0.0 else 'behind'} the axis"


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
