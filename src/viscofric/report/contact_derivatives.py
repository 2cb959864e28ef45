"""What a contact's friction depends on, in words and numbers: its derivatives with material, speed and load."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.report.numbers import prefixed, short

if TYPE_CHECKING:
    from viscofric.contact.solution import ContactSolution
    from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Modes that are shown; all of them are in the record.
_MOST_MODES = 5
#: Share of the largest mode's effect below which a mode is not shown.
_NEGLIGIBLE = 0.01


def derivative_lines(solution: ContactSolution, spectrum: RetardationSpectrum) -> list[str]:
    """Return d ln μ/d ln of speed, load, glass modulus and of the modes that matter most, a line each.

    Parameters
    ----------
    solution : ContactSolution
        With derivatives.
    spectrum : RetardationSpectrum
        What it was solved with.
    """
    derivatives, friction = solution.derivatives, solution.friction_coefficient
    if derivatives is None or friction == 0.0:
        return ["no derivatives: there is no friction to differentiate"]
    of_logarithms = derivatives.logarithmic
    error = derivatives.error / abs(friction)

    # To the digit that the error is in.
    decimals = min(max(1, -math.floor(math.log10(error))), 6) if error > 0.0 else 6

    def relative(value: float | None) -> str:
        return f"{(value or 0.0) / friction:+.{decimals}f}".replace("-", "−")

    held = ("load", "F", of_logarithms.load) if of_logarithms.indentation is None else ("indentation", "δ", None)
    rows = [
        ("speed", "d ln μ/d ln v", of_logarithms.speed),
        (held[0], f"d ln μ/d ln {held[1]}", held[2] if held[2] is not None else of_logarithms.indentation),
        ("glass modulus", "d ln μ/d ln E∞", of_logarithms.E_inf),
    ]
    lines = [f"change of friction with each, all else held (d ln μ is known to ± {short(error, 1)})"]
    lines += [f"  {name:<21}{symbol:<15}{relative(value):>9}" for name, symbol, value in rows]
    effect = np.maximum(np.abs(of_logarithms.C), np.abs(of_logarithms.tau))
    order = np.argsort(-effect, kind="stable")[:_MOST_MODES]
    shown = np.sort(order[effect[order] > _NEGLIGIBLE * effect.max()])
    among = f", those that matter most of {len(spectrum)}" if len(shown) < len(spectrum) else ""
    lines.append(f"  modes{among}:")
    lines.append(f"  {'retardation time τ':<21}{'d ln μ/d ln C':>15}{'d ln μ/d ln τ':>17}")
    for k in shown:
        time = prefixed(float(spectrum.tau[k]), None, "s")
        lines.append(f"  {time:<21}{relative(of_logarithms.C[k]):>15}{relative(of_logarithms.tau[k]):>17}")
    return lines


def derivative_record(solution: ContactSolution) -> dict[str, Any] | None:
    """Return the derivatives of a contact in plain types, with the units of their names; None without any.

    Parameters
    ----------
    solution : ContactSolution
    """
    derivatives = solution.derivatives
    if derivatives is None:
        return None
    of_logarithms = derivatives.logarithmic
    line = solution.geometry == "line"
    names = ("C", "tau", "E_inf", "speed", "load", "indentation")
    return {
        **{name: _listed(getattr(derivatives, name)) for name in names},
        "logarithmic": {name: _listed(getattr(of_logarithms, name)) for name in names},
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


def _listed(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value
