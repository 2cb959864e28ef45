"""One solved contact: lines for people, plain types for other programs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscofric.contact.solution import ERRORS, ContactSolution
from viscofric.datasets import plain
from viscofric.notes import listed
from viscofric.report.texts.numbers import length, prefixed, short, significant, with_error
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import shown_number

# Friction from the pressure below it is rounding.
_ROUND_OFF = 1e-12

# Relative to the friction: a lateral one below it is what the solver's tolerance leaves of none.
_LEAST_LATERAL = 1e-5

# Units of what `contact_record` holds beside the numbers of the contact.
_UNITS = {"temperature": "K", "direction": "1", "E0": "Pa", "E_inf": "Pa", "C": "1/Pa", "tau": "s", "seconds": "s"}
# Numbers of a contact that are inputs, or work of the solver.
_NO_RESULTS = ("speed", "temperature", "energy_balance", "complementarity", "cells", "spacing", "products")


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


def contact_record(inputs: dict[str, Any], solution: ContactSolution, seconds: float) -> dict[str, Any]:
    """Return a contact in plain types: inputs (SI), results, errors, diagnostics, and the units of their names."""
    from importlib.metadata import version

    diagnostics, numbers = solution.diagnostics, solution.numbers
    names = [str(name) for name in numbers if name not in (*ERRORS.values(), *_NO_RESULTS)]
    results = {"geometry": solution.geometry, **{name: numbers[name].item() for name in names}}
    errors = {
        name: numbers[ERRORS[name]].item() if math.isfinite(results[name]) else None for name in names if name in ERRORS
    }
    heat = {} if solution.heating is None else solution.heating.to_dataset().data_vars
    units = {str(name): one.attrs["units"] for name, one in (*numbers.items(), *heat.items())}
    work = {
        "cells": list(diagnostics.shape),
        "spacing": diagnostics.spacing,
        "complementarity": diagnostics.complementarity,
        "relative_load_error": diagnostics.load,
        "energy_balance": diagnostics.energy,
        "peak_resolved": diagnostics.peak_resolved,
        "collocation_shift": diagnostics.collocation_shift,
        "levels": [level._asdict() for level in diagnostics.levels],
        "set_changes": diagnostics.set_changes,
        "linear_iterations": diagnostics.linear_iterations,
        "products": diagnostics.products,
        "ffts": diagnostics.ffts,
        "seconds": seconds,
    }
    found: dict[str, Any] = plain(
        {
            "format": "viscofric contact 1",
            "viscofric": version("viscofric"),
            "inputs": inputs,
            "results": results,
            "errors": errors,
            "heating": {str(name): one.item() for name, one in heat.items()} or None,
            "derivatives": derivative_record(solution),
            "diagnostics": work,
            **listed("warnings", solution.warnings),
            "units": units | _UNITS,
        },
        digits=None,
    )
    return found


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


def derivative_record(solution: ContactSolution) -> dict[str, Any] | None:
    """Return the derivatives of a contact in plain types, with the units of their names; None without any."""
    derivatives = solution.derivatives
    if derivatives is None:
        return None
    of_logarithms = derivatives.logarithmic
    line = solution.geometry == "line"
    names = ("C", "tau", "E_inf", "speed", "load", "indentation")
    return {
        **{name: getattr(derivatives, name) for name in names},
        "logarithmic": {name: getattr(of_logarithms, name) for name in names},
        "error": derivatives.error,
        "way": derivatives.way,
        "units": {
            "C": "Pa",
            "tau": "1/s",
            "E_inf": "1/Pa",
            "speed": "s/m",
            "load": "m/N" if line else "1/N",
            "indentation": "1/m",
            "logarithmic": "1",
            "error": "1",
        },
    }
