"""Derivatives of the friction coefficient against a closed form and against differences of solutions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from viscofric.contact.reference import hunter_line
from viscofric.contact.solution import ContactSolution
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification import model_problems as model
from viscofric.verification.check import Comparison, checks

check = checks("sensitivities")

_STEP = 0.06  # of the logarithms: many cells come into contact, so that where edges lie within them evens out
_CLOSED_STEP = 1e-4
_CELLS, _LINE_CELLS, _REACH = 128, 1024, 1.6 * model.HERTZ_RADIUS
_NEAR = 2e-3


def _solve(point: bool, given: dict[str, Any], *, derivatives: bool = False) -> ContactSolution:
    rest = dict(given)
    C, tau, E_inf, speed = (rest.pop(name) for name in ("C", "tau", "E_inf", "speed"))
    spectrum = RetardationSpectrum(1.0 / (1.0 / E_inf + float(np.sum(C))), E_inf, C, tau)
    return (model.solve_ball if point else model.solve_cylinder)(
        Material(spectrum, poisson_ratio=model.POISSON_RATIO),
        speed,
        **rest,
        window=(_REACH,) * (3 if point else 2),
        grid=_CELLS if point else _LINE_CELLS,
        derivatives=derivatives,
    )


def _compare(
    case: str,
    solution: ContactSolution,
    given: dict[str, Any],
    step: float,
    friction: Callable[[dict[str, Any]], float],
) -> Iterator[Comparison]:
    """Compare derivatives with the logarithms, over the friction, with differences."""
    assert solution.derivatives is not None
    logarithmic = solution.derivatives.logarithmic
    held = "load" if logarithmic.indentation is None else "indentation"
    for name, mode in [("E_inf", None), ("speed", None), (held, None), ("C", 0), ("tau", 0)]:
        ends = []
        for way in (step, -step):
            value = np.array(given[name], dtype=float)
            value[... if mode is None else mode] *= np.exp(way)
            ends.append(friction(given | {name: value if value.ndim else float(value)}))
        known = (ends[0] - ends[1]) / (2.0 * step) / solution.friction_coefficient
        computed = float(np.ravel(getattr(logarithmic, name))[0]) / solution.friction_coefficient
        yield Comparison(case, f"d ln μ/d ln {name}", computed, known, _NEAR, "absolute")


def _closed_form(given: dict[str, Any]) -> float:
    E0 = 1.0 / (1.0 / given["E_inf"] + float(given["C"][0]))
    return hunter_line(
        given["load"], model.RADIUS, E0, given["E_inf"], float(given["tau"][0]), given["speed"], model.POISSON_RATIO
    ).friction_coefficient


@check(
    "derivatives",
    "Derivatives of the friction coefficient with modes, glass, speed, load and indentation",
    "those of Hunter's closed form, and differences of solutions 6 % up and down",
    "On these grids derivatives are accurate to about 0.1 %; friction is accurate to 1e-4, an error that a "
    "difference divides by its step.",
)
def _derivatives() -> Iterator[Comparison]:
    for memory_length in (0.1, 1.0, 10.0):
        modes = model.rubber(10.0, [1.0], [memory_length]).modes_at()
        given = {
            "C": modes.C,
            "tau": modes.tau,
            "E_inf": modes.E_inf,
            "speed": model.SPEED,
            "load": model.CYLINDER_LOAD,
        }
        solution = _solve(False, given, derivatives=True)
        yield from _compare(f"cylinder, vτ/a0 = {memory_length:g}", solution, given, _CLOSED_STEP, _closed_form)
    modes = model.rubber(10.0, [1.0, 2.0], [0.3, 3.0]).modes_at()
    for case, held in (
        ("ball, load given", {"load": model.BALL_LOAD}),
        ("ball, indentation given", {"load": None, "indentation": 0.9 * model.HERTZ_RADIUS**2 / model.RADIUS}),
    ):
        given = {"C": modes.C, "tau": modes.tau, "E_inf": modes.E_inf, "speed": model.SPEED} | held
        solution = _solve(True, given, derivatives=True)
        yield from _compare(case, solution, given, _STEP, lambda there: _solve(True, there).friction_coefficient)
