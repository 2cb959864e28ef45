"""Derivatives of the friction coefficient against differences of solutions on the same cells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.contact.layers import Layer
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification.check import Check, Comparison
from viscofric.verification.model_problems import (
    BALL_LOAD,
    CYLINDER_LOAD,
    HERTZ_RADIUS,
    POISSON_RATIO,
    SLOPE,
    SPEED,
    rubber,
    solve_ball,
    solve_cylinder,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from viscofric.contact.solution import ContactSolution

_STEP = 1e-5  # of the logarithms: no cell comes into contact or leaves it
_CELLS, _REACH = 128, 1.6 * HERTZ_RADIUS
_SAME = 1e-6
#: What is differentiated, by the way to it.
_EXPRESSIONS = {
    "pressure": "pressure_friction_coefficient",
    "balance": "friction_coefficient",
    "energy": "energy_friction_coefficient",
}


def _solve(point: bool, given: dict[str, Any], *, derivatives: bool = False) -> ContactSolution:
    rest = dict(given)
    C, tau, E_inf, speed = (rest.pop(name) for name in ("C", "tau", "E_inf", "speed"))
    spectrum = RetardationSpectrum(1.0 / (1.0 / E_inf + float(np.sum(C))), E_inf, C, tau)
    return (solve_ball if point else solve_cylinder)(
        Material(spectrum, poisson_ratio=POISSON_RATIO),
        speed,
        **rest,
        window=(_REACH,) * (3 if point else 2),
        grid=_CELLS,
        tolerance=1e-12,
        derivatives=derivatives,
    )


def _derivatives() -> Iterator[Comparison]:
    modes = rubber(10.0, [1.0, 2.0], [0.3, 3.0]).modes_at()
    half_space = {"C": modes.C, "tau": modes.tau, "E_inf": modes.E_inf, "speed": SPEED}
    cases: tuple[tuple[str, bool, dict[str, Any]], ...] = (
        ("cylinder, load given", False, {"load": CYLINDER_LOAD}),
        ("ball, load given", True, {"load": BALL_LOAD}),
        (
            "ball on a layer, H = 2 a0, indentation given",
            True,
            {"load": None, "indentation": 0.9 * SLOPE * HERTZ_RADIUS, "layer": Layer(2.0 * HERTZ_RADIUS)},
        ),
    )
    for case, point, held in cases:
        given = half_space | held
        derivatives = _solve(point, given, derivatives=True).derivatives
        assert derivatives is not None
        way = _EXPRESSIONS[derivatives.way]
        names = ["E_inf", "speed", "load" if held["load"] is not None else "indentation"]
        for name, mode in [(name, None) for name in names] + [("C", 0), ("tau", 1)]:
            ends = []
            for step in (_STEP, -_STEP):
                value = np.array(given[name], dtype=float)
                value[... if mode is None else mode] *= np.exp(step)
                changed = given | {name: value if value.ndim else float(value)}
                ends.append(getattr(_solve(point, changed), way))
            known = (ends[0] - ends[1]) / (2.0 * _STEP)
            found = getattr(derivatives.logarithmic, name)
            quantity = name if mode is None else f"{name}{mode + 1}"
            computed = float(found if mode is None else found[mode])
            yield Comparison(case, f"dμ/d ln {quantity}", computed, known, _SAME)


CHECKS = (
    Check(
        "derivatives",
        "Derivatives of the friction coefficient with modes, glass, speed, load, indentation; a layer too",
        "sensitivities",
        "differences of solutions on the same cells, a hundred-thousandth up and down",
        "Exact for the cells in contact: terms of the order of the step squared, and the solver's tolerance, 1e-12, "
        "over the step.",
        _derivatives,
    ),
)
